#include <gtest/gtest.h>

#include "complete/scattered_light.h"

// The light that the water scatters into views from within it. tests/judge/trace compares it with
// random walks.

namespace limpid {
namespace {

double even_sky_at(const ScatteredLight& light, double z, double sink) {
  const auto shapes = inside_sky_shapes(sink);
  double sum = 0;
  for (std::size_t f = 0; f < ScatteredLight::kFades; ++f) {
    for (std::size_t n = 0; n < ScatteredLight::kInside; ++n) {
      sum += std::exp(-light.fades[f] * z) * light.inside_sky[f][n] * shapes[n];
    }
  }
  return sum;
}

// Where nothing is absorbed, under an even sky, radiance is the same everywhere and in all
// directions: a unit of path adds as much light as it takes.
TEST(InsideLight, AWhiteFurnaceIsEvenAtAnyDepth) {
  for (const bool surface : {false, true}) {
    for (const double anisotropy : {0.0, 0.9}) {
      ScatteringWater water;
      water.absorption = {1e-9, 1e-9, 1e-9};
      water.scattering = {0.5, 2, 8};
      water.anisotropy = anisotropy;
      water.surface = surface;
      water.inside = true;
      ScatteredLightMaker maker;
      const ScatteredLights& lights = maker.make(water);
      for (std::size_t i = 0; i < 3; ++i) {
        const double takes = std::array{0.5, 2.0, 8.0}[i] * (1 - narrow_share(anisotropy));
        for (const double z : {0.01, 0.3, 3.0}) {
          for (const double sink : {-0.95, -0.3, 0.0, 0.3, 0.95}) {
            EXPECT_NEAR(even_sky_at(lights[i], z, sink), takes, 0.03 * takes)
                << surface << " " << anisotropy << " " << z << " " << sink;
          }
        }
      }
    }
  }
}

TEST(InsideLight, IsMadeForViewsThatMayBeginInTheWaterAlone) {
  ScatteringWater water;
  water.absorption = water.scattering = {1, 1, 1};
  ScatteredLightMaker maker;
  EXPECT_EQ(even_sky_at(maker.make(water)[0], 1, 0), 0);
  water.inside = true;
  EXPECT_GT(even_sky_at(maker.make(water)[0], 1, 0), 0);
}

}  // namespace
}  // namespace limpid
