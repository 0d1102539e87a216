#include "optics/refract.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "optics/lane_value.h"
#include "support.h"

namespace limpid {
namespace {

constexpr double kWater = 1.333;
constexpr double kDegree = std::numbers::pi / 180;
constexpr Vec3<double> kUp{0, 1, 0};

/// The direction in the plane z = 0, that many degrees from straight up towards +x.
Vec3<double> leaning(double degrees) {
  return {std::sin(degrees * kDegree), std::cos(degrees * kDegree), 0};
}

Vec3<double> random_unit(int i, int channel) {
  const auto coordinate = [=](int k) { return 2.0 * test::noise(i, k, channel) - 1; };
  return normalize_or<double>({coordinate(0), coordinate(1), coordinate(2)}, kUp);
}

/// The direction's degrees from straight down.
double bent(double degrees, double eta) {
  const Vec3<double> d = refract(leaning(degrees), kUp, eta).direction;
  return std::atan2(std::hypot(d.x, d.z), -d.y) / kDegree;
}

/// The distance of the ray from the foot point at depth 1.
double lateral(double degrees, double ior) {
  const Vec3<double> d = refract(leaning(degrees), kUp, 1 / ior).direction;
  return d.x / d.y;
}

TEST(Refract, HandWorked) {
  // eta = sin 30 / sin 45, so 45 degrees become 30.
  EXPECT_NEAR(bent(45, std::sqrt(0.5)), 30, 1e-12);
  const Refracted<double> r = refract(leaning(45), kUp, std::sqrt(0.5));
  EXPECT_NEAR(r.direction.x, -0.5, 1e-15);
  EXPECT_NEAR(r.direction.y, -std::sqrt(0.75), 1e-15);
  EXPECT_EQ(r.total, 0);
  EXPECT_NEAR(refracted_cosine(std::sqrt(0.5), std::sqrt(0.5)), std::sqrt(0.75), 1e-15);
}

TEST(Refract, HitsTheTablesToTheirLastDigit) {
  struct Row {
    double degrees, error_at_550, error_at_550_digit, path_ratio;
  };
  constexpr Row kTable[] = {{30, .173, 5e-4, 1.07},
                            {45, .375, 5e-4, 1.20},
                            {60, .879, 5e-4, 1.52},
                            {75, 2.68, 5e-3, 2.66}};
  for (const Row& row : kTable) {
    // A ray that goes straight on lands this much farther out, for green light (550 nm).
    EXPECT_NEAR(std::tan(row.degrees * kDegree) - lateral(row.degrees, 1.33468), row.error_at_550,
                row.error_at_550_digit)
        << row.degrees;
    const double straight = std::cos(row.degrees * kDegree);
    EXPECT_NEAR(refracted_cosine(straight, 1 / kWater) / straight, row.path_ratio, 5e-3)
        << row.degrees;
  }
}

// Depths of the image of a point 1 below a flat surface.
TEST(Refract, ApparentDepths) {
  const double almost_down = 1e-4;
  EXPECT_NEAR(lateral(almost_down, kWater) / std::tan(almost_down * kDegree), 0.750, 5e-4);
  // At 60 degrees the image is astigmatic. Sagittal: where rays that leave round the vertical axis
  // meet. Tangential: where neighbouring rays in the plane of incidence meet.
  const double outside = std::tan(60 * kDegree);
  EXPECT_NEAR(lateral(60, kWater) / outside, 0.493, 5e-4);
  const double step = 1e-4;
  const double spread = lateral(60 + step, kWater) - lateral(60 - step, kWater);
  const double outside_spread = std::tan((60 + step) * kDegree) - std::tan((60 - step) * kDegree);
  EXPECT_NEAR(spread / outside_spread, 0.213, 5e-4);
}

TEST(Refract, UnitInThePlaneOfIncidenceAndBySnellsLaw) {
  for (int i = 0; i < 500; ++i) {
    const Vec3<double> v = random_unit(i, 1), n = random_unit(i, 2);
    for (double eta : {1 / kWater, 1.0, kWater}) {
      const auto [d, total] = refract(v, n, eta);
      EXPECT_NEAR(length(d), 1, 1e-12);
      EXPECT_LE(dot(d, n), 1e-12);  // never back to the viewer
      const double cosine = dot(v, n), sine = std::sqrt(1 - cosine * cosine);
      if (total == 1) {
        EXPECT_GT(eta * sine, 1);
        EXPECT_NEAR(dot(d, n), 0, 1e-12);
        continue;
      }
      EXPECT_NEAR(dot(d, n), -refracted_cosine(cosine, eta), 1e-12);
      const Vec3<double> along = d - dot(d, n) * n, from = cosine * n - v;
      EXPECT_NEAR(length(along - eta * from), 0, 1e-12);
    }
  }
}

TEST(Refract, TheWayBackIsTheSame) {
  for (double degrees : {0.0, 10.0, 45.0, 60.0, 85.0, 89.9}) {
    const Vec3<double> v = leaning(degrees);
    const Vec3<double> down = refract(v, kUp, 1 / kWater).direction;
    const Vec3<double> back = refract(down, {0, -1, 0}, kWater).direction;
    EXPECT_NEAR(length(back - v), 0, 1e-7) << degrees;
    EXPECT_NEAR(refracted_cosine(-down.y, kWater), v.y, 1e-12) << degrees;
  }
}

TEST(Refract, StraightOnWithoutASurfaceOrFromAbove) {
  for (int i = 0; i < 100; ++i) {
    const Vec3<double> v = random_unit(i, 1), n = random_unit(i, 2);
    const Vec3<double> facing = dot(v, n) < 0 ? -1.0 * n : n;
    EXPECT_NEAR(length(refract(v, facing, 1.0).direction + v), 0, 1e-12);
    EXPECT_NEAR(length(refract(v, v, 1 / kWater).direction + v), 0, 1e-7);
    EXPECT_NEAR(length(refract(v, v, kWater).direction + v), 0, 1e-7);
  }
}

TEST(Refract, SteeperThanTheViewAndNeverBeyondTheCriticalAngle) {
  const double critical = std::asin(1 / kWater) / kDegree;
  EXPECT_NEAR(critical, 48.61, 5e-3);
  double before = 0;
  for (double degrees = 0.5; degrees <= 90; degrees += 0.5) {
    const double angle = bent(degrees, 1 / kWater);
    EXPECT_GT(angle, before);
    EXPECT_LT(angle, degrees);
    EXPECT_LE(angle, critical + 1e-12);
    before = angle;
  }
  EXPECT_NEAR(before, critical, 1e-12);
}

TEST(Refract, TotalReflectionFromBelowIsFlaggedAndGoesAlongTheSurface) {
  EXPECT_EQ(refract(leaning(48.60), kUp, kWater).total, 0);
  EXPECT_NEAR(bent(48.60, kWater), 89.18, 5e-3);
  for (double degrees : {48.62, 60.0, 89.0, 90.0}) {
    const auto [d, total] = refract(leaning(degrees), kUp, kWater);
    EXPECT_EQ(total, 1) << degrees;
    EXPECT_NEAR(length(d - Vec3<double>{-1, 0, 0}), 0, 1e-12) << degrees;
    EXPECT_EQ(refracted_cosine(std::cos(degrees * kDegree), kWater), 0);
  }
}

TEST(Refract, FacetsSeenFromBehindStillBendIntoTheWater) {
  for (double degrees : {90.0, 91.0, 120.0, 180.0}) {
    const auto [d, total] = refract(leaning(degrees), kUp, 1 / kWater);
    EXPECT_NEAR(length(d), 1, 1e-12);
    EXPECT_LT(d.y, -0.6);
    EXPECT_EQ(total, 0);
  }
  EXPECT_NEAR(bent(90.001, 1 / kWater), bent(89.999, 1 / kWater), 1e-9);
}

TEST(Refract, VectorsThatRoundingMadeTooLongGiveNoNan) {
  const Vec3<double> longer = (1 + 1e-12) * kUp;
  EXPECT_NEAR(length(refract(longer, longer, kWater).direction + longer), 0, 1e-11);
  EXPECT_EQ(refracted_cosine(1.0 + 1e-7, kWater), 1);
  EXPECT_EQ(refracted_cosine(-1.0 - 1e-7, kWater), 1);
}

TEST(Refract, MirrorIsItsOwnInverse) {
  EXPECT_NEAR(length(mirror(leaning(30), kUp) - leaning(-30)), 0, 1e-15);
  for (int i = 0; i < 100; ++i) {
    const Vec3<double> v = random_unit(i, 1), n = random_unit(i, 2);
    const Vec3<double> r = mirror(v, n);
    EXPECT_NEAR(length(r), 1, 1e-12);
    EXPECT_NEAR(dot(r, n), dot(v, n), 1e-12);
    EXPECT_NEAR(length(mirror(r, n) - v), 0, 1e-12);
  }
}

TEST(Refract, LanesStayNearAwayFromTheCriticalAngle) {
  using test::Lane, test::lanes, test::value;
  for (int i = 0; i < 500; ++i) {
    const Vec3<double> v = random_unit(i, 1), n = random_unit(i, 2);
    for (double eta : {1 / kWater, kWater}) {
      const auto exact = refract(v, n, eta);
      const auto lane = refract(lanes(v), lanes(n), Lane(eta));
      const double cosine = dot(v, n);
      if (std::abs(1 - eta * eta * (1 - cosine * cosine)) < 1e-2) continue;
      EXPECT_EQ(value(lane.total), exact.total);
      EXPECT_NEAR(length(value(lane.direction) - exact.direction), 0, 5e-6);
    }
  }
}

}  // namespace
}  // namespace limpid
