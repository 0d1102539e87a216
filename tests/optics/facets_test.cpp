#include "optics/facets.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace limpid {
namespace {

/// A mean of fn(lean) over many facets, each weighed by `seen`.
template <class Fn, class Seen>
double counted(Fn&& fn, Seen&& seen) {
  double sum = 0, weights = 0;
  for (double lean = -8; lean < 8; lean += 1e-3) {
    const double weight = seen(lean) * std::exp(-0.5 * lean * lean);
    sum += weight * fn(lean), weights += weight;
  }
  return sum / weights;
}
template <class Fn>
double mean_of(const ThreeFacets<double>& facets, Fn&& fn) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) sum += facets.share[i] * fn(facets.lean[i]);
  return sum;
}

// Facets that would lean lower than the level facet count as level, and polynomials average as over
// many facets.
TEST(Facets, OfAPlaneAverageSlopesThatEndAtALevel) {
  for (const double level : {-1.4, -0.5, 0.0, 0.7, 2.2}) {
    for (int degree = 0; degree <= 4; ++degree) {
      const auto fn = [&](double lean) { return std::pow(std::max(lean + level, 0.0), degree); };
      const double right = counted(fn, [](double) { return 1.0; });
      EXPECT_NEAR(mean_of(plane_facets(level), fn), right, 5e-3 * right) << level << " " << degree;
    }
  }
}

TEST(Facets, OfAPlaneAreGaussAndHermitesWhereNoneEnds) {
  for (const double level : {2.4, 1e3}) {
    const ThreeFacets<double> facets = plane_facets(level);
    EXPECT_EQ(facets.lean[0], 0);
    EXPECT_NEAR(facets.lean[1], std::sqrt(3.0), 1e-12);
    EXPECT_NEAR(facets.lean[2], -std::sqrt(3.0), 1e-12);
    EXPECT_NEAR(facets.share[0], 2.0 / 3, 1e-12);
  }
  // Facets end without a step: a lookup of a sky that falls off above the horizon.
  const auto sky = [](double lean) { return std::exp(-std::max(lean + 2.3, 0.0)); };
  EXPECT_NEAR(mean_of(plane_facets(2.3001), sky), mean_of(plane_facets(2.2999), sky), 0.003);
}

TEST(Facets, ThatAreSeenHaveMeanAndDeviationOfMany) {
  for (const double facing : {0.0, 0.1, 0.5, 1.0, 2.0, 4.0, 7.9}) {
    const auto seen = [&](double lean) { return std::max(lean + facing, 0.0); };
    const auto once = [](double lean) { return lean; };
    const auto twice = [](double lean) { return lean * lean; };
    const ThreeFacets<double> facets = seen_facets(facing);
    EXPECT_NEAR(mean_of(facets, once), counted(once, seen), 3e-4) << facing;
    EXPECT_NEAR(mean_of(facets, twice), counted(twice, seen), 1e-3) << facing;
  }
}

TEST(Facets, AreSharedOutByALean) {
  for (const double lean : {-9.0, -2.0, -0.3, 0.0, 0.8, 2.5, 9.0}) {
    const auto under = [&](double l) { return l < lean ? 1.0 : 0.0; };
    EXPECT_NEAR(plane_share_under(lean), counted(under, [](double) { return 1.0; }), 4e-4) << lean;
    for (const double facing : {0.0, 0.1, 1.0, 3.0, 7.0}) {
      const auto seen = [&](double l) { return std::max(l + facing, 0.0); };
      EXPECT_NEAR(seen_share_under(facing, lean), counted(under, seen), 2e-3)
          << facing << " " << lean;
    }
  }
  EXPECT_EQ(seen_share_under(1.0, -1e30), 0);
  EXPECT_NEAR(seen_share_under(1e30, 1e30), 1, 1e-12);
  // A mean facet that is turned away counts as a facet that the view grazes.
  EXPECT_NEAR(seen_share_under(-2.0, 3.0), seen_share_under(0.0, 1.0), 1e-12);
}

