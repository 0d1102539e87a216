#include "complete/scattered_light.h"

#include <cmath>

#include <gtest/gtest.h>

namespace limpid {
namespace {

// Of light that meets water which swallows 99 parts for each that it scatters no more than about
// that part comes back, and deep water shows nothing of what lies under it.
TEST(ScatteredLight, BoundsAreOfTheLightThatComes) {
  ScatteredLightMaker maker;
  const Rgb<double> absorption{0.99, 0.99, 0.99}, scattering{0.01, 0.01, 0.01};
  const ScatteredLight& dark = maker.make({absorption, scattering, 0, 0.8})[1];
  EXPECT_GT(dark.most_sky, 0);
  EXPECT_LT(dark.most_sky, 0.05);
  EXPECT_LT(dark.most_sun, 0.01);
  EXPECT_LT(dark.beyond_sky[ScatteredLight::kLayers - 1], 1e-6);
  EXPECT_LT(dark.beyond_sun[ScatteredLight::kLayers - 1], 1e-6);
  // No deeper layer is farther from endless water than what lies over it.
  for (std::size_t k = 1; k < ScatteredLight::kLayers; ++k) {
    EXPECT_LE(dark.beyond_sky[k], dark.beyond_sky[k - 1]) << k;
    EXPECT_LE(dark.beyond_sun[k], dark.beyond_sun[k - 1]) << k;
  }
}

TEST(ScatteredLight, IsMadeAnewForOtherWater) {
  ScatteredLightMaker maker;
  const double clear = maker.make({{1, 1, 1}, {0.1, 0.1, 0.1}, 0, 0.8})[0].most_sun;
  const double murky = maker.make({{1, 1, 1}, {1, 1, 1}, 0, 0.8})[0].most_sun;
  EXPECT_GT(murky, 5 * clear);
  EXPECT_EQ(maker.make({{1, 1, 1}, {0.1, 0.1, 0.1}, 0, 0.8})[0].most_sun, clear);
}

}  // namespace
}  // namespace limpid
