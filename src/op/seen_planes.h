#pragma once
#include "op/pass.h"

namespace limpid {

/// The planes that refracted rays look up: the dry scene, or the layer below the water, if the
/// frame has it and the view does not begin in the water.
struct SeenPlanes {
  PlaneId color, depth;
  const Bounds& bounds;
  bool below;  ///< the layer below the crests of the water, +inf where it is empty

  static SeenPlanes of(const Pass& pass) {
    if (pass.planes.covers(kBelowPlanes) && !pass.submersible)
      return {PlaneId::kBelowR, PlaneId::kBelowDepth, pass.below, true};
    return {PlaneId::kColorR, PlaneId::kDepth, pass.dry, false};
  }
};

}  // namespace limpid
