#include "optics/highlight.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "optics/lane_value.h"
#include "support.h"

namespace limpid {
namespace {

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

TEST(Highlight, HandWorkedAngles) {
  // Light at 30 degrees, viewer above: half vector at 15, mirrored light at -30.
  EXPECT_NEAR(blinn_phong_lobe(kUp, kUp, leaning(30), 200.0), 9.743e-4, 1e-6);  // cos(15 deg)^200
  EXPECT_NEAR(phong_lobe(kUp, kUp, leaning(30), 2.0), 0.75, 1e-12);             // cos(30 deg)^2
  EXPECT_NEAR(phong_lobe(kUp, leaning(-30), leaning(30), 200.0), 1, 1e-12);
  EXPECT_NEAR(blinn_phong_lobe(kUp, leaning(-30), leaning(30), 200.0), 1, 1e-12);
  EXPECT_NEAR(blinn_phong_lobe(leaning(25), leaning(10), leaning(40), 1000.0), 1, 1e-12);
}

TEST(Highlight, StaysBetweenZeroAndOneAndSwapsLightAndViewer) {
  for (int i = 0; i < 500; ++i) {
    const Vec3<double> n = random_unit(i, 1), v = random_unit(i, 2), l = random_unit(i, 3);
    for (double power : {0.0, 1.0, 25.0, 200.0, 1e5}) {
      for (auto lobe : {phong_lobe<double>, blinn_phong_lobe<double>}) {
        const double value = lobe(n, v, l, power);
        EXPECT_GE(value, 0);
        EXPECT_LE(value, 1 + 1e-9);
        EXPECT_NEAR(value, lobe(n, l, v, power), 1e-9);
      }
    }
  }
}

TEST(Highlight, LargerPowerIsSharper) {
  for (auto lobe : {phong_lobe<double>, blinn_phong_lobe<double>}) {
    EXPECT_GT(lobe(kUp, kUp, leaning(20), 10.0), lobe(kUp, kUp, leaning(20), 20.0));
    EXPECT_GT(lobe(kUp, kUp, leaning(10), 20.0), lobe(kUp, kUp, leaning(20), 20.0));
  }
}

TEST(Highlight, PowerZeroIsFlat) {
  for (double degrees : {0.0, 40.0, 120.0, 170.0}) {
    EXPECT_EQ(phong_lobe(kUp, kUp, leaning(degrees), 0.0), 1);
    EXPECT_EQ(blinn_phong_lobe(kUp, kUp, leaning(degrees), 0.0), 1);
  }
}

TEST(Highlight, OppositeLightAndViewerGiveNothing) {
  EXPECT_EQ(blinn_phong_lobe(kUp, leaning(90), leaning(-90), 5.0), 0);
  EXPECT_EQ(blinn_phong_lobe(kUp, kUp, Vec3<double>{0, -1, 0}, 5.0), 0);
  EXPECT_EQ(phong_lobe(kUp, kUp, Vec3<double>{0, -1, 0}, 5.0), 0);
}

TEST(Highlight, NothingFromBehindTheSurface) {
  EXPECT_EQ(blinn_phong_lobe(Vec3<double>{0, -1, 0}, kUp, leaning(30), 5.0), 0);
}

constexpr double kPi = std::numbers::pi;
constexpr double kWater = 1.333;

/// Integral of fn over the half sphere around up. Steps of the angle from straight up grow, so that
/// a peak there has fine steps.
template <class Fn>
double over_half_sphere(Fn&& fn, int rings = 600, int spokes = 300) {
  double sum = 0;
  for (int i = 0; i < rings; ++i) {
    const double u = (i + 0.5) / rings, angle = kPi / 2 * u * u;
    const double area = kPi * u / rings * std::sin(angle) * 2 * kPi / spokes;
    for (int k = 0; k < spokes; ++k) {
      const double turn = 2 * kPi * (k + 0.5) / spokes;
      sum += area * fn(Vec3<double>{std::sin(angle) * std::cos(turn), std::cos(angle),
                                    std::sin(angle) * std::sin(turn)});
    }
  }
  return sum;
}

/// The share of even light that a surface of perfect mirrors sends to the viewer.
double furnace(Vec3<double> v, double alpha) {
  return over_half_sphere([&](Vec3<double> l) { return ggx_mirror_lobe(kUp, v, l, alpha); });
}

TEST(Ggx, DistributionHandWorkedAndNormalised) {
  EXPECT_NEAR(ggx_distribution(1.0, 0.1), 100 / kPi, 1e-10);  // 1 / (pi alpha^2)
  EXPECT_NEAR(ggx_distribution(0.4, 1.0), 1 / kPi, 1e-15);    // even at alpha 1
  EXPECT_NEAR(ggx_distribution(0.6, 0.5), 0.1493, 5e-5);      // .25 / (pi .73^2)
  EXPECT_EQ(ggx_distribution(0.0, 0.5), 0);
  EXPECT_EQ(ggx_distribution(-0.5, 0.5), 0);
  EXPECT_EQ(ggx_distribution(1.0000001, 0.1), ggx_distribution(1.0, 0.1));
  for (double alpha : {0.01, 0.1, 0.5, 1.0}) {
    const double projected = over_half_sphere(
        [&](Vec3<double> h) { return ggx_distribution(h.y, alpha) * h.y; }, 4000, 1);
    EXPECT_NEAR(projected, 1, 1e-4) << alpha;
  }
}

TEST(Ggx, VisibilityHandWorked) {
  EXPECT_NEAR(ggx_visibility(1.0, 1.0, 0.3), 0.25, 1e-15);  // all facets are seen: 1 / (4 N.L N.V)
  EXPECT_NEAR(ggx_visibility(0.5, 0.25, 1.0), 0.5 / 0.75, 1e-15);
  EXPECT_NEAR(ggx_visibility(0.5, 0.25, 1e-9), 2, 1e-12);
  EXPECT_TRUE(std::isfinite(ggx_visibility(0.0, 0.0, 1e-3)));
  EXPECT_EQ(ggx_visibility(-0.5, 0.3, 0.2), ggx_visibility(0.0, 0.3, 0.2));
}

TEST(Ggx, LobeIsTheProductOfItsParts) {
  const Vec3<double> v = leaning(20), l = leaning(50);
  const double d = ggx_distribution(std::cos(35 * kDegree), 0.2);
  const double g = ggx_visibility(std::cos(20 * kDegree), std::cos(50 * kDegree), 0.2);
  const double mirrors = d * g * std::cos(50 * kDegree);
  EXPECT_NEAR(ggx_mirror_lobe(kUp, v, l, 0.2), mirrors, 1e-12);
  EXPECT_NEAR(ggx_lobe(kUp, v, l, 0.2, kWater),
              mirrors * fresnel_exact(std::cos(15 * kDegree), kWater), 1e-12);
}

TEST(Ggx, MirrorsSendBackAllTheLightButWhatBouncesAgain) {
  for (double alpha : {0.02, 0.1, 0.3, 0.6, 1.0}) {
    for (double degrees : {0.0, 40.0, 70.0}) {
      if (alpha < 0.1 && degrees > 0) continue;  // a peak too fine for the grid
      const double back = furnace(leaning(degrees), alpha);
      EXPECT_LE(back, 1 + 1e-3) << alpha << " " << degrees;
      EXPECT_GE(back, 0.3) << alpha << " " << degrees;
    }
  }
  EXPECT_NEAR(furnace(kUp, 0.02), 1, 2e-3);
  EXPECT_NEAR(furnace(kUp, 0.1), 1, 2e-2);
  // Alpha 1 from straight above: D = 1 / pi, so the integral of x / (1 + x) over x = N.L.
  EXPECT_NEAR(furnace(kUp, 1), 1 - std::log(2.0), 1e-4);
  EXPECT_GT(furnace(kUp, 0.1), furnace(kUp, 0.5));
}

TEST(Ggx, SwapsLightAndViewerButForTheCosine) {
  for (int i = 0; i < 500; ++i) {
    const Vec3<double> v = random_unit(i, 2), l = random_unit(i, 3);
    if (v.y < 1e-3 || l.y < 1e-3) continue;
    for (double alpha : {0.01, 0.2, 1.0}) {
      const double there = ggx_lobe(kUp, v, l, alpha, kWater) / l.y;
      const double back = ggx_lobe(kUp, l, v, alpha, kWater) / v.y;
      EXPECT_NEAR(there, back, 1e-9 * std::max(1.0, there));
    }
  }
}

TEST(Ggx, ReflectsBetweenF0AndAllOfAPerfectMirror) {
  const double f0 = fresnel_exact(1.0, kWater);
  for (int i = 0; i < 500; ++i) {
    const Vec3<double> n = random_unit(i, 1), v = random_unit(i, 2), l = random_unit(i, 3);
    for (double alpha : {1e-3, 0.2, 1.0}) {
      const double mirrors = ggx_mirror_lobe(n, v, l, alpha);
      const double water = ggx_lobe(n, v, l, alpha, kWater);
      EXPECT_LE(water, mirrors);
      EXPECT_GE(water, f0 * mirrors * (1 - 1e-12));
      EXPECT_GE(mirrors, 0);
      if (dot(n, l) <= 0) {
        EXPECT_EQ(water, 0);
      }
    }
  }
}

TEST(Ggx, NothingBreaksAtTheEdges) {
  const Vec3<double> down{0, -1, 0};
  for (double alpha : {0.0, 1e-3, 0.5}) {
    EXPECT_EQ(ggx_lobe(kUp, kUp, down, alpha, kWater), 0);  // sun below
    EXPECT_EQ(ggx_lobe(kUp, leaning(90), leaning(-90), alpha, kWater), 0);
    EXPECT_EQ(ggx_lobe(kUp, leaning(-130), leaning(50), alpha, kWater), 0);  // opposite
    for (double viewer : {89.0, 90.0, 91.0, 120.0}) {
      for (double sun : {-1.0, -60.0, -89.999, -90.0, 30.0}) {
        const double lobe = ggx_lobe(kUp, leaning(viewer), leaning(sun), alpha, kWater);
        EXPECT_TRUE(std::isfinite(lobe) && lobe >= 0) << alpha << " " << viewer << " " << sun;
      }
    }
  }
  EXPECT_EQ(ggx_lobe(kUp, kUp, kUp, 0.0, kWater), ggx_lobe(kUp, kUp, kUp, 1e-3, kWater));
}

TEST(Ggx, RougherIsLowerAndWider) {
  EXPECT_GT(ggx_lobe(kUp, leaning(-40), leaning(40), 0.1, kWater),
            ggx_lobe(kUp, leaning(-40), leaning(40), 0.2, kWater));
  EXPECT_LT(ggx_lobe(kUp, leaning(-20), leaning(60), 0.1, kWater),
            ggx_lobe(kUp, leaning(-20), leaning(60), 0.2, kWater));
}

// Float would lose its digits at the sharp lobe. There the peak for a point sun would be 1 / (4 pi
// alpha^2), 80 thousand at the least roughness.
TEST(SunGlint, IsNoBrighterThanTheDiscItselfAndElseTheLobe) {
  const double disc = 1 / kSunSolidAngle;  // 14719 of its irradiance
  EXPECT_NEAR(kSunSolidAngle, 2 * kPi * (1 - std::cos(0.2665 * kDegree)), 5e-8);
  EXPECT_DOUBLE_EQ(sun_glint_lobe(kUp, kUp, kUp, 1e-3, kWater), disc * fresnel_exact(1.0, kWater));
  const Vec3<double> v = leaning(-50), l = leaning(50);
  EXPECT_DOUBLE_EQ(sun_glint_lobe(kUp, v, l, 1e-3, kWater),
                   disc * fresnel_exact(std::cos(50 * kDegree), kWater));
  for (const double off : {-9.0, 0.0, 4.0, 20.0}) {
    const Vec3<double> beside = leaning(50 + off);
    EXPECT_EQ(sun_glint_lobe(kUp, v, beside, 0.1, kWater), ggx_lobe(kUp, v, beside, 0.1, kWater));
  }
}

TEST(SunDisc, IsItsRadianceMirroredOnTheDiscAndNothingBesideIt) {
  const Vec3<double> v = leaning(-30);
  const double seen = fresnel_exact(std::cos(30 * kDegree), kWater) / kSunSolidAngle;
  for (const double off : {-0.266, -0.1, 0.0, 0.2, 0.266}) {
    EXPECT_DOUBLE_EQ(sun_disc_lobe(kUp, v, leaning(30 + off), kWater), seen) << off;
  }
  for (const double off : {-60.0, -0.267, 0.267, 5.0}) {
    EXPECT_EQ(sun_disc_lobe(kUp, v, leaning(30 + off), kWater), 0) << off;
  }
  // The lobe is round: as wide across the plane of incidence.
  const auto across = [](double degrees) {
    const double c = std::cos(degrees * kDegree);
    const Vec3<double> l = leaning(30);
    return Vec3<double>{c * l.x, c * l.y, std::sin(degrees * kDegree)};
  };
  EXPECT_DOUBLE_EQ(sun_disc_lobe(kUp, v, across(0.266), kWater), seen);
  EXPECT_EQ(sun_disc_lobe(kUp, v, across(0.267), kWater), 0);
  EXPECT_EQ(sun_disc_lobe(Vec3<double>{0, -1, 0}, v, leaning(30), kWater), 0) << "from behind";
}

TEST(Ggx, LanesStayNear) {
  using test::Lane, test::lanes, test::value;
  for (double alpha : {1e-3, 0.05, 0.7}) {
    for (double off : {0.0, 0.02, 0.1, 1.0, 20.0}) {
      const Vec3<double> v = leaning(-40), l = leaning(40 + off);
      const double exact = ggx_lobe(kUp, v, l, alpha, kWater);
      const double lane =
          value(ggx_lobe(lanes(kUp), lanes(v), lanes(l), Lane(alpha), Lane(kWater)));
      EXPECT_NEAR(lane, exact, 2e-3 * exact) << alpha << " " << off;
    }
  }
}

}  // namespace
}  // namespace limpid