TEST(Facets, ThatLieUnderALimitAreFilledUpFromTheLowest) {
  for (const ThreeFacets<double>& facets :
       {plane_facets(0.4), plane_facets(5.0), seen_facets(0.5)}) {
    double before[3] = {0, 0, 0};
    for (double under = 0; under <= 1; under += 0.01) {
      const Vec3<double> parts = parts_under(facets, under);
      const double part[3] = {parts.x, parts.y, parts.z};
      double sum = 0;
      for (int i = 0; i < 3; ++i) {
        sum += facets.share[i] * part[i];
        EXPECT_GE(part[i], before[i]);
        before[i] = part[i];
        for (int k = 0; k < 3; ++k) {
          EXPECT_TRUE(part[i] == 0 || part[k] > 1 - 1e-9 || facets.lean[k] >= facets.lean[i]);
        }
      }
      EXPECT_NEAR(sum, under, 1e-9);
    }
  }
}

// Along the surface the visibility of facets depends on their lean towards the view alone:
// Rayleigh's law.
TEST(Facets, AlongTheSurfaceLeanTowardsTheView) {
  const double right = std::sqrt(std::acos(-1) / 2);
  EXPECT_NEAR(seen_facets(0.0).lean[0], right, 1e-4);
  EXPECT_NEAR(seen_facets(-3.0).lean[0], right + 3, 1e-4);
  EXPECT_GT(seen_facets(0.0).lean[2], 0);
  EXPECT_NEAR(seen_facets(1e6).lean[0], 1e-6, 1e-8);
  EXPECT_NEAR(seen_facets(1e6).lean[1], std::sqrt(3.0), 1e-5);
}

/// Smith's function: the shadowed area over the visible one, by the slopes above the ray.
double shadowed(double rise) {
  double sum = 0;
  for (double slope = rise; slope < rise + 12; slope += 1e-4) {
    sum += 1e-4 * (slope - rise) * std::exp(-0.5 * slope * slope);
  }
  return sum / (std::sqrt(2 * M_PI) * rise);
}

TEST(NextMeeting, OfRaysIsThatOfMaskingAndShadowing) {
  constexpr double kDeviation = 0.07;
  for (const double a : {0.05, 0.3, 1.0, 2.0}) {
    for (const double v : {0.05, 0.5, 2.5}) {
      const double right = shadowed(a) / (1 + shadowed(v) + shadowed(a));
      EXPECT_NEAR(next_meeting(a * kDeviation, v * kDeviation, kDeviation).share, right,
                  1e-3 * right + 2e-5)
          << a << " " << v;
    }
  }
  for (const double below : {0.0, -1e-9, -0.02, -1.0}) {
    EXPECT_EQ(next_meeting(below, 0.1, kDeviation).share, 1);
  }
  EXPECT_EQ(next_meeting(0.3, 0.1, kDeviation).share, 0);
  EXPECT_NEAR(next_meeting(1e-7, 1e6, kDeviation).share, 1, 1e-5);
}

TEST(NextMeeting, MirrorsRaysUpByTheFacetsThatTheyMeet) {
  constexpr double kDeviation = 0.07;
  for (const double a : {-4.0, -1.0, 0.0, 0.5, 2.0}) {
    const auto met = [&](double slope) { return std::max(slope - a, 0.0); };
    const double right = counted([&](double slope) { return slope - a; }, met);
    const NextMeeting<double> next = next_meeting(a * kDeviation, 0.1, kDeviation);
    EXPECT_NEAR(next.sine, kDeviation * right, 0.015 * kDeviation * right) << a;
    EXPECT_NEAR(next.rise, kDeviation * (a + 2 * right), 0.03 * kDeviation * right) << a;
    EXPECT_GT(next.rise, 0);
  }
  // Of calm water, and at its limits.
  for (const double rise : {-1e6, -1.0, 0.0, 1.0, 1e6}) {
    for (const double deviation : {1e-3, 1.0, 1e3}) {
      const NextMeeting<double> next = next_meeting(rise, 0.0, deviation);
      EXPECT_TRUE(next.share >= 0 && next.share <= 1) << rise << " " << deviation;
      EXPECT_TRUE(next.rise >= 0 && std::isfinite(next.rise)) << rise << " " << deviation;
      EXPECT_TRUE(next.sine >= 0 && next.sine <= 1) << rise << " " << deviation;
    }
  }
}

}  // namespace
}  // namespace limpid
