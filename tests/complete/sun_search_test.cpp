#include "op/sun_search.h"

#include <gtest/gtest.h>

#include "complete/shore.h"

// Shade on murky water by what the picture shows, of a plate without shadows.

namespace limpid {
namespace {

using test::Shore;

/// Water before a wall, with the sun behind the wall.
struct Shaded : Shore {
  Look look = test::still_look();

  Shaded(double high, double degrees) {
    top = high;
    buffers.set(PlaneId::kDepth, [&](int x, int y) { return dry_depth(x, y); });
    const double angle = glm::radians(degrees);
    scene.sun = Sun{.direction = {0, std::sin(angle), -std::cos(angle)}};
    DepthFog::Params& fog = look.of<DepthFog>();
    fog = {.model = DepthFog::Model::kBeerLambert,
           .absorption = {0.2, 0.2, 0.2},
           .scattering = {0.5, 0.5, 0.5},
           .water_type = WaterType::kCustom};
    fog.sunlight = DepthFog::Sunlight::kStraight, fog.ambient = {0, 0, 0};
    look.of<WaterShadow>() = {};
    look.of<SunHighlight>().strength = 0;
  }
  /// The share of the sunlight in the water that shade takes, by row, from the middle columns.
  double shade(double from_wall) {
    const test::Picture exact = test::reference(look, buffers.frame, scene);
    const test::Picture fast = test::fused(look, buffers.frame, scene);
    Look without = look;
    without.of<WaterShadow>().strength = 0;
    const test::Picture lit = test::reference(without, buffers.frame, scene);
    const int x = kSize.width / 2;
    int row = kSize.height / 2;
    while (row + 1 < kSize.height && -2 / ray(x, row).y > far - from_wall) ++row;
    for (int y = kSize.height / 2 + 4; y < kSize.height; ++y) {
      EXPECT_NEAR(exact.aov(Aov::kInScatter, x, y), fast.aov(Aov::kInScatter, x, y), 1e-5) << y;
    }
    EXPECT_GT(lit.aov(Aov::kInScatter, x, row), 1e-4);
    return 1 - exact.aov(Aov::kInScatter, x, row) / lit.aov(Aov::kInScatter, x, row);
  }
};

TEST(SunSearch, AWallShadesTheWaterBeforeIt) {
  Shaded low(6, 10);
  for (const double away : {3.0, 8.0, 15.0}) EXPECT_NEAR(low.shade(away), 1, 1e-6) << away;
  Shaded steep(6, 45);
  EXPECT_NEAR(steep.shade(3), 1, 1e-6);
  for (const double away : {9.0, 15.0}) EXPECT_NEAR(steep.shade(away), 0, 1e-6) << away;
}

TEST(SunSearch, ThePlatesShadowsCountMore) {
  Shaded wall(6, 10);
  wall.buffers.fill(PlaneId::kSurfaceShadow, 1);
  EXPECT_NEAR(wall.shade(8), 0, 1e-6);
}

/// The sun is in the picture, and a post between it and the viewer shades only the water before it.
TEST(SunSearch, APostBeforeTheVisibleSunShadesNoOtherWater) {
  Shaded sea(0, 8);
  const auto before_post = [](int x) { return std::abs(x - Shore::kSize.width / 2) <= 1; };
  sea.buffers.set(PlaneId::kDepth, [&](int x, int y) {
    return before_post(x) && y < Shore::kSize.height / 2 + 2 ? 15.0f : sea.dry_depth(x, y);
  });
  Look without = sea.look;
  without.of<WaterShadow>().strength = 0;
  const test::Picture got = test::reference(sea.look, sea.buffers.frame, sea.scene);
  const test::Picture lit = test::reference(without, sea.buffers.frame, sea.scene);
  for (int y = Shore::kSize.height / 2 + 6; y < Shore::kSize.height; y += 4) {
    for (const int x : {4, 20, 44, 60}) {
      EXPECT_EQ(got.aov(Aov::kInScatter, x, y), lit.aov(Aov::kInScatter, x, y)) << x << ", " << y;
    }
  }
}

// The picture shows 13 m of the wall.
TEST(SunSearch, AWallThatThePictureCutsMayBeThreeTimesAsHigh) {
  EXPECT_NEAR(Shaded(1e3, 70).shade(3), 1, 1e-6);  // hidden up to 8 m
  const double some = Shaded(1e3, 60).shade(13);   // 23 m
  EXPECT_GT(some, 0.4);
  EXPECT_LT(some, 0.8);
  EXPECT_NEAR(Shaded(1e3, 75).shade(13), 0, 1e-6);  // 49 m
}

}  // namespace
}  // namespace limpid
