#pragma once
#include <algorithm>
#include <cstdint>

namespace limpid {

/// The 8 bits of a value 0 ... 1: clamped and rounded, NaN becomes 0.
inline std::uint8_t byte_of(float value) {
  return value > 0 ? static_cast<std::uint8_t>(std::min(value, 1.0f) * 255.0f + 0.5f)
                   : std::uint8_t{0};
}

}  // namespace limpid
