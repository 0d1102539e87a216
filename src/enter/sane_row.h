#pragma once
#include <cstddef>

#include "limpid/core/frame.h"

namespace limpid {

/// What numbers need not be touched on entry: NaN never is one of them.
struct SaneRange {
  float least, most;
  float besides;  ///< one more; none where it is NaN
};

/// Of a frame's plane. Normals have none: they are hardly ever unit to the last bit. `nothing_hit`
/// counts for kDepth alone: from that depth on nothing was hit.
SaneRange sane_range(Sanitise kind, float nothing_hit = 1e9f);

/// Whether all of `count` numbers, `stride` floats apart, are in the range.
bool row_is_sane(const SaneRange& range, const float* row, std::ptrdiff_t stride, int count);

}  // namespace limpid
