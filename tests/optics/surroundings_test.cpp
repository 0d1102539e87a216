#include "optics/surroundings.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "optics/lane_value.h"
#include "support.h"

namespace limpid {
namespace {

using test::Lane;

constexpr double kPi = std::numbers::pi;
constexpr Vec3<double> kUp{0, 1, 0};

// Vectors of any length, right up to the axes, where the octants meet.
TEST(Surroundings, LanesKnowTheArctangent) {
  double worst = 0;
  for (double size : {1e-30, 1e-3, 1.0, 1e30}) {
    for (int i = 0; i <= 7200; ++i) {
      const double angle = (i - 3600) * kPi / 3600 + (i % 3 - 1) * 1e-7;
      const float y = float(size * std::sin(angle)), x = float(size * std::cos(angle));
      const double error = test::value(atan2(Lane(y), Lane(x))) - std::atan2(double(y), double(x));
      worst = std::max(worst, std::abs(std::remainder(error, 2 * kPi)));
    }
  }
  EXPECT_LT(worst, 5e-7);
  EXPECT_GT(worst, 0);
  EXPECT_EQ(test::value(atan2(Lane(0), Lane(0))), 0);
  EXPECT_EQ(atan2(0.0, 0.0), 0);
}

TEST(Surroundings, PlacesOfTheAxes) {
  const auto expect = [](Vec3<double> d, double x, double y) {
    const Vec2<double> place = lat_long(d.x, d.y, d.z);
    EXPECT_NEAR(std::remainder(place.x - x, 1), 0, 1e-15);
    EXPECT_NEAR(place.y, y, 1e-15);
  };
  expect({1, 0, 0}, 0.5, 0.5);
  expect({0, 1, 0}, 0.75, 0.5);
  expect({0, -1, 0}, 0.25, 0.5);
  expect({-1, 0, 0}, 0, 0.5);
  expect({0, 0, 1}, 0.5, 0);
  expect({0, 0, -1}, 0.5, 1);
  expect({3, 0, 3}, 0.5, 0.25);
}

// Also in float near the poles, where an arccosine of the height would be off by 3e-4.
TEST(Surroundings, PlacesAreThoseOfTheirAnglesInLanesToo) {
  for (double polar : {1e-5, 0.3, 1.5, 3.0, kPi - 1e-5}) {
    for (double turn : {-3.1, -1.0, 0.2, 2.0}) {
      const Vec3<double> d{std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn),
                           std::cos(polar)};
      const Vec2<double> place = lat_long(d.x, d.y, d.z);
      EXPECT_NEAR(place.x, 0.5 + turn / (2 * kPi), 1e-9);
      EXPECT_NEAR(place.y, polar / kPi, 1e-12);
      const Vec2<Lane> lane = lat_long(Lane(d.x), Lane(d.y), Lane(d.z));
      EXPECT_NEAR(test::value(lane.x), place.x, 3e-7);
      EXPECT_NEAR(test::value(lane.y), place.y, 3e-7);
    }
  }
}

TEST(Surroundings, LiftsWhatGoesBelowTheHorizonAndNothingElse) {
  const auto near = [](Vec3<double> a, Vec3<double> b) { EXPECT_LT(length(a - b), 1e-15); };
  near(lifted({0.6, 0.8, 0}, kUp), {0.6, 0.8, 0});
  near(lifted({0.6, 0, 0.8}, kUp), {0.6, 0, 0.8});
  near(lifted({0.6, -0.8, 0}, kUp), {1, 0, 0});
  near(lifted({0, -1, 0}, kUp), kUp);
  near(lifted({0.6, 0.8, 0}, -1.0 * kUp), {1, 0, 0});
  for (int i = 0; i < 200; ++i) {
    const auto part = [&](int k) { return 2.0 * test::noise(i, k, 1) - 1; };
    const Vec3<double> d = normalize_or<double>({part(0), part(1), part(2)}, kUp);
    EXPECT_NEAR(length(lifted(d, kUp)), 1, 1e-12);
    EXPECT_GE(lifted(d, kUp).y, 0);
  }
}

}  // namespace
}  // namespace limpid
