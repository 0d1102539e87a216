#include "limpid/core/plane.h"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "limpid/core/error.h"

namespace limpid {
namespace {

TEST(Plane, StartsZeroAlignedAndPaddedToCacheLines) {
  for (int width : {1, 15, 16, 17, 100}) {
    Plane plane(Rect{0, 0, width, 3});
    EXPECT_EQ(plane.view().y_stride % 16, 0);
    EXPECT_GE(plane.view().y_stride, width);
    for (int y = 0; y < 3; ++y) {
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(plane.view().row(y)) % 64, 0u);
      for (int x = 0; x < plane.view().y_stride; ++x) EXPECT_EQ(plane.view().row(y)[x], 0);
    }
  }
}

TEST(Plane, CountsFromItsWindow) {
  Plane plane(Rect{-3, 10, 2, 12});
  plane.view().at(-3, 10) = 1;
  plane.view().at(1, 11) = 2;
  EXPECT_EQ(plane.view().data[0], 1);
  EXPECT_EQ(plane.view().data[plane.view().y_stride + 4], 2);
  const Plane moved = std::move(plane);
  EXPECT_EQ(moved.view().at(1, 11), 2);
}

TEST(Plane, RefusesNothing) {
  EXPECT_THROW(Plane(Rect{0, 0, 0, 5}), Error);
  EXPECT_THROW(Plane(Rect{3, 0, 2, 5}), Error);
  EXPECT_FALSE(Plane());
}

TEST(View, FollowsAnyStrides) {
  // Two interleaved channels, rows from the bottom up.
  std::vector<float> data = {1, -1, 2, -2, 3, -3, 4, -4};
  const View<float> view{data.data() + 4, 2, -4, Rect{0, 0, 2, 2}};
  EXPECT_EQ(view.at(0, 0), 3);
  EXPECT_EQ(view.at(1, 0), 4);
  EXPECT_EQ(view.at(0, 1), 1);
  EXPECT_EQ(view.at(1, 1), 2);
  const View<const float> read_only = view;
  EXPECT_EQ(read_only.at(1, 1), 2);
  EXPECT_FALSE(View<float>());
}

}  // namespace
}  // namespace limpid
