#include "complete/edge_surfaces.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support.h"

// What stands at the edge of the picture above the water.

namespace limpid {
namespace {

using test::kInf;

constexpr Rect kWindow{-4, 3, 36, 23};
constexpr int kWide = 40, kHigh = 20;  // its size: a side has kWide columns

/// A view over water in which texels from 6 to 15 of the upper edge show something at a depth of
/// 10, and the right edge something at .8, and bottom under that.
struct Shown {
  test::Buffers buffers{kWindow};
  Scene scene;
  EdgeSurfacesMaker maker;
  const EdgeSurfaces* made = nullptr;

  explicit Shown(int threads = 1, float light = 5) {
    scene = test::simple_scene(kWindow.size());
    buffers.set(PlaneId::kDepth, [](int x, int y) {
      if (x == kWindow.x1 - 1) return y < 13 ? 0.8f : 30.0f;
      return y == kWindow.y0 && x >= 2 && x < 12 ? 10.0f : kInf;
    });
    for (int c = 0; c < 3; ++c) {
      buffers.set(plane_after(PlaneId::kColorR, c), [=](int x, int) {
        return x == kWindow.x1 - 1 ? 2.0f : x < 12 && x >= 2 ? light * float(c + 1) : 100.0f;
      });
    }
    const Pass pass(scene, buffers.frame, 1.333, {});
    made = maker.make(buffers.frame, pass, *make_executor(threads));
  }
  /// In the first row, or in the last; `column` from the upper left corner to the right.
  float share(int column, int row) const { return made->shape.channels[0].at(column, row); }
  float depth(int column, int row) const { return made->shape.channels[1].at(column, row); }
  float color(int c, int column, int row) const {
    return made->colors.channels[static_cast<std::size_t>(c)].at(column, row);
  }
};

TEST(EdgeSurfaces, TheFirstRowIsTheEdge) {
  const Shown view;
  EXPECT_EQ(view.made->shape.channels[0].window.width(), 4 * kWide);
  EXPECT_EQ(view.made->shape.channels[0].window.height(), EdgeSurfaces::kRows);
  for (int i = 0; i < kWide - 1; ++i) {
    const bool stands = i >= 6 && i < 16;
    EXPECT_EQ(view.share(i, 0), stands ? 1 : 0) << i;
    EXPECT_EQ(view.depth(i, 0), stands ? 10 : 0) << i;
    EXPECT_EQ(view.color(1, i, 0), stands ? 10 : 0) << i;
  }
  // The right side is shorter: two columns a texel. What lies below the water does not count.
  EXPECT_EQ(view.share(kWide, 0), 1);
  EXPECT_FLOAT_EQ(view.depth(kWide + 1, 0), 0.8f);
  EXPECT_EQ(view.color(0, kWide, 0), 2);
  EXPECT_EQ(view.share(2 * kWide - 1, 0), 0);
}

TEST(EdgeSurfaces, ARowIsAMeanToBothSides) {
  const Shown view;
  constexpr int kRow = 6;  // reaches 20 (6 / 15)^2 = 3.2 pixels: three texels
  EXPECT_EQ(view.made->reach, 20);
  EXPECT_NEAR(view.share(6, kRow), 4 / 7.0, 1e-6);
  EXPECT_NEAR(view.share(10, kRow), 1, 1e-6);
  EXPECT_NEAR(view.share(3, kRow), 1 / 7.0, 1e-6);
  EXPECT_NEAR(view.depth(3, kRow), 10 / 7.0, 1e-5);
  EXPECT_NEAR(view.color(2, 3, kRow), 15 / 7.0, 1e-5);
  EXPECT_EQ(view.share(2, kRow), 0);
  // Around the corner, and from the last column on to the first.
  EXPECT_NEAR(view.share(kWide - 2, kRow), 3 / 7.0, 1e-6);
  double sum = 0;
  for (int i = 0; i < 4 * kWide; ++i) sum += view.share(i, kRow) - view.share(i, 0);
  EXPECT_LT(std::abs(sum), 6);  // a side's step is another than the next side's
}

TEST(EdgeSurfaces, AreFiniteForInfiniteLight) {
  const Shown view(1, kInf);
  for (int row = 0; row < EdgeSurfaces::kRows; ++row) {
    for (int i = 0; i < 4 * kWide; ++i) ASSERT_TRUE(std::isfinite(view.color(0, i, row)));
  }
}

TEST(EdgeSurfaces, ThreadsDoNotMatter) {
  const Shown one(1), four(4);
  for (int row = 0; row < EdgeSurfaces::kRows; ++row) {
    for (int i = 0; i < 4 * kWide; ++i) {
      ASSERT_EQ(one.share(i, row), four.share(i, row));
      ASSERT_EQ(one.color(2, i, row), four.color(2, i, row));
    }
  }
}

}  // namespace
}  // namespace limpid
