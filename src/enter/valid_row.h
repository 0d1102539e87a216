#pragma once
#include <cstddef>

#include "limpid/core/frame.h"

namespace limpid {

/// The values that entry leaves unchanged: `least` ... `most`, and `besides`. NaN is never valid.
struct ValidRange {
  float least, most;
  float besides;  ///< one more value; NaN for none
};

/// The valid values of a plane. Of normals none is valid: a normal is hardly ever unit to the last
/// bit. `nothing_hit` is for kDepth only: depths from it on mean that no surface was hit.
ValidRange valid_range(Sanitise kind, float nothing_hit = 1e9f);

/// Whether all of `count` values, `stride` floats apart, are valid.
bool row_is_valid(const ValidRange& range, const float* row, std::ptrdiff_t stride, int count);

}  // namespace limpid
