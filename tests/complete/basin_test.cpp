#include "complete/basin.h"

#include <numeric>

#include <gtest/gtest.h>

#include "ops/tray.h"

// The width of the water around a place of its bottom.

namespace limpid {
namespace {

constexpr Size kSize{81, 81};
constexpr double kWater = 10;  ///< below the eye of the tray's camera, one scene unit a pixel

/// Seen from straight above: a bottom that is drop(x, y) below the water, or above it.
template <class Drop>
Basin::Walls walls_of(Drop&& drop, int x = 40, int y = 40) {
  test::Tray tray(kSize);
  tray.buffers.set(PlaneId::kDepth, [&](int column, int row) {
    return static_cast<float>(kWater + drop(column - 40, row - 40));
  });
  const Pass pass(tray.scene, tray.buffers.frame, 1.333, {});
  return Basin(tray.buffers.frame, pass).walls_around(x, y);
}

float all(const Basin::Walls& walls) { return std::accumulate(walls.begin(), walls.end(), 0.0f); }

TEST(Basin, WallsOfAChannelStandWhereEachDirectionMeetsThem) {
  // 4 deep, from -3 to 3: eight directions, 22.5 and 67.5 degrees off the x axis, meet a wall .8
  // and 2 depths away.
  const Basin::Walls walls = walls_of([](int x, int) { return std::abs(x) <= 3 ? 4.0 : -0.5; });
  EXPECT_FLOAT_EQ(all(walls), 1);
  EXPECT_FLOAT_EQ(walls[1], 0.5);             // .5 ... 1
  EXPECT_FLOAT_EQ(walls[3] + walls[4], 0.5);  // 1.5 ... 2.5
}

TEST(Basin, OpenWaterHasNone) {
  EXPECT_EQ(all(walls_of([](int, int) { return 4.0; })), 0);
  EXPECT_EQ(all(walls_of([](int, int) { return 4.0; }, 0, 0)), 0);
}

TEST(Basin, ABeachIsNone) {
  EXPECT_EQ(all(walls_of([](int x, int) { return 4.0 - 0.25 * std::abs(x); })), 0);
}

TEST(Basin, WhatStandsOnTheBottomUnderTheWaterIsNone) {
  EXPECT_EQ(all(walls_of([](int x, int) { return std::abs(x) <= 3 ? 4.0 : 2.0; })), 0);
}

TEST(Basin, WallsRightBesideAPlaceTakeAllThatIsThrownBackWhole) {
  Basin::Walls walls{};
  walls[0] = 1;
  const double whole = 1 - 1 / (1.333 * 1.333);
  EXPECT_NEAR(Basin::share_on(walls, Basin::reflected(0, 1.333)), whole, 1e-9);
  walls[0] = 0.5;
  EXPECT_NEAR(Basin::share_on(walls, Basin::reflected(0, 1.333)), whole / 2, 1e-9);
  // Light to the surface and back at 49 degrees and flatter.
  EXPECT_LT(Basin::share_on(walls, Basin::reflected(1, 1.333)), whole / 2 * std::exp(-2 / 0.661));
}

TEST(Basin, LessOfTheLightReachesWallsThatAreFarther) {
  double before = 1;
  for (std::size_t ring = 0; ring < Basin::kRings; ++ring) {
    Basin::Walls walls{};
    walls[ring] = 1;
    const double thrown = Basin::share_on(walls, Basin::reflected(0.1, 1.333));
    EXPECT_LE(thrown, before) << ring;
    before = thrown;
  }
  EXPECT_LT(before, 0.01);
}

/// Share of the sunlight around the middle of a bottom of 4 below the water, lit where lit(x, y).
template <class Lit>
double sunlit(Lit&& lit, double depth = 0) {
  test::Tray tray(kSize);
  tray.buffers.fill(PlaneId::kDepth, kWater + 4);
  const Pass pass(tray.scene, tray.buffers.frame, 1.333, {});
  const Basin basin(tray.buffers.frame, pass);
  const auto lit_at = [&](int x, int y) -> std::optional<float> {
    return static_cast<float>(lit(x - 40, y - 40));
  };
  return Basin::share_sunlit(basin.floor_around(40, 40, lit_at), Basin::reflected(depth, 1.333));
}

TEST(Basin, ShadeCountsWhereTheSurfaceReflectsItsLightFrom) {
  EXPECT_EQ(sunlit([](int, int) { return 1; }), 1);
  EXPECT_EQ(sunlit([](int, int) { return 0; }), 0);
  EXPECT_NEAR(sunlit([](int x, int) { return x < 0; }), 0.5, 0.05);
  // Light that the surface reflects totally comes down two depths away and farther; in water that
  // absorbs, not much farther.
  EXPECT_EQ(sunlit([](int x, int y) { return std::hypot(x, y) > 6; }), 1);
  const auto near = [](int x, int y) { return std::hypot(x, y) < 14; };
  EXPECT_GT(sunlit(near, 1), sunlit(near) + 0.1);
}

}  // namespace
}  // namespace limpid
