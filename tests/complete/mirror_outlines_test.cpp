#include "complete/mirror_outlines.h"

#include <functional>

#include <gtest/gtest.h>

#include "support.h"

// Depths of a reflection up and down to the outlines that its colors show.

namespace limpid {
namespace {

using test::kInf;

/// An object at a depth of 10 in the rows 120 ... 149 of a reflection, before a bright sky. A
/// column may grow by less than four rows.
struct Reflection {
  static constexpr int kWidth = 70, kHeight = 256, kFirst = 120, kEnd = 150;
  static constexpr float kDark = 0.1f, kSky = 0.8f, kDepth = 10;
  test::Buffers buffers{{0, 0, kWidth, kHeight}};
  Plane depth{Rect{0, 0, kWidth, kHeight}}, valid{Rect{0, 0, kWidth, kHeight}};

  /// `light`: of a texel.
  explicit Reflection(const std::function<float(int x, int y)>& light) {
    for (const PlaneId id : {PlaneId::kReflectionR, PlaneId::kReflectionG, PlaneId::kReflectionB}) {
      buffers.set(id, light);
    }
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        depth.view().at(x, y) = y >= kFirst && y < kEnd ? kDepth : kInf;
        valid.view().at(x, y) = 1;
      }
    }
  }
  void grow(int threads = 1) {
    grow_to_outlines(buffers.frame, valid.view(), depth.view(), *make_executor(threads));
  }
  /// Expects the object in the rows from `first` to before `end` of a column, and nowhere else.
  void expect(int x, int first, int end) const {
    for (int y = 0; y < kHeight; ++y) {
      EXPECT_EQ(depth.view().at(x, y), y >= first && y < end ? kDepth : kInf) << x << ", " << y;
    }
  }
};

/// Of an object that the reflection shows in the rows from `first` to before `end`.
auto dark_rows(int first, int end, float sky = Reflection::kSky) {
  return [=](int, int y) { return y >= first && y < end ? Reflection::kDark : sky; };
}

TEST(MirrorOutlines, GrowToWhereTheColorEnds) {
  for (int threads = 1; threads <= 3; ++threads) {
    Reflection reflection(dark_rows(117, 152));
    reflection.grow(threads);
    for (int x = 0; x < Reflection::kWidth; ++x) reflection.expect(x, 117, 152);
  }
}

TEST(MirrorOutlines, AreNotGuessed) {
  // The color ends nowhere near, differs too little from that beyond, or not at all.
  for (const auto& light : {dark_rows(110, 160), dark_rows(117, 152, 0.25f), dark_rows(130, 140)}) {
    Reflection reflection(light);
    reflection.grow();
    reflection.expect(3, Reflection::kFirst, Reflection::kEnd);
  }
  // Another object is where the sky would be.
  Reflection other(dark_rows(117, 152));
  other.depth.view().at(3, Reflection::kEnd + 3) = 50;
  other.grow();
  EXPECT_EQ(other.depth.view().at(3, Reflection::kEnd), kInf);
  EXPECT_EQ(other.depth.view().at(3, Reflection::kFirst - 1), Reflection::kDepth);
}

TEST(MirrorOutlines, AreNotThoseOfInsidesAndNan) {
  Reflection reflection(
      [](int x, int y) { return x == 5 && y == 118 ? std::nanf("") : dark_rows(117, 152)(x, y); });
  reflection.valid.view().at(4, 118) = reflection.valid.view().at(6, 120) = 0;
  reflection.grow();
  reflection.expect(6, 120, 152);
  reflection.expect(4, 119, 152);
  reflection.expect(5, 119, 152);
}

}  // namespace
}  // namespace limpid
