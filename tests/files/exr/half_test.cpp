#include <bit>
#include <cmath>
#include <limits>

#include <Imath/half.h>
#include <gtest/gtest.h>

#include "files/exr/half_bits.h"

namespace limpid {
namespace {

float float_of(int bits) {
  half value;
  value.setBits(static_cast<std::uint16_t>(bits));
  return value;
}

TEST(HalfBits, EveryHalfBecomesItsFloat) {
  for (int bits = 0; bits < 0x10000; ++bits) {
    const float ours = float_of_half(static_cast<std::uint16_t>(bits));
    ASSERT_EQ(std::bit_cast<std::uint32_t>(ours), std::bit_cast<std::uint32_t>(float_of(bits)))
        << std::hex << bits;
  }
}

TEST(HalfBits, EveryHalfComesBack) {
  for (int bits = 0; bits < 0x10000; ++bits) {
    const std::uint16_t back = half_bits_of(float_of(bits));
    ASSERT_TRUE(back == bits || (std::isnan(float_of(bits)) && std::isnan(float_of(back))))
        << std::hex << bits << " -> " << back;
  }
}

/// Between each two halves that follow one another, where rounding turns.
TEST(HalfBits, FloatsBecomeTheNearestHalfTiesToEven) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (int bits = 0; bits < 0x7bff; ++bits) {
    const float middle = (float_of(bits) + float_of(bits + 1)) / 2;
    const int even = bits % 2 == 0 ? bits : bits + 1;
    ASSERT_EQ(half_bits_of(std::nextafter(middle, 0.0f)), bits);
    ASSERT_EQ(half_bits_of(middle), even);
    ASSERT_EQ(half_bits_of(std::nextafter(middle, kInfinity)), bits + 1);
    ASSERT_EQ(half_bits_of(-middle), even | 0x8000);
  }
}

TEST(HalfBits, WhatIsTooLargeBecomesTheLargestButInfStaysInf) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(float_of(half_bits_of(65519)), 65504);
  EXPECT_EQ(float_of(half_bits_of(65520)), 65504);
  EXPECT_EQ(float_of(half_bits_of(-1e30f)), -65504);
  EXPECT_EQ(float_of(half_bits_of(std::numeric_limits<float>::max())), 65504);
  EXPECT_EQ(float_of(half_bits_of(kInfinity)), kInfinity);
  EXPECT_EQ(float_of(half_bits_of(-kInfinity)), -kInfinity);
  EXPECT_TRUE(std::isnan(float_of(half_bits_of(std::nanf("")))));
  EXPECT_TRUE(std::isnan(float_of(half_bits_of(std::bit_cast<float>(0x7f800001)))));
  EXPECT_EQ(half_bits_of(std::numeric_limits<float>::denorm_min()), 0);
}

}  // namespace
}  // namespace limpid
