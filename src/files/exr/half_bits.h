#pragma once
#include <bit>
#include <cstdint>

/// Half-precision numbers as their 16 bits (IEEE 754 binary16). Without branches and tables, so
/// that loops over rows run on vectors; signed integers, because those are what SSE2 compares.

namespace limpid {

/// Exact. The factor corrects the difference of the exponents' biases, and normalises denormals;
/// infinities and NaN need the same factor again.
inline float float_of_half(std::uint16_t half) {
  constexpr std::int32_t kBias = 112 << 23, kInfinity = 31 << 23;
  const std::int32_t magnitude = (half & 0x7fff) << 13, sign = half & 0x8000;
  const auto scaled = std::bit_cast<std::int32_t>(std::bit_cast<float>(magnitude) * 0x1p112f);
  const std::int32_t more = kBias * static_cast<std::int32_t>(magnitude >= kInfinity);
  return std::bit_cast<float>(static_cast<std::uint32_t>(scaled + more) |
                              static_cast<std::uint32_t>(sign) << 16);
}

/// The nearest half, ties to even. Finite values beyond the largest half, 65504, become 65504; inf
/// stays inf and NaN a NaN. Host halves (enter/half.h) follow the same rule.
inline std::uint16_t half_bits_of(float value) {
  constexpr std::int32_t kBias = 112 << 23, kLeastNormal = 113 << 23, kInfinity = 255 << 23;
  constexpr auto kLargest = std::bit_cast<std::int32_t>(65504.0f);
  const auto bits = std::bit_cast<std::int32_t>(value);
  const std::int32_t magnitude = bits & 0x7fffffff;
  const std::int32_t finite = magnitude < kLargest ? magnitude : kLargest;
  const std::int32_t normal = (finite - kBias + 0xfff + (finite >> 13 & 1)) >> 13;
  // The last place of a denormal half equals that of a float in 0.5 ... 1.
  const std::int32_t denormal = std::bit_cast<std::int32_t>(std::bit_cast<float>(finite) + 0.5f) -
                                std::bit_cast<std::int32_t>(0.5f);
  const std::int32_t special =
      0x7c00 | (magnitude >> 13 & 0x3ff) | static_cast<std::int32_t>(magnitude > kInfinity);
  const std::int32_t is_denormal = -static_cast<std::int32_t>(finite < kLeastNormal);
  const std::int32_t is_special = -static_cast<std::int32_t>(magnitude >= kInfinity);
  const std::int32_t number = (denormal & is_denormal) | (normal & ~is_denormal);
  return static_cast<std::uint16_t>((special & is_special) | (number & ~is_special) |
                                    (bits >> 16 & 0x8000));
}

}  // namespace limpid
