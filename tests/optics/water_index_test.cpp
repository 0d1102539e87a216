#include "optics/water_index.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "optics/fresnel.h"
#include "optics/refract.h"

namespace limpid {
namespace {

TEST(WaterIndex, HitsTheTablesToTheirLastDigit) {
  const Rgb<double> n = water_index_rgb();
  EXPECT_NEAR(n.r, 1.33167, 5e-6);
  EXPECT_NEAR(n.g, 1.33468, 5e-6);
  EXPECT_NEAR(n.b, 1.33961, 5e-6);
  EXPECT_NEAR(water_index(0.4861), 1.33749, 5e-6);
  EXPECT_NEAR(water_index(0.5893), 1.33335, 5e-6);
  EXPECT_NEAR(water_index(0.6563), 1.33151, 5e-6);
}

TEST(WaterIndex, ReflectanceAtNormalIncidence) {
  const Rgb<double> n = water_index_rgb();
  EXPECT_NEAR(fresnel_exact(1.0, n.r), .02023, 5e-6);
  EXPECT_NEAR(fresnel_exact(1.0, n.g), .02055, 5e-6);
  EXPECT_NEAR(fresnel_exact(1.0, n.b), .02107, 5e-6);
}

TEST(WaterIndex, FallsWithTheWavelengthAsGlassDoes) {
  for (double um = 0.3; um < 0.9; um += 0.01) {
    EXPECT_GT(water_index(um), water_index(um + 0.01)) << um;
  }
}

// The distance between red's and blue's landings per metre of depth, in mm.
TEST(WaterIndex, DispersionHitsTheTable) {
  struct Row {
    double degrees, millimetres;
  };
  const Rgb<double> n = water_index_rgb();
  for (const Row& row : {Row{30, 2.8}, Row{45, 5.2}, Row{60, 8.7}, Row{75, 13.1}}) {
    const double angle = row.degrees * std::numbers::pi / 180;
    const auto reach = [&](double ior) {
      return std::sin(angle) / ior / refracted_cosine(std::cos(angle), 1 / ior);
    };
    EXPECT_NEAR(1000 * (reach(n.r) - reach(n.b)), row.millimetres, 0.05) << row.degrees;
    EXPECT_GT(reach(n.g), reach(n.b));
    EXPECT_LT(reach(n.g), reach(n.r));
  }
}

}  // namespace
}  // namespace limpid
