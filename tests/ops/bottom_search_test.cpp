#include "op/bottom_search.h"

#include <gtest/gtest.h>

#include "op/pixel_start.h"
#include "support.h"

namespace limpid {
namespace {

/// A flat bottom, as it is seen around one pixel, and how often somebody looks.
struct FlatBottom {
  const Pass& pass;
  const Pixel<double>& pixel;
  double drop;  ///< below calm water
  int& looks;

  double nearest(PlaneId, Vec2<double> shift) const {
    ++looks;
    const RowRays<double> rays(pass, (pixel.uv.y + shift.y) * pass.size.y);
    const double x = (pixel.uv.x + shift.x) * pass.size.x;
    return rays.calm_depth(x) * (1 + drop / pass.eye_above);
  }
  struct Quad {
    Vec2<double> shift;
    double weight(int) const { return 0.25; }
  };
  Quad quad(Vec2<double> shift) const { return {shift}; }
  Four<double> read(PlaneId plane, const Quad& q) const {
    const double depth = nearest(plane, q.shift);
    return {depth, depth, depth, depth};
  }
  Vec2<double> place(PlaneId, const Quad& q, int) const { return q.shift; }
  SeenHeights heights(PlaneId, bool, Vec2<double>, Vec2<double>) const {
    return {.highest = static_cast<float>(-drop)};
  }
  static bool wet() { return true; }
  Rgb<double> lat_long_rgb(const Texture&, Vec2<double>) const { return {drop, drop, 0}; }
};

struct Met {
  double way;
  int looks;
};

Met march(double drop, bool heights) {
  const Size size{640, 360};
  const Scene scene = test::simple_scene(size);
  test::Buffers b(rect_of(size));
  b.fill(PlaneId::kDepth, 1);
  Pass pass(scene, b.frame, 1.333, {});
  pass.heights.known = heights;
  const RowRays<double> rays(pass, 120.5);
  const double calm = rays.calm_depth(320.5);
  Pixel<double> p{};
  begin_pixel(pass, rays, 320.5, 1.0, calm, calm * (1 + drop / pass.eye_above), p);
  int looks = 0;
  const FlatBottom tap{pass, p, drop, looks};
  // Not so steep as a refracted ray: there is a way to go on screen.
  const Vec3<double> down{0, -0.5, 0.866};
  const ScreenRay<double> ray(pass, p, down);
  const SeenPlanes planes{PlaneId::kColorR, PlaneId::kDepth, pass.dry, false};
  int expected = 0;
  const BottomSearch<double, FlatBottom> search{pass, planes, p, tap, ray, 0.5, 0, expected};
  const auto found = search.march();
  EXPECT_EQ(found.sure, 1);
  return {found.way, looks};
}

TEST(BottomSearch, KnownHeightsSaveLooksAndChangeNothing) {
  const Met each = march(1, false), known = march(1, true);
  EXPECT_NEAR(each.way, 2, 1e-6);
  EXPECT_EQ(known.way, each.way);
  EXPECT_GT(each.looks, 20);
  EXPECT_LT(known.looks, each.looks / 2);
}

}  // namespace
}  // namespace limpid
