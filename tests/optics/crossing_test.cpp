#include "optics/crossing.h"

#include <gtest/gtest.h>

#include "optics/fresnel.h"

namespace limpid {
namespace {

constexpr double kWater = 1.333;

/// The reflected share of even light from a half sphere.
double diffuse_reflectance(double ior) {
  const int steps = 200000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double cosine = (i + 0.5) / steps;
    sum += fresnel_exact(cosine, ior) * 2 * cosine / steps;
  }
  return sum;
}

TEST(Crossing, DiffuseReflectancesAreTheIntegrals) {
  EXPECT_NEAR(diffuse_reflectance(kWater), kDiffuseAirToWater, 5e-5);
  EXPECT_NEAR(diffuse_reflectance(1 / kWater), kDiffuseWaterToAir, 5e-5);
  EXPECT_NEAR((1 - kDiffuseAirToWater) / (kWater * kWater), 1 - kDiffuseWaterToAir, 1e-4);
}

TEST(Crossing, StraightDownAndUp) {
  const double f0 = fresnel_exact(1.0, kWater);
  EXPECT_NEAR(radiance_crossing(kWater, f0), 0.5513, 5e-5);  // .97963 / 1.77689
  EXPECT_NEAR((1 - f0) * radiance_crossing(kWater, f0), 0.5401, 5e-5);
  // With the light that the surface throws back at a bottom of albedo 0.5.
  EXPECT_NEAR((1 - f0) * radiance_crossing(kWater, f0) / (1 - kDiffuseWaterToAir * 0.5), 0.708,
              5e-4);
}

TEST(Crossing, Ends) {
  EXPECT_EQ(radiance_crossing(1.0, 0.0), 1);
  EXPECT_EQ(radiance_crossing(kWater, 1.0), 0);
}

}  // namespace
}  // namespace limpid
