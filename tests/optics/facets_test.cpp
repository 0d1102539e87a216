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

// Those that would lean below the level one are there, and polynomials are averaged as by many.
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
  // Where they begin to end there is no step: a lookup of a sky that falls off above the horizon.
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

// Along the surface facets are seen by how they lean towards the view alone: Rayleigh's law.
TEST(Facets, AlongTheSurfaceLeanTowardsTheView) {
  const double right = std::sqrt(std::acos(-1) / 2);
  EXPECT_NEAR(seen_facets(0.0).lean[0], right, 1e-4);
  EXPECT_NEAR(seen_facets(-3.0).lean[0], right + 3, 1e-4);
  EXPECT_GT(seen_facets(0.0).lean[2], 0);
  EXPECT_NEAR(seen_facets(1e6).lean[0], 1e-6, 1e-8);
  EXPECT_NEAR(seen_facets(1e6).lean[1], std::sqrt(3.0), 1e-5);
}

}  // namespace
}  // namespace limpid
