#include "optics/fresnel.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace limpid {
namespace {

constexpr double kWater = 1.333;
constexpr double kF0 = 0.020373;
constexpr double kDegree = std::numbers::pi / 180;

double exact(double degrees, double ior = kWater) {
  return fresnel_exact(std::cos(degrees * kDegree), ior);
}
double schlick(double degrees) { return fresnel_schlick(std::cos(degrees * kDegree), kF0); }
double rim(double degrees) { return fresnel_rim(std::cos(degrees * kDegree), 3.0); }

TEST(Fresnel, HitsTheTablesToTheirLastDigit) {
  struct Row {
    double degrees, exact, schlick, rim;
  };
  constexpr Row kTable[] = {{0, .0204, .0204, 0},
                            {45, .0279, .0225, .0251},
                            {60, .0597, .0510, .1250},
                            {75, .2124, .2395, .4072},
                            {85, .5835, .6413, .7607}};
  for (const Row& row : kTable) {
    EXPECT_NEAR(exact(row.degrees), row.exact, 5e-5) << row.degrees;
    EXPECT_NEAR(schlick(row.degrees), row.schlick, 5e-5) << row.degrees;
    EXPECT_NEAR(rim(row.degrees), row.rim, 5e-5) << row.degrees;
  }
}

TEST(Fresnel, ExactHasTheClosedFormsAtItsEnds) {
  const double f0 = std::pow((kWater - 1) / (kWater + 1), 2);
  EXPECT_NEAR(exact(0), f0, 1e-15);
  EXPECT_NEAR(exact(90), 1, 1e-12);
  EXPECT_NEAR(f0, kF0, 5e-7);
}

TEST(Fresnel, ExactRisesFromF0ToOne) {
  double before = exact(0);
  for (double degrees = 0.25; degrees <= 90; degrees += 0.25) {
    EXPECT_GT(exact(degrees), before) << degrees;
    EXPECT_LE(exact(degrees), 1) << degrees;
    before = exact(degrees);
  }
}

// p-polarised light is not reflected at the Brewster angle: only half of the s term is left,
// 0.5 ((n^2 - 1) / (n^2 + 1))^2.
TEST(Fresnel, OnlySPolarisedLightAtTheBrewsterAngle) {
  const double brewster = std::atan(kWater) / kDegree;
  EXPECT_NEAR(brewster, 53.12, 5e-3);
  const double n2 = kWater * kWater;
  EXPECT_NEAR(exact(brewster), 0.5 * std::pow((n2 - 1) / (n2 + 1), 2), 1e-14);
  const double c = std::cos(brewster * kDegree), g = std::sqrt(n2 - 1 + c * c);
  EXPECT_NEAR(c * (g + c) - 1, 0, 1e-14);
}

TEST(Fresnel, TotalReflectionFromBelowStartsAtTheCriticalAngle) {
  const double critical = std::asin(1 / kWater) / kDegree;
  EXPECT_NEAR(critical, 48.61, 5e-3);
  EXPECT_EQ(exact(48.62, 1 / kWater), 1);
  EXPECT_LT(exact(48.60, 1 / kWater), 1);
  EXPECT_NEAR(exact(critical - 1e-9, 1 / kWater), 1, 1e-3);
  for (double degrees = 49; degrees <= 90; degrees += 1) EXPECT_EQ(exact(degrees, 1 / kWater), 1);
}

// Stokes: light on the reversed path is reflected as much.
TEST(Fresnel, SameFromBothSidesAlongOnePath) {
  for (double above : {0.0, 10.0, 45.0, 60.0, 85.0}) {
    const double below = std::asin(std::sin(above * kDegree) / kWater) / kDegree;
    EXPECT_NEAR(exact(above), exact(below, 1 / kWater), 1e-12) << above;
  }
}

TEST(Fresnel, NoSurfaceReflectsNothing) {
  for (double degrees : {0.0, 30.0, 60.0, 89.0}) EXPECT_NEAR(exact(degrees, 1), 0, 1e-15);
}

TEST(Fresnel, NormalsThatFaceAwayCountAsGrazing) {
  for (double cosine : {-1.0, -0.3, 0.0}) {
    EXPECT_EQ(fresnel_exact(cosine, kWater), 1);
    EXPECT_EQ(fresnel_schlick(cosine, kF0), 1);
  }
  EXPECT_EQ(fresnel_rim(-0.3, 3.0), fresnel_rim(0.3, 3.0));
  EXPECT_EQ(fresnel_exact(1.0000001, kWater), fresnel_exact(1.0, kWater));
  EXPECT_EQ(fresnel_rim(1.0000001, 3.0), 0);
}

TEST(Fresnel, LinearAndInversePowerHandWorked) {
  EXPECT_NEAR(fresnel_linear(std::cos(60 * kDegree)), 0.5, 1e-15);
  EXPECT_EQ(fresnel_linear(1.0), 0);
  EXPECT_EQ(fresnel_linear(0.0), 1);
  EXPECT_NEAR(fresnel_inverse_power(0.5, 1.0, 3.0), 0.875, 1e-15);
  EXPECT_NEAR(fresnel_inverse_power(0.5, 0.4, 2.0), 0.9, 1e-15);
  EXPECT_NEAR(fresnel_inverse_power(1.0, 0.4, 2.0), 0.6, 1e-15);
  EXPECT_EQ(fresnel_inverse_power(0.9, 0.0, 3.0), 1);
}

TEST(Fresnel, LinearAndInversePowerStayBetweenZeroAndOneAndRise) {
  for (double intensity : {0.5, 1.0, 5.0}) {
    double linear_before = 0, power_before = 0;
    for (double cosine = 1.1; cosine >= -1; cosine -= 0.01) {
      const double linear = fresnel_linear(cosine);
      const double power = fresnel_inverse_power(cosine, intensity, 3.0);
      EXPECT_GE(linear, linear_before);
      EXPECT_GE(power, power_before);
      linear_before = linear;
      power_before = power;
    }
    EXPECT_EQ(linear_before, 1);
    EXPECT_EQ(power_before, 1);
  }
  // Where the article's own formula is 1 - 5 * 0.729 = -2.6.
  EXPECT_EQ(fresnel_inverse_power(0.9, 5.0, 3.0), 0);
}

TEST(Fresnel, ApproximationsAreAsFarOffAsTheySay) {
  double schlick_worst = 0, schlick_at = 0, rim_worst = 0, rim_at = 0;
  double linear_worst = 0, linear_at = 0;
  for (double degrees = 0; degrees <= 90; degrees += 0.1) {
    const double s = std::abs(schlick(degrees) - exact(degrees));
    const double r = rim(degrees) - exact(degrees);
    if (s > schlick_worst) schlick_worst = s, schlick_at = degrees;
    if (r > rim_worst) rim_worst = r, rim_at = degrees;
    const double l = fresnel_linear(std::cos(degrees * kDegree)) - exact(degrees);
    if (l > linear_worst) linear_worst = l, linear_at = degrees;
  }
  EXPECT_LE(schlick_worst, 0.06);
  EXPECT_GE(schlick_worst, 0.055);
  EXPECT_NEAR(schlick_at, 84, 1);
  EXPECT_NEAR(rim_worst, 0.216, 1e-3);
  EXPECT_NEAR(rim_at, 80, 1);
  EXPECT_NEAR(linear_worst, 0.53, 5e-3);
  EXPECT_NEAR(linear_at, 73, 1);
}

}  // namespace
}  // namespace limpid
