#include "optics/scattered_light.h"

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "optics/absorption.h"

namespace limpid {
namespace {

constexpr double kPi = std::numbers::pi;

// The share of the phase function within 10 degrees, over its value there, summed over rings.
TEST(NarrowShare, IsThePeakOverItsFoot) {
  constexpr int kRings = 20000;
  constexpr double kStep = 10 * kPi / 180 / kRings;
  for (const double g : {0.1, 0.5, 0.9, 0.99}) {
    const double foot = henyey_greenstein(std::cos(kRings * kStep), g);
    double peak = 0;
    for (int i = 0; i < kRings; ++i) {
      const double angle = (i + 0.5) * kStep;
      peak += 2 * kPi * std::sin(angle) * kStep * (henyey_greenstein(std::cos(angle), g) - foot);
    }
    EXPECT_NEAR(narrow_share(g), peak, 1e-6) << g;
  }
}

TEST(NarrowShare, IsNoneOfWhatScattersEvenlyOrBack) {
  for (const double g : {-0.99, -0.5, 0.0, 1e-3}) EXPECT_EQ(narrow_share(g), 0) << g;
}

TEST(LayerVariable, HandWorked) {
  EXPECT_EQ(layer_variable(0.0), 0);
  EXPECT_EQ(layer_variable(2.0), 0.5);
  EXPECT_EQ(layer_variable(6.0), 0.75);
}

TEST(LayerPower, HandWorked) {
  // 1/2 + 2/4 + 3/8 + 4/16 + 5/32 + 6/64.
  const ScatteredLight::Power p{1, 2, 3, 4, 5, 6};
  EXPECT_EQ(layer_power(p, 0.5), 1.875);
  EXPECT_EQ(layer_power(p, 1.0), 21);
  EXPECT_EQ(layer_power(p, 0.0), 0) << "no layer, no light";
  const ScatteredLight::Power q{6, 5, 4, 3, 2, 1};  // 3 + 5/4 + 4/8 + 3/16 + 2/32 + 1/64
  EXPECT_EQ(layer_power(std::array{p, q}, std::array{2.0, -3.0}, 0.5), 2 * 1.875 - 3 * 5.015625);
  EXPECT_EQ(layer_power(std::array{p, q, q}, std::array{0.0, 1.0, 2.0}, 1.0), 63);
}

}  // namespace
}  // namespace limpid
