#include "complete/bottom_plane.h"

#include <algorithm>

#include <gmock/gmock.h>

#include "complete/pool.h"

// The plane of the bottom, and its part beyond the picture.

namespace limpid {
namespace {

using test::Pool;

double grey(double, double) { return 0.5; }

TEST(BottomPlane, IsThatOfTheBottom) {
  for (const double rise : {0.0, 0.05, -0.1}) {
    Pool pool;
    pool.rise = rise;
    pool.draw(grey);
    const auto plane = fit_bottom(pool.buffers.frame, pool.pass());
    ASSERT_TRUE(plane) << rise;
    EXPECT_LT(glm::length(plane->normal - pool.normal()), 1e-4) << rise;
    EXPECT_NEAR(plane->offset, pool.normal().y * (-2 - pool.deep), 1e-3) << rise;
  }
}

TEST(BottomPlane, PostsAndRocksDoNotPullAtIt) {
  Pool pool;
  pool.draw(grey);
  pool.buffers.set(PlaneId::kDepth, [&](int x, int y) {
    const double depth = pool.dry_depth(x, y);
    if (x % 9 == 0) return 2.1f;                                             // before the water
    if (x > 20 && x < 50 && y > 40) return static_cast<float>(0.8 * depth);  // in the water
    return static_cast<float>(depth);
  });
  const auto plane = fit_bottom(pool.buffers.frame, pool.pass());
  ASSERT_TRUE(plane);
  EXPECT_LT(glm::length(plane->normal - pool.normal()), 2e-3);
  EXPECT_NEAR(plane->offset, pool.normal().y * (-2 - pool.deep), 5e-3);
}

TEST(BottomPlane, IsNoneWhereNothingLiesUnderTheWater) {
  Pool pool;
  pool.draw(grey);
  pool.buffers.fill(PlaneId::kDepth, 1);
  EXPECT_FALSE(fit_bottom(pool.buffers.frame, pool.pass()));
  pool.buffers.fill(PlaneId::kDepth, test::kInf);
  EXPECT_FALSE(fit_bottom(pool.buffers.frame, pool.pass()));
}

OffFrameLookups off_frame_lookups_of(const Pool& pool) {
  const auto plane = fit_bottom(pool.buffers.frame, pool.pass());
  return plane ? off_frame_lookups(*plane, pool.buffers.frame, pool.pass()) : OffFrameLookups{};
}

TEST(OffFrameLookups, SaysWhichOverscanWouldShowWhatIsLookedAt) {
  Pool pool;
  pool.draw(grey);
  double below = 0;
  int wet = 0, off = 0;
  for (int y = 0; y < Pool::kSize.height; ++y) {
    for (int x = 0; x < Pool::kSize.width; ++x) {
      if (!(pool.ray(x, y).y < 0)) continue;
      ++wet;
      off += pool.leaves(x, y);
      below = std::max(below, pool.end(x, y).y - (Pool::kSize.height - 1));
    }
  }
  const OffFrameLookups off_frame = off_frame_lookups_of(pool);
  EXPECT_GT(below, 5);
  EXPECT_EQ(off_frame.bottom, static_cast<int>(std::ceil(below)));
  EXPECT_EQ(off_frame.top, 0);
  EXPECT_EQ(off_frame.left, 0) << "calm water bends rays towards the middle of a view from above";
  EXPECT_EQ(off_frame.right, 0);
  EXPECT_NEAR(off_frame.share, double(off) / wet, 0.02);
}

TEST(OffFrameLookups, OverscanThatIsThereCounts) {
  Pool pool;
  pool.draw(grey);
  const int needed = off_frame_lookups_of(pool).bottom;
  pool.window = {-3, -3, Pool::kSize.width + 3, Pool::kSize.height + needed};
  pool.draw(grey);
  EXPECT_FALSE(off_frame_lookups_of(pool).any());
  pool.window.y1 -= 1;
  pool.draw(grey);
  EXPECT_EQ(off_frame_lookups_of(pool).bottom, needed) << "told from the side of the picture";
}

TEST(OffFrameLookups, NormalsOfTheWaterCount) {
  Pool pool;
  pool.draw(grey);
  pool.buffers.normal(normalize_or<double>({-0.6, 1, 0}, {0, 1, 0}));
  const OffFrameLookups off_frame = off_frame_lookups_of(pool);
  EXPECT_GT(off_frame.right, 0);
  EXPECT_EQ(off_frame.left, 0);
}

TEST(OffFrameLookups, SentenceNamesTheSidesThatLackOverscan) {
  EXPECT_EQ(to_text(OffFrameLookups{}), "no refracted ray leaves the picture");
  const auto sentence = [](const char* share, const char* overscan) {
    return std::string("the refracted rays of ") + share +
           " of the wet pixels leave the picture; overscan of color and depth by " + overscan +
           " would show where they end";
  };
  EXPECT_EQ(to_text(OffFrameLookups{0.0583, 4, 0, 2, 24}),
            sentence("5.8 %", "4 pixels on the left, 2 on the right and 24 at the bottom"));
  EXPECT_EQ(to_text(OffFrameLookups{0.2, 0, 1, 0, 0}), sentence("20.0 %", "1 pixel at the top"));
}

}  // namespace
}  // namespace limpid
