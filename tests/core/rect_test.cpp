#include "limpid/core/rect.h"

#include <gtest/gtest.h>

namespace limpid {
namespace {

TEST(Rect, MeasuresAndEmptiness) {
  const Rect r{-2, 3, 5, 7};
  EXPECT_EQ(r.width(), 7);
  EXPECT_EQ(r.height(), 4);
  EXPECT_EQ(r.area(), 28);
  EXPECT_FALSE(r.empty());
  EXPECT_TRUE((Rect{4, 0, 4, 9}).empty());
  EXPECT_TRUE((Rect{5, 0, 4, 9}).empty());
  EXPECT_EQ((Rect{5, 0, 4, 9}).width(), 0);
  EXPECT_EQ((Rect{0, 0, 100000, 100000}).area(), 10000000000);
  EXPECT_EQ(rect_of({3, 2}), (Rect{0, 0, 3, 2}));
  EXPECT_EQ(r.size(), (Size{7, 4}));
}

TEST(Rect, Contains) {
  const Rect r{0, 0, 10, 5};
  EXPECT_TRUE(r.contains(r));
  EXPECT_TRUE(r.contains({2, 1, 3, 2}));
  EXPECT_FALSE(r.contains({-1, 0, 3, 3}));
  EXPECT_FALSE(r.contains({0, 0, 11, 5}));
  EXPECT_TRUE(r.contains({50, 50, 50, 60}));  // an empty rectangle lies in every rectangle
}

TEST(Rect, Intersection) {
  const Rect a{0, 0, 10, 5}, b{-3, 2, 4, 9};
  EXPECT_EQ(intersection(a, b), (Rect{0, 2, 4, 5}));
  EXPECT_EQ(intersection(a, b), intersection(b, a));
  EXPECT_EQ(intersection(a, a), a);
  EXPECT_TRUE(intersection(a, {10, 0, 20, 5}).empty());
  EXPECT_TRUE(intersection(a, {30, 30, 40, 40}).empty());
}

}  // namespace
}  // namespace limpid
