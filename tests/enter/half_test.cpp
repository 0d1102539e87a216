#include "enter/half.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "limpid/core/simd.h"

namespace limpid {
namespace {

/// All halves but NaN, as floats.
std::vector<float> all_halves() {
  std::vector<float> all;
  for (int bits = 0; bits < 65536; ++bits) {
    if ((bits & 0x7c00) == 0x7c00 && (bits & 0x3ff) != 0) continue;
    const auto half = static_cast<std::uint16_t>(bits);
    all.push_back(0);
    half_target("scalar").widen(reinterpret_cast<const std::byte*>(&half), 2, &all.back(), 1);
  }
  return all;
}

TEST(Half, WhatIsExactComesBackAndNothingElsePasses) {
  const std::vector<float> all = all_halves();
  const auto count = static_cast<int>(all.size());
  for (const std::string& simd : simd_targets()) {
    const HalfTarget& target = half_target(simd);
    std::vector<std::byte> halves(2 * all.size());
    std::vector<float> again(all.size());
    ASSERT_TRUE(target.narrow_exactly(all.data(), halves.data(), count)) << simd;
    target.widen(halves.data(), 2, again.data(), count);
    for (std::size_t i = 0; i < all.size(); ++i) {
      EXPECT_EQ(std::bit_cast<std::uint32_t>(all[i]), std::bit_cast<std::uint32_t>(again[i]));
    }
    for (const float near : {1.0f, 0.1f, 6e-8f, 7e-5f, 65504.0f}) {
      const float between = std::nextafterf(near, 2 * near);
      // The value between two halves lies anywhere in a run, and behind the last whole vector.
      for (const std::size_t at : {0, 9, 16, 17}) {
        std::vector<float> run(18, 0.5f);
        EXPECT_TRUE(target.narrow_exactly(run.data(), halves.data(), 18)) << simd;
        run[at] = between;
        EXPECT_FALSE(target.narrow_exactly(run.data(), halves.data(), 18)) << simd << ", " << at;
      }
    }
  }
}

}  // namespace
}  // namespace limpid
