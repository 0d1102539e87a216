#pragma once
#include <vector>

#include "shade/recording.h"

namespace limpid {

/// A nearest texel, and the four texels around the same place that are read unless the nearest is
/// refused: a shader reads the four alone. Where the nearest is refused, the four are read at the
/// pixel itself, whose own texel it has. (NVIDIA H100: `realistic` takes .98 of the time.)
struct SharedQuad {
  int nearest, quad, read;  ///< nodes: kNearest, kQuad, kRead
  int refused;              ///< the node of the mask
};

std::vector<SharedQuad> shared_quads(const Recording& recording);

}  // namespace limpid
