#include "optics/wind.h"

#include <gtest/gtest.h>

namespace limpid {
namespace {

// Both fits are of the same photographs.
TEST(Wind, SlopesAlongAndAcrossAreTogetherThoseOfAllDirections) {
  for (const double wind : {1.0, 5.0, 10.0, 14.0}) {
    const WindSlopes slopes = wind_slopes(wind);
    const double all = 0.003 + 0.00512 * wind;
    EXPECT_NEAR(slopes.along + slopes.across, all, 0.01 * all) << wind;
  }
  EXPECT_GT(wind_slopes(5).along, wind_slopes(5).across);
  EXPECT_NEAR(wind_slopes(10).along, 0.0316, 1e-12);
  EXPECT_NEAR(wind_slopes(10).across, 0.0222, 1e-12);
}

// A wave of 100 m runs at 12.5 m/s, a wave of a metre at a tenth of that speed.
TEST(Wind, LongWavesRunByGravity) {
  EXPECT_NEAR(phase_speed(100), 12.4952, 1e-3);
  EXPECT_NEAR(phase_speed(1), 1.2497, 1e-3);
  EXPECT_NEAR(phase_speed(4), 2 * phase_speed(1), 1e-3);
}

// No wave on water is slower than 23 cm/s, the speed of a wave of 1.7 cm.
TEST(Wind, RipplesRunBySurfaceTension) {
  double slowest = 1e9, length = 0;
  for (double l = 0.001; l < 1; l *= 1.01) {
    if (phase_speed(l) < slowest) slowest = phase_speed(l), length = l;
  }
  EXPECT_NEAR(slowest, 0.231, 1e-3);
  EXPECT_NEAR(length, 0.0171, 3e-4);
}

TEST(Wind, TheSkinGoesWithAThirtiethOfTheWind) {
  EXPECT_EQ(skin_drift(0), 0);
  EXPECT_NEAR(skin_drift(10), 0.35, 1e-12);
}

}  // namespace
}  // namespace limpid
