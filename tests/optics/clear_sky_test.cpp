#include "optics/clear_sky.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace limpid {
namespace {

TEST(ClearSky, IsTheStandardClearSky) {
  EXPECT_EQ(clear_sky_by_elevation(0.0), 0);
  for (double sine = 0.02; sine <= 1; sine += 0.02) {
    EXPECT_NEAR(clear_sky_by_elevation(sine), std::log(1 - std::exp(-0.32 / sine)), 0.033) << sine;
  }
  const double level = std::exp(-1.5 * std::numbers::pi);
  for (double x = 0; x <= std::numbers::pi / 2; x += 0.02) {
    const double cosine = std::cos(x);
    const double exact = std::log(1 + 10 * (std::exp(-3 * x) - level) + 0.45 * cosine * cosine);
    EXPECT_NEAR(clear_sky_by_sun(cosine), exact, 0.01) << x;
  }
  EXPECT_EQ(clear_sky_by_sun(-1.0), 0);
  EXPECT_EQ(clear_sky_by_sun(1 + 1e-9), clear_sky_by_sun(1.0));  // rounding
}

}  // namespace
}  // namespace limpid
