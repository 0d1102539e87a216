#include "complete/part_depths.h"

#include <gtest/gtest.h>

#include "op/pass.h"
#include "support.h"

// The depth of the plate's surface on the rays of parts of its pixels.

namespace limpid {
namespace {

constexpr Size kSize{64, 48};

TEST(PartDepths, IsAsHighThereAsAtTheCentre) {
  const Scene whole = test::simple_scene(kSize);
  test::Buffers b(rect_of(kSize));
  b.fill(PlaneId::kDepth, 100);
  for (const double height : {0.0, 0.3}) {
    Scene raised = whole;
    raised.water->height += height;
    const Pass as_high(raised, b.frame, 1.333, kWholeState);
    const auto depth_at = [&](const Pass& c, int x, int y) {
      return RowRays<double>(c, y + 0.5).calm_depth(x + 0.5);
    };
    b.set(PlaneId::kSurfaceDepth,
          [&](int x, int y) { return static_cast<float>(depth_at(as_high, x, y)); });
    for (const int index : {0, 2}) {
      Scene part = whole, raised_part = raised;
      part.part = raised_part.part = {index, 3};
      const auto executor = make_executor(1);
      PartDepths depths;
      Frame frame = b.frame;
      depths.move(frame, Pass(part, b.frame, 1.333, kWholeState), *executor);
      const Pass expected(raised_part, b.frame, 1.333, kWholeState);
      int seen = 0;
      for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x) {
          const double depth = depth_at(expected, x, y);
          if (std::isinf(depth) || std::isinf(depth_at(as_high, x, y))) continue;
          EXPECT_NEAR(frame.plane(PlaneId::kSurfaceDepth).at(x, y) / depth, 1, 1e-4)
              << x << ", " << y;
          ++seen;
        }
      }
      EXPECT_GT(seen, 1000);
    }
  }
}

TEST(PartDepths, NothingStaysNothing) {
  Scene scene = test::simple_scene(kSize);
  scene.part = {0, 2};
  test::Buffers b(rect_of(kSize));
  b.fill(PlaneId::kDepth, 100).fill(PlaneId::kSurfaceDepth, test::kInf);
  PartDepths depths;
  Frame frame = b.frame;
  depths.move(frame, Pass(scene, b.frame, 1.333, kWholeState), *make_executor(1));
  for (int x = 0; x < kSize.width; ++x) {
    EXPECT_EQ(frame.plane(PlaneId::kSurfaceDepth).at(x, 20), test::kInf);
  }
}

// A bank hardly higher than the water, up to the horizon, and a bottom hardly lower.
TEST(PartDepths, WhatIsWetRemainsSo) {
  const Scene whole = test::simple_scene(kSize);
  test::Buffers b(rect_of(kSize));
  b.fill(PlaneId::kDepth, 100);
  Pass c(whole, b.frame, 1.333, kWholeState);
  for (const double height : {0.02, -0.02}) {
    b.set(PlaneId::kDepth, [&](int x, int y) {
      const double depth = RowRays<double>(c, y + 0.5).calm_depth(x + 0.5);
      return static_cast<float>(depth * (1 - height / c.eye_above));
    });
    for (const int index : {0, 3}) {
      Scene part = whole;
      part.part = {index, 4};
      const Pass moved(part, b.frame, 1.333, kWholeState);
      PartDepths depths;
      Frame frame = b.frame;
      depths.move(frame, moved, *make_executor(1));
      for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x) {
          const double water = RowRays<double>(moved, y + 0.5).calm_depth(x + 0.5);
          if (std::isinf(water)) continue;
          EXPECT_EQ(water < frame.plane(PlaneId::kDepth).at(x, y), height < 0) << x << ", " << y;
        }
      }
    }
  }
}

}  // namespace
}  // namespace limpid
