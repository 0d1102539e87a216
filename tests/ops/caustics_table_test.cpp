#include "op/caustics_table.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "op/plain_texture.h"
#include "support.h"

namespace limpid {
namespace {

/// Bilinear lookups, as the reference does them.
struct PlainTap {
  double grid(const View<const float>& table, Vec2<double> at) const { return grid_at(table, at); }
};

/// Two levels of 9 x 9 texels, each of one light, both from (10, 20) on; the second level is twice
/// as wide.
struct TwoLevels {
  std::vector<float> fine, coarse;
  CausticsTable table;

  TwoLevels(float first, float second) : fine(81, first), coarse(81, second) {
    table.count = 2;
    table.levels[0] = {{fine.data(), 1, 9, rect_of({9, 9})}, {10, 20}, 1};
    table.levels[1] = {{coarse.data(), 1, 9, rect_of({9, 9})}, {10, 20}, 2};
  }
  double at(double x, double y, double texel) const {
    return caustics_at(table, PlainTap(), Vec2<double>{10 + x, 20 + y}, texel);
  }
};

TEST(CausticsTable, GoesFromLevelToLevelByTheWidthOfThePixel) {
  const TwoLevels two(2, 3);
  EXPECT_DOUBLE_EQ(two.at(4, 4, 0.1), 2);
  EXPECT_DOUBLE_EQ(two.at(4, 4, 1), 2);
  // Half of the light is the first level's, a quarter of the rest the second's, within 2 texels of
  // the edges.
  EXPECT_DOUBLE_EQ(two.at(4, 4, 1.5), 0.5 * 2 + 0.125 * 3 + 0.375);
  EXPECT_DOUBLE_EQ(two.at(8, 8, 2), 3);
  EXPECT_DOUBLE_EQ(two.at(8, 8, 3), 0.5 * 3 + 0.5);
  EXPECT_DOUBLE_EQ(two.at(8, 8, 4), 1) << "calm light where no level is wide enough";
}

TEST(CausticsTable, AScaleIsOfThePixelsWidth) {
  TwoLevels two(2, 3);
  two.table.scale = 2;
  EXPECT_DOUBLE_EQ(two.at(8, 8, 1), 3);
  EXPECT_DOUBLE_EQ(two.at(8, 8, 1.5), 0.5 * 3 + 0.5);
}

TEST(CausticsTable, FadesOverFourTexelsAtEachEdge) {
  const TwoLevels one(2, 1);  // the second level is calm
  for (const double in : {0.0, 1.0, 2.0, 4.0}) {
    const double want = 1 + 0.25 * in;
    EXPECT_DOUBLE_EQ(one.at(in, 4, 1), want) << in;
    EXPECT_DOUBLE_EQ(one.at(8 - in, 4, 1), want) << in;
    EXPECT_DOUBLE_EQ(one.at(4, in, 1), want) << in;
    EXPECT_DOUBLE_EQ(one.at(4, 8 - in, 1), want) << in;
  }
  EXPECT_DOUBLE_EQ(one.at(2, 2, 1), 1.25) << "a corner is at two edges";
  EXPECT_DOUBLE_EQ(one.at(-3, 4, 1), 1);
  EXPECT_DOUBLE_EQ(one.at(4, 30, 1), 1);
}

TEST(CausticsTable, IsNeverBelowZero) {
  const TwoLevels dark(-5, -5);
  EXPECT_EQ(dark.at(4, 4, 1), 0);
  EXPECT_EQ(CausticsTable().count, 0);
  EXPECT_EQ(caustics_at(CausticsTable(), PlainTap(), Vec2<double>{3, 4}, 1.0), 1);
}

TEST(CausticsTable, TexelsAreAsWideAsThePixelIsLongOnTheWater) {
  constexpr Size kSize{64, 48};
  const test::Buffers b = test::noisy_frame(rect_of(kSize));
  for (const bool parallel : {false, true}) {
    Scene scene = test::simple_scene(kSize);
    if (parallel) scene.camera->projection = orthographic(2.4, 1.8, 0.1, 100, ClipSpace::kGl);
    const Pass c(scene, b.frame, 1.333, {});
    const RowRays<double> row(c, 24.5);
    for (const double depth : {0.5, 3.0}) {
      const Vec3<double> step = row.origin_dx + depth * row.ray_dx;
      EXPECT_NEAR(caustics_texel(c, depth, 1.0), length(step), 1e-12) << parallel;
      EXPECT_NEAR(caustics_texel(c, depth, 0.25), 2 * length(step), 1e-12) << parallel;
      EXPECT_NEAR(caustics_texel(c, depth, 0.01), length(step) / std::sqrt(0.05), 1e-12);
    }
  }
}

}  // namespace
}  // namespace limpid
