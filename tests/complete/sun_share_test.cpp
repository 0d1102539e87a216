#include "complete/sun_share.h"

#include <cmath>

#include <gtest/gtest.h>

#include "complete/pool.h"

namespace limpid {
namespace {

using test::Pool;

/// A pool with light of the sun (.6, .4, .2) and of the rest (.2, .2, .2); in the shade at x < 30
/// the rest is brighter.
struct LitPool {
  Pool pool;

  LitPool() {
    pool.draw([](double, double) { return 0.0; });
    const auto lit = [](int x) { return x < 30 ? 0.0f : 1.0f; };
    pool.buffers.set(PlaneId::kShadow, [&](int x, int) { return lit(x); });
    for (int c = 0; c < 3; ++c) {
      const float sun = 0.6f - 0.2f * static_cast<float>(c);
      pool.buffers.set(plane_after(PlaneId::kSunColorR, c),
                       [=](int x, int) { return sun * lit(x); });
      pool.buffers.set(plane_after(PlaneId::kColorR, c),
                       [=](int x, int) { return lit(x) > 0 ? sun + 0.2f : 5.0f; });
    }
  }
  std::array<double, 3> over_rest(int threads = 1) const {
    SunShare share;
    const auto executor = make_executor(threads);
    return share.over_rest(pool.buffers.frame, pool.pass(), {9, 8, 7}, *executor);
  }
};

TEST(SunShare, IsThatOfSunlitBottomsAlone) {
  for (const int threads : {1, 3}) {
    const std::array<double, 3> share = LitPool().over_rest(threads);
    EXPECT_NEAR(share[0], 3, 1e-4);
    EXPECT_NEAR(share[1], 2, 1e-4);
    EXPECT_NEAR(share[2], 1, 1e-4);
  }
}

TEST(SunShare, IsNoneInTheShadeAndWithoutShadow) {
  LitPool shaded;
  shaded.pool.buffers.fill(PlaneId::kShadow, 0);
  EXPECT_EQ(shaded.over_rest()[0], 0);
  LitPool unknown;
  unknown.pool.buffers.frame.planes[index_of(PlaneId::kShadow)] = {};
  EXPECT_EQ(unknown.over_rest()[0], 0);
}

// The albedo differs from place to place, and shadows have edges along rows and columns.
TEST(SunShare, IsThatOfTheEdgesOfShadowsWithoutTheSunsLight) {
  LitPool unknown;
  test::Buffers& buffers = unknown.pool.buffers;
  const auto lit = [](int x, int y) { return x % 16 < 8 && y % 24 < 12 ? 1.0f : 0.0f; };
  buffers.set(PlaneId::kShadow, lit);
  for (int c = 0; c < 3; ++c) {
    buffers.frame.planes[index_of(plane_after(PlaneId::kSunColorR, c))] = {};
    const float sun = 0.6f - 0.2f * static_cast<float>(c);
    buffers.set(plane_after(PlaneId::kColorR, c), [=](int x, int y) {
      const float albedo = 1 + 0.3f * static_cast<float>(std::sin(1.7 * x) * std::cos(2.3 * y));
      return albedo * (sun * lit(x, y) + 0.2f);
    });
  }
  for (const int threads : {1, 3}) {
    const std::array<double, 3> share = unknown.over_rest(threads);
    EXPECT_NEAR(share[0], 3, 0.2);
    EXPECT_NEAR(share[1], 2, 0.15);
    EXPECT_NEAR(share[2], 1, 0.1);
  }
  buffers.fill(PlaneId::kShadow, 1);
  EXPECT_EQ(unknown.over_rest(), (std::array<double, 3>{9, 8, 7}));
}

TEST(SunShare, IsBoundWhereAllLightIsTheSuns) {
  LitPool lit;
  for (int c = 0; c < 3; ++c) lit.pool.buffers.fill(plane_after(PlaneId::kSunColorR, c), 0.7999f);
  EXPECT_EQ(lit.over_rest()[0], 100);
}

}  // namespace
}  // namespace limpid
