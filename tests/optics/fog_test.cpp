#include "optics/fog.h"

#include <limits>

#include <gtest/gtest.h>

namespace limpid {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(LinearFog, HandWorked) {
  EXPECT_DOUBLE_EQ(linear_fog(2.0, 0.15, 0.0), 0.7);     // 1 - .3
  EXPECT_DOUBLE_EQ(linear_fog(4.0, 0.25, 0.5), 0.5);     // 1 - (1 - .5)
  EXPECT_DOUBLE_EQ(linear_fog(0.0, 0.25, -0.25), 0.75);  // fog before any water
}

TEST(LinearFog, ClearAtTheSurfaceOpaqueFarDown) {
  EXPECT_EQ(linear_fog(0.0, 0.15, 0.0), 1);
  EXPECT_EQ(linear_fog(100.0, 0.15, 0.0), 0);
  EXPECT_EQ(linear_fog(kInfinity, 0.15, 0.0), 0);
  EXPECT_EQ(linear_fog(kInfinity, 1e6, 1e6), 0);
}

TEST(LinearFog, OffsetKeepsTheFirstMetresClear) {
  EXPECT_EQ(linear_fog(1.99, 0.5, 1.0), 1);
  EXPECT_LT(linear_fog(2.01, 0.5, 1.0), 1);
}

TEST(LinearFog, NoDensityStaysClearEvenAtTheSky) { EXPECT_EQ(linear_fog(kInfinity, 0.0, 0.0), 1); }

TEST(LinearFog, NeverRisesWithDistance) {
  double before = 1;
  for (double d = 0; d < 12; d += 0.05) {
    const double f = linear_fog(d, 0.15, 0.2);
    EXPECT_LE(f, before);
    EXPECT_GE(f, 0);
    before = f;
  }
  EXPECT_EQ(before, 0);
}

}  // namespace
}  // namespace limpid
