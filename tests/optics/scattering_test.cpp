#include "optics/scattering.h"

#include <cmath>

#include <gtest/gtest.h>

#include "optics/lane_value.h"

namespace limpid {
namespace {

using test::Lane;
using test::value;

WaterPath<double> path(double length, double sink, double begin) {
  return {length, sink, begin, std::fmax(begin + sink * length, 0)};
}

struct Summed {
  double light = 0, far_share = 0;
};

/// The integral by its definition, by midpoints.
Summed summed(const WaterPath<double>& w, double rate, double down) {
  const int steps = 20000;
  Summed sum;
  for (int i = 0; i < steps; ++i) {
    const double share = (i + 0.5) / steps, s = share * w.length;
    const double light = std::exp(-down * (w.begin + w.sink * s) - rate * s) * w.length / steps;
    sum.light += light;
    sum.far_share += light * share;
  }
  sum.far_share /= sum.light;
  return sum;
}

TEST(SunColumn, IsTheIntegralDownAcrossAndUp) {
  for (double rate : {0.0, 0.1, 1.5}) {
    for (double down : {0.0, 0.2, 2.5}) {
      for (const WaterPath<double>& w : {path(3, 0.8, 0), path(3, 1, 4), path(3, 0, 4),
                                         path(3, -0.4, 4), path(4, -1, 4), path(0.01, -1, 1)}) {
        const SunColumn<double> got = sun_column(w, rate, down);
        const Summed expected = summed(w, rate, down);
        EXPECT_NEAR(got.light / expected.light, 1, 1e-6) << rate << " " << down << " " << w.sink;
        // The mean place of scattering on a brightening path lies beyond the path's middle.
        EXPECT_NEAR(got.far_share, expected.far_share, 1e-6);
        EXPECT_EQ(got.far_share > 0.5 + 1e-12, rate + down * w.sink < 0);
      }
    }
  }
}

TEST(SunColumn, HandWorked) {
  EXPECT_NEAR(sun_column(path(2, 1, 0), 0.5, 0.5).light, 1 - std::exp(-2.0), 1e-12);
  EXPECT_NEAR(sun_column(path(2, 0, 3), 0.0, 0.5).light, 2 * std::exp(-1.5), 1e-12);
  // A path straight up to the surface from 3: exp(-1.5) (exp(1.5) - 1) / .5.
  EXPECT_NEAR(sun_column(path(3, -1, 3), 0.0, 0.5).light, (1 - std::exp(-1.5)) / 0.5, 1e-12);
}

/// The integral from the values that depth_fog has.
TEST(SunColumn, LeftIsWhatTheEndLosesOfWaysThatBeginAtTheSurface) {
  for (double rate : {0.0, 0.1, 1.5}) {
    for (double down : {0.0, 0.2, 2.5}) {
      for (double sink : {0.0, 0.6, 1.0}) {
        const WaterPath<double> w = path(3, sink, 0);
        EXPECT_NEAR(sun_left(w, rate, down), std::exp(-rate * w.length) * std::exp(-down * w.end),
                    1e-15);
      }
    }
  }
  // On a brightening path the relation is reversed.
  EXPECT_NEAR(sun_left(path(3, -1, 3), 0.0, 0.5), std::exp(-1.5), 1e-15);
}

// +inf counts as 3e38.
TEST(SunColumn, FiniteForAnyWay) {
  for (double rate : {0.0, 1e-30, 0.3, 2e6}) {
    for (double down : {0.0, 0.4, 1e12}) {
      for (double sink : {-1.0, -1e-8, 0.0, 0.5, 1.0}) {
        for (double begin : {0.0, 5.0}) {
          for (double length : {0.0, 1e-3, 3e38}) {
            const WaterPath<double> w = path(length, sink, begin);
            const WaterPath<Lane> lanes{Lane(w.length), Lane(w.sink), Lane(w.begin), Lane(w.end)};
            const SunColumn<double> got = sun_column(w, rate, down);
            const SunColumn<Lane> lane = sun_column(lanes, Lane(rate), Lane(down));
            for (double light : {got.light, value(lane.light)}) {
              EXPECT_TRUE(light >= 0 && light <= 3.001e38) << rate << " " << down << " " << sink;
            }
            for (double share : {got.far_share, value(lane.far_share)}) {
              EXPECT_TRUE(share >= 0 && share <= 1) << rate << " " << down << " " << sink;
            }
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace limpid
