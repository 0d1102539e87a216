#include "optics/absorption.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "optics/lane_value.h"

namespace limpid {
namespace {

using test::Lane;
using test::value;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kPi = std::numbers::pi;

double lane_column_light(double rate, double path) {
  return value(column_light(Lane(rate), Lane(path)));
}
double lane_far_share(double rate, double path) { return value(far_share(Lane(rate), Lane(path))); }

/// (1 - exp(-tau)) / tau and its share, in extended precision.
double exact_column(double tau) {
  const long double t = tau;
  return static_cast<double>(t == 0 ? 1 : -std::expm1(-t) / t);
}
double exact_share(double tau) {
  const long double t = tau;
  if (tau < 1e-3) return static_cast<double>(0.5L - t / 12);
  return static_cast<double>(1 / t - 1 / std::expm1(t));
}

/// Optical depths from 1e-9 to 1e3, close together.
template <class Fn>
void each_depth(Fn&& fn) {
  for (double power = -9; power <= 3; power += 0.003) fn(static_cast<float>(std::pow(10, power)));
}

TEST(Transmittance, HandWorked) {
  const Rgb<double> t = transmittance(2.0, {0.340, 0.0565, 0.0});
  EXPECT_NEAR(t.r, 0.50662, 5e-6);  // exp(-0.68)
  EXPECT_NEAR(t.g, 0.89315, 5e-6);  // exp(-0.113)
  EXPECT_EQ(t.b, 1);
}

TEST(Transmittance, TwoWaysOneAfterTheOther) {
  const Rgb<double> sigma{0.34, 0.05, 0.009};
  const Rgb<double> product = transmittance(3.0, sigma) * transmittance(4.5, sigma);
  const Rgb<double> whole = transmittance(7.5, sigma);
  EXPECT_NEAR(product.r, whole.r, 1e-15);
  EXPECT_NEAR(product.g, whole.g, 1e-15);
  EXPECT_NEAR(product.b, whole.b, 1e-15);
}

TEST(Transmittance, ClearAtTheSurfaceAndNothingFarDown) {
  EXPECT_EQ(transmittance(0.0, {1e6, 1, 0}), (Rgb<double>{1, 1, 1}));
  EXPECT_EQ(transmittance(kInfinity, {1e6, 0.01, 0}), (Rgb<double>{0, 0, 1}));
  const auto lane = [](double path, double r, double g, double b) {
    return value(transmittance(Lane(path), Rgb<Lane>{Lane(r), Lane(g), Lane(b)}));
  };
  EXPECT_EQ(lane(0, 1e6, 1, 0), (Rgb<double>{1, 1, 1}));
  EXPECT_EQ(lane(kInfinity, 1e6, 0.01, 0), (Rgb<double>{0, 0, 1}));
}

TEST(ColumnLight, IsTheIntegral) {
  for (double rate : {0.0, 0.01, 0.4, 3.0}) {
    const double path = 2.5;
    const int steps = 2000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) sum += std::exp(-rate * path * (i + 0.5) / steps);
    EXPECT_NEAR(column_light(rate, path), sum * path / steps, 1e-5 * path);
  }
}

TEST(ColumnLight, Ends) {
  EXPECT_EQ(column_light(0.0, 7.0), 7);
  EXPECT_EQ(column_light(0.0, 0.0), 0);
  EXPECT_EQ(column_light(5.0, 0.0), 0);
  EXPECT_EQ(column_light(0.25, kInfinity), 4);
  EXPECT_EQ(column_light(0.0, kInfinity), 3e38);
  EXPECT_EQ(lane_column_light(0, 7), 7);
  EXPECT_EQ(lane_column_light(0, 0), 0);
  EXPECT_EQ(lane_column_light(0.25, kInfinity), 4);
  EXPECT_EQ(lane_column_light(1e6, kInfinity), 1e-6f);
  EXPECT_NEAR(lane_column_light(0, kInfinity), 3e38, 1e32);
}

TEST(ColumnLight, ErrorIsAsStated) {
  double worst = 0, lane_worst = 0;
  each_depth([&](double tau) {
    const double exact = exact_column(tau);
    worst = std::max(worst, std::abs(column_light(tau, 1.0) / exact - 1));
    lane_worst = std::max(lane_worst, std::abs(lane_column_light(tau, 1) / exact - 1));
  });
  std::printf("column_light: relative error %.2g in double, %.2g in float\n", worst, lane_worst);
  EXPECT_LE(worst, 1e-9);
  EXPECT_LE(lane_worst, 1e-6);
}

TEST(ColumnLight, GrowsWithThePathAndFallsWithTheRate) {
  double before = 0;
  for (double path = 0.01; path < 40; path += 0.01) {
    const double light = column_light(0.3, path);
    EXPECT_GT(light, before);
    EXPECT_LT(light, std::min(path, 1 / 0.3));
    EXPECT_LT(column_light(0.31, path), light);
    before = light;
  }
}

TEST(FarShare, IsTheMeanPlace) {
  for (double tau : {0.0, 0.1, 0.9, 1.1, 4.0}) {
    const int steps = 2000;
    double weight = 0, moment = 0;
    for (int i = 0; i < steps; ++i) {
      const double s = (i + 0.5) / steps, light = std::exp(-tau * s);
      weight += light;
      moment += light * s;
    }
    EXPECT_NEAR(far_share(tau / 5, 5.0), moment / weight, 1e-6) << tau;
  }
}

TEST(FarShare, Ends) {
  EXPECT_EQ(far_share(0.0, 3.0), 0.5);
  EXPECT_EQ(far_share(3.0, 0.0), 0.5);
  EXPECT_EQ(far_share(0.0, kInfinity), 0.5);
  EXPECT_NEAR(far_share(0.1, kInfinity), 0, 1e-30);
  EXPECT_NEAR(far_share(10.0, 10.0), 0.01, 1e-12);
  EXPECT_EQ(lane_far_share(0, kInfinity), 0.5);
  EXPECT_EQ(lane_far_share(1e6, kInfinity), 0);
}

TEST(FarShare, ErrorIsAsStatedAndItFallsFromAHalf) {
  double worst = 0, lane_worst = 0, before = 0.5;
  each_depth([&](double tau) {
    const double exact = exact_share(tau), share = far_share(tau, 1.0);
    worst = std::max(worst, std::abs(share / exact - 1));
    lane_worst = std::max(lane_worst, std::abs(lane_far_share(tau, 1) / exact - 1));
    EXPECT_LE(share, before);
    EXPECT_GE(share, 0);
    before = share;
  });
  std::printf("far_share: relative error %.2g in double, %.2g in float\n", worst, lane_worst);
  EXPECT_LE(worst, 1e-8);
  EXPECT_LE(lane_worst, 1e-6);
}

TEST(HenyeyGreenstein, IntegratesToOneWithMeanCosineG) {
  for (double g : {-0.99, -0.5, 0.0, 0.3, 0.9, 0.99}) {
    // The integral over u with cosine = 1 - 2 u^2, mirrored to the peak's side, spreads the peak.
    const int steps = 20000;
    double sum = 0, mean = 0;
    for (int i = 0; i < steps; ++i) {
      const double u = (i + 0.5) / steps;
      const double cosine = (g < 0 ? -1 : 1) * (1 - 2 * u * u);
      const double share = henyey_greenstein(cosine, g) * 2 * kPi * 4 * u / steps;
      sum += share;
      mean += share * cosine;
    }
    EXPECT_NEAR(sum, 1, 1e-5) << g;
    EXPECT_NEAR(mean, g, 1e-5) << g;
  }
}

TEST(HenyeyGreenstein, HandWorkedAndSymmetric) {
  EXPECT_NEAR(henyey_greenstein(0.3, 0.0), 1 / (4 * kPi), 1e-15);
  EXPECT_NEAR(henyey_greenstein(1.0, 0.5), 6 / (4 * kPi), 1e-14);  // 0.75 / 0.125
  EXPECT_NEAR(henyey_greenstein(-1.0, 0.5), 0.75 / 3.375 / (4 * kPi), 1e-15);
  for (double cosine : {-1.0, -0.2, 0.7, 1.0}) {
    EXPECT_EQ(henyey_greenstein(cosine, 0.8), henyey_greenstein(-cosine, -0.8));
  }
  double before = kInfinity;
  for (double cosine = 1; cosine >= -1; cosine -= 0.01) {
    EXPECT_LT(henyey_greenstein(cosine, 0.9), before);
    before = henyey_greenstein(cosine, 0.9);
  }
}

TEST(HenyeyGreenstein, CosinesThatRoundingMadeTooLargeAndLanes) {
  EXPECT_EQ(henyey_greenstein(1.0000001, 0.99), henyey_greenstein(1.0, 0.99));
  for (double g : {-0.99, 0.0, 0.99}) {
    for (double cosine : {-1.0, -0.5, 0.96875, 1.0}) {
      const double exact = henyey_greenstein(cosine, static_cast<double>(static_cast<float>(g)));
      EXPECT_NEAR(value(henyey_greenstein(Lane(cosine), Lane(g))) / exact, 1, 2e-6);
    }
  }
}

}  // namespace
}  // namespace limpid
