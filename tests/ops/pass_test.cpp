#include "op/pass.h"

#include <gtest/gtest.h>

#include "support.h"

namespace limpid {
namespace {

// The drawn surface may end before the plate does, at any side of the plate.
TEST(Pass, KnowsWhereTheSurfaceThatIsDrawnEnds) {
  const Size size{8, 6};
  const Rect whole = rect_of(size);
  const Scene scene = test::simple_scene(size);
  const auto ends = [&](const Rect& surface, bool below) {
    test::Buffers b(whole);
    for (int i : {0, 1, 2}) b.fill(plane_after(PlaneId::kColorR, i), 1);
    b.fill(PlaneId::kDepth, 1);
    const auto ten = [](int, int) { return 10.0f; };
    if (below) {  // wider by two columns
      const Rect wide{-2, 0, 8, 6};
      for (int i : {0, 1, 2}) b.set(plane_after(PlaneId::kBelowR, i), ten, wide);
      b.set(PlaneId::kBelowDepth, ten, wide);
    }
    b.set(PlaneId::kSurfaceDepth, ten, surface);
    return Pass(scene, b.frame, 1.333, {}).surface_ends;
  };
  EXPECT_FALSE(ends(whole, false));
  EXPECT_FALSE(ends({-1, -1, 9, 7}, false));
  EXPECT_TRUE(ends({1, 0, 8, 6}, false));
  EXPECT_TRUE(ends({0, 1, 8, 6}, false));
  EXPECT_TRUE(ends({0, 0, 7, 6}, false));
  EXPECT_TRUE(ends({0, 0, 8, 5}, false));
  EXPECT_TRUE(ends(whole, true)) << "the layer below goes on";
  EXPECT_FALSE(ends({-2, 0, 8, 6}, true));
}

}  // namespace
}  // namespace limpid
