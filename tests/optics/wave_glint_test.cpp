#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "optics/highlight.h"
#include "optics/lane_value.h"
#include "support.h"

// The sun in water whose waves are too small to be seen.

namespace limpid {
namespace {

constexpr double kPi = std::numbers::pi, kDegree = kPi / 180, kWater = 1.333;
constexpr double kRadius = 0.2665 * kDegree;
constexpr Vec3<double> kUp{0, 1, 0}, kX{1, 0, 0}, kY{0, 0, -1};

Vec3<double> leaning(double degrees, double turn = 0) {
  const double across = std::sin(degrees * kDegree);
  return {across * std::cos(turn * kDegree), std::cos(degrees * kDegree),
          across * std::sin(turn * kDegree)};
}

double lobe(Vec3<double> n, Vec3<double> v, Vec3<double> l, Sym2<double> spread) {
  return wave_glint_lobe(n, v, l, kUp, kX, kY, spread, kRadius, kWater);
}

TEST(SlopeDensity, IntegratesToOneWithItsCovariance) {
  const Sym2<double> c{0.04, 0.01, 0.02};
  double one = 0, xx = 0, xy = 0, yy = 0;
  constexpr double kStep = 0.005;
  for (double x = -1; x < 1; x += kStep) {
    for (double y = -1; y < 1; y += kStep) {
      const double share = slope_density(c, Vec2<double>{x, y}) * kStep * kStep;
      one += share, xx += share * x * x, xy += share * x * y, yy += share * y * y;
    }
  }
  EXPECT_NEAR(one, 1, 1e-3);
  EXPECT_NEAR(xx, c.xx, 1e-4);
  EXPECT_NEAR(xy, c.xy, 1e-4);
  EXPECT_NEAR(yy, c.yy, 1e-4);
  EXPECT_EQ(slope_density(c, Vec2<double>{0.7, 0}), 0) << "compact";
}

/// Light that leaves the surface of one sun's irradiance, summed over all viewers.
double sent_back(Vec3<double> l, Sym2<double> spread) {
  double sum = 0;
  constexpr int kRings = 1500, kSpokes = 3000;
  for (int i = 0; i < kRings; ++i) {
    const double angle = 0.5 * kPi * (i + 0.5) / kRings;
    const double area = 0.5 * kPi / kRings * std::sin(angle) * 2 * kPi / kSpokes;
    for (int k = 0; k < kSpokes; ++k) {
      const double turn = 2 * kPi * (k + 0.5) / kSpokes;
      const Vec3<double> v{std::sin(angle) * std::cos(turn), std::cos(angle),
                           std::sin(angle) * std::sin(turn)};
      sum += area * v.y * lobe(kUp, v, l, spread);
    }
  }
  return sum;
}

// The law holds for any spread, and for the disc alone, too.
TEST(WaveGlint, HasTheEnergyOfTheDiscMirrored) {
  for (const double angle : {20.0, 50.0}) {
    const Vec3<double> l = leaning(angle);
    const double mirrored = l.y * fresnel_exact(l.y, kWater);
    EXPECT_NEAR(sent_back(l, {0, 0, 0}), mirrored, 0.03 * mirrored) << angle;
    EXPECT_NEAR(sent_back(l, {1e-3, 0, 2e-4}), mirrored, 0.03 * mirrored) << angle;
    EXPECT_NEAR(sent_back(l, {0.004, 0.002, 0.003}), mirrored, 0.06 * mirrored) << angle;
  }
}

TEST(WaveGlint, OfStillWaterIsTheBrightest) {
  const double mirrored = lobe(kUp, kUp, kUp, {0, 0, 0}) / fresnel_exact(1.0, kWater);
  EXPECT_NEAR(mirrored * kRadius * kRadius, kBrightestLobe, 1e-6 * kBrightestLobe);
}

// The axes belong to the lookup, not the water: turned together, view, light and facet see the
// same.
TEST(WaveGlint, IsTheSameAllAround) {
  const auto turned = [](double turn) {
    return lobe(leaning(20, turn), leaning(-15, turn), leaning(55.1, turn), {1e-6, 0, 1e-6});
  };
  ASSERT_GT(turned(0), 0);
  for (const double turn : {30.0, 90.0, 200.0}) {
    EXPECT_NEAR(turned(turn), turned(0), 1e-6 * turned(0)) << turn;
  }
}

TEST(WaveGlint, FollowsTheMeanFacet) {
  const Vec3<double> v = leaning(-60), l = leaning(20), n = leaning(-20);
  EXPECT_GT(lobe(n, v, l, {1e-5, 0, 1e-5}), 50);
  EXPECT_EQ(lobe(kUp, v, l, {1e-5, 0, 1e-5}), 0);
  // The spread lies along the plane of incidence, not across.
  const Vec3<double> beside = leaning(30);
  EXPECT_GT(lobe(n, v, beside, {0.01, 0, 1e-6}), 0);
  EXPECT_EQ(lobe(n, v, beside, {1e-6, 0, 0.01}), 0);
}

TEST(WaveGlint, NothingBreaksAtTheEdges) {
  const double brightest = kBrightestLobe / (kRadius * kRadius);
  for (const double spread : {0.0, 1e-12, 1e-3, 1.0, 1e6}) {
    for (const double viewer : {-180.0, -90.0, -89.99, -30.0, 0.0, 60.0, 89.99, 90.0}) {
      for (const double sun : {-120.0, -90.0, -89.99, 0.0, 30.0, 89.99, 90.0}) {
        for (const double tilt : {-80.0, 0.0, 95.0}) {
          const double got =
              lobe(leaning(tilt, 40), leaning(viewer), leaning(sun), {spread, 0, 0.5 * spread});
          EXPECT_TRUE(got >= 0 && got <= brightest) << spread << " " << viewer << " " << sun;
        }
      }
    }
  }
  EXPECT_EQ(lobe(kUp, leaning(30), leaning(120), {0.1, 0, 0.1}), 0) << "after sunset";
}

TEST(WaveGlint, LanesStayNear) {
  using test::Lane, test::lanes, test::value;
  for (const double spread : {0.0, 1e-5, 1e-3, 0.1}) {
    const Sym2<double> c{spread, 0.2 * spread, 0.4 * spread};
    const Sym2<Lane> c_lane{Lane(c.xx), Lane(c.xy), Lane(c.yy)};
    for (const double off : {0.0, 0.1, 1.0}) {
      const Vec3<double> v = leaning(-40), l = leaning(40 + off);
      const double exact = lobe(kUp, v, l, c);
      const double lane =
          value(wave_glint_lobe(lanes(kUp), lanes(v), lanes(l), lanes(kUp), lanes(kX), lanes(kY),
                                c_lane, Lane(kRadius), Lane(kWater)));
      EXPECT_NEAR(lane, exact, 2e-3 * exact + 1e-3) << spread << " " << off;
    }
  }
}

}  // namespace
}  // namespace limpid
