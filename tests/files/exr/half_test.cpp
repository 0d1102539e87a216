#include "enter/half.h"

#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <Imath/half.h>
#include <gtest/gtest.h>

#include "limpid/core/simd.h"

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

/// What a host's buffer gets and what a file gets: one rule, two ways to compute it.
TEST(HalfBits, AreThoseOfHostsToo) {
  std::vector<float> floats;
  for (std::uint32_t high = 0; high < 0x10000; ++high) {
    for (const std::uint32_t low : {0x0000u, 0x0001u, 0x0fffu, 0x1000u, 0x1001u, 0x8000u, 0xffffu})
      floats.push_back(std::bit_cast<float>(high << 16 | low));
  }
  std::vector<std::uint16_t> halves(floats.size());
  for (const std::string& simd : simd_targets()) {
    half_target(simd).narrow(floats.data(), reinterpret_cast<std::byte*>(halves.data()), 2,
                             static_cast<int>(floats.size()));
    for (std::size_t i = 0; i < floats.size(); ++i) {
      ASSERT_TRUE(halves[i] == half_bits_of(floats[i]) ||
                  (std::isnan(floats[i]) && std::isnan(float_of(halves[i]))))
          << simd << ": " << floats[i] << " -> " << float_of(halves[i]);
    }
  }
}

}  // namespace
}  // namespace limpid
