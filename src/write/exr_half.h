#pragma once
#include <algorithm>
#include <cmath>

#include <Imath/half.h>

namespace limpid {

/// Finite values beyond the largest half become it, inf stays inf.
inline half half_of(float value) {
  constexpr float kHalfMax = 65504;
  return half(std::isfinite(value) ? std::clamp(value, -kHalfMax, kHalfMax) : value);
}

}  // namespace limpid
