#pragma once
#include <cstddef>

#include "limpid/core/frame.h"

namespace limpid {

/// Range of numbers that entry leaves unchanged: NaN never is in it.
struct SaneRange {
  float least, most;
  float besides;  ///< one more number; NaN for none
};

/// The range for a frame's plane. Normals have none: they are hardly ever unit to the last bit.
/// `nothing_hit` applies to kDepth only: depths from it on mean that nothing was hit.
SaneRange sane_range(Sanitise kind, float nothing_hit = 1e9f);

/// Whether all of `count` numbers, `stride` floats apart, are in the range.
bool row_is_sane(const SaneRange& range, const float* row, std::ptrdiff_t stride, int count);

}  // namespace limpid
