#include "op/bottom_search.h"

#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "op/pixel_start.h"
#include "support.h"

namespace limpid {
namespace {

/// A flat bottom around one pixel, which counts its lookups. To the right of `shelf_from` the
/// bottom is a shelf, and rises to the shelf over `rise`.
struct FlatBottom {
  const Pass& pass;
  const Pixel<double>& pixel;
  double drop;  ///< below calm water
  int& looks;
  double mixed = drop;  ///< the drop that a mix of four texels tells instead
  double shelf = drop, shelf_from = HUGE_VAL, rise = 1e-9;
  double ended = 0;     ///< 1: the bottom layer says that the bottom has ended
  double below = drop;  ///< the drop of the bottom layer
  double mixed_shelf = 0, mixed_shelf_from = HUGE_VAL;  ///< `mixed` to the right of that shift

  double nearest(PlaneId, Vec2<double> shift) const {
    ++looks;
    const double risen = saturate((shift.x - shelf_from) / rise + 1);
    return depth_at(drop + risen * (shelf - drop), shift);
  }
  double depth_at(double deep, Vec2<double> shift) const {
    const RowRays<double> rays(pass, (pixel.uv.y + shift.y) * pass.size.y);
    const double x = (pixel.uv.x + shift.x) * pass.size.x;
    return rays.calm_depth(x) * (1 + deep / pass.eye_above);
  }
  struct Quad {
    Vec2<double> shift;
    double weight(int) const { return 0.25; }
  };
  Quad quad(Vec2<double> shift) const { return {shift}; }
  Four<double> read(PlaneId, const Quad& q) const {
    ++looks;
    const double depth = depth_at(q.shift.x > mixed_shelf_from ? mixed_shelf : mixed, q.shift);
    return {depth, depth, depth, depth};
  }
  Vec2<double> place(PlaneId, const Quad& q, int) const { return q.shift; }
  SeenHeights heights(PlaneId, bool, Vec2<double>, Vec2<double>) const {
    return {.highest = static_cast<float>(-drop)};
  }
  static bool wet() { return true; }
  Rgb<double> lat_long_rgb(const Texture&, Vec2<double>) const { return {below, ended, 0}; }
};

// Less steep than a refracted ray: the march crosses pixels on screen.
constexpr Vec3<double> kDown{0, -0.5, 0.866}, kAside{0.8, -0.5, 0.3317};
constexpr Size kSize{640, 360};

/// A view of water, and the ray of one pixel, which falls by half of its length.
struct View {
  explicit View(Vec3<double> direction) : buffers(rect_of(kSize)), pass(pass_of(buffers)) {
    const RowRays<double> rays(pass, 120.5);
    const double calm = rays.calm_depth(320.5);
    begin_pixel(pass, rays, 320.5, 1.0, calm, calm, pixel);
    ray.emplace(pass, pixel, direction);
    most = ray->s_at(reach_in(pass.dry, pixel.uv, ray->across));
  }
  static Pass pass_of(test::Buffers& b) {
    b.fill(PlaneId::kDepth, 1);
    return Pass(test::simple_scene(kSize), b.frame, 1.333, {});
  }
  /// The shift in pixels at this length of the ray.
  double on_screen(double distance) const {
    const Vec2<double> shift = ray->shift_at(distance);
    return std::hypot(kSize.width * shift.x, kSize.height * shift.y);
  }
  /// The length of the ray some pixels beyond this length.
  double beyond(double distance, double pixels) const {
    return ray->at_share(ray->share_at(distance, most) + pixels / on_screen(most), most);
  }

  test::Buffers buffers;
  Pass pass;
  Pixel<double> pixel{};
  std::optional<ScreenRay<double>> ray;
  double most;  ///< the length of the ray at the edge of the picture
};

BottomSearch<double, FlatBottom>::Found march(View& view, const FlatBottom& tap) {
  view.pixel.dry_depth = view.pixel.surface_depth * (1 + tap.drop / view.pass.eye_above);
  const SeenPlanes planes{PlaneId::kColorR, PlaneId::kDepth, view.pass.dry, false};
  int expected = 0;
  return BottomSearch<double, FlatBottom>{view.pass, planes, view.pixel, tap,
                                          *view.ray, 0.5,    0,          expected}
      .march();
}

// Steps from a bottom to a shelf beside it and back again: the ray meets what is between them.
TEST(BottomSearch, StepsThatLeadBackAndForthMeetInTheMiddle) {
  View view(kAside);
  int looks = 0, expected = 0;
  FlatBottom tap{view.pass, view.pixel, 1, looks};
  view.pixel.dry_depth = view.pixel.surface_depth * (1 + tap.drop / view.pass.eye_above);
  const SeenPlanes planes{PlaneId::kColorR, PlaneId::kDepth, view.pass.dry, false};
  const BottomSearch<double, FlatBottom> search{view.pass, planes, view.pixel, tap,
                                                *view.ray, 0.5,    0,          expected};
  EXPECT_NEAR(search.iterate(2).distance, 2, 1e-9);
  tap.mixed_shelf = 0.25, tap.mixed_shelf_from = view.ray->shift_at(1).x;
  EXPECT_NEAR(search.iterate(1).distance, 0.5, 1e-9);
  // From 2 to 0.5, and from there to 2.
  EXPECT_NEAR(search.iterate(2).distance, 1.25, 1e-9);
  EXPECT_NEAR(search.iterate(3).distance, 1.25, 1e-9);
  // From 2 to 1, and on to 0.6: no step leads back.
  tap.mixed = 0.3, tap.mixed_shelf = 0.5, tap.mixed_shelf_from = view.ray->shift_at(0.8).x;
  EXPECT_NEAR(search.iterate(2).distance, 0.6 + 0.4, 1e-9);
  tap.mixed_shelf_from = view.ray->shift_at(1.5).x;
  EXPECT_NEAR(search.iterate(2).distance, 0.6, 1e-9);
  // Nothing is between an end and none.
  tap.mixed_shelf = HUGE_VAL, view.pass.bottomless = true;
  EXPECT_EQ(search.iterate(1).distance, HUGE_VAL);
  EXPECT_EQ(search.iterate(2).distance, search.iterate(3).distance);
}

TEST(BottomSearch, KnownHeightsSaveLookupsAndChangeNothing) {
  View view(kDown);
  int each_looks = 0, known_looks = 0;
  const auto each = march(view, {view.pass, view.pixel, 1, each_looks});
  view.pass.heights.known = true;
  const auto known = march(view, {view.pass, view.pixel, 1, known_looks});
  EXPECT_EQ(each.sure, 1);
  EXPECT_EQ(known.sure, 1);
  EXPECT_NEAR(each.distance, 2, 1e-6);
  EXPECT_EQ(known.distance, each.distance);
  EXPECT_GT(each_looks, 20);
  EXPECT_LT(known_looks, each_looks / 2);
}

// The level between texels is smooth, and off the staircase by a texel and a half at most.
TEST(BottomSearch, TheLevelBetweenTexelsIsNearTheStaircase) {
  for (const Vec3<double>& direction : {kDown, kAside}) {
    View view(direction);
    int looks = 0;
    const auto distance = [&](double mixed) {
      return march(view, {view.pass, view.pixel, 1, looks, mixed}).distance;
    };
    const double near = view.beyond(2, -1.5), far = view.beyond(2, 1.5);
    EXPECT_NEAR(distance(0.1), near, 0.1 * (2 - near));
    EXPECT_NEAR(distance(3), far, 0.1 * (far - 2));
    EXPECT_NEAR(distance(1 + 1e-4), 2 + 2e-4, 1e-9);
  }
}

// Behind the edge of a shelf the ray lies beyond the visible bottom by that share of its depth
// under the calm surface. More than a quarter hides the end of the ray.
TEST(BottomSearch, WhatStandsFarBeforeTheRayHidesItsEnd) {
  View view(kAside);
  int looks = 0;
  const auto sure = [&](double share) {
    return march(view,
                 {view.pass, view.pixel, 20, looks, 20, (1 - share) * 2, view.ray->shift_at(4).x})
        .sure;
  };
  EXPECT_EQ(sure(0.2), 1);
  EXPECT_EQ(sure(0.32), 0);
}

// Behind such a shelf, each end is found in the bottom layer, which goes on there.
TEST(BottomSearch, BehindWhatHidesItTheBottomIsThatOfTheLayer) {
  View view(kAside);
  BottomLayer layer{};
  layer.most_drop = 50;
  view.pass.bottom_layer = &layer;
  int looks = 0;
  constexpr double kShelf = (1 - 0.32) * 1.5;
  for (const double drop : {1.8, 2.3, 2.8}) {
    const FlatBottom tap{
        view.pass, view.pixel, drop, looks, kShelf, kShelf, view.ray->shift_at(3).x};
    const auto found = march(view, tap);
    EXPECT_EQ(found.sure, 0);
    EXPECT_LT(found.distance, view.most);
    EXPECT_NEAR(found.distance, drop / 0.5, 1e-9);
    FlatBottom without = tap;
    without.ended = 1;
    EXPECT_EQ(march(view, without).distance, HUGE_VAL);
  }
}

// A ray that runs close over a rock and passes behind a ridge of the rock meets the rock there. If
// it runs high over the rock it does not, and if that is the bottom, the layer says where it goes
// on.
TEST(BottomSearch, ARidgeHidesAPartOfItsRock) {
  View view(kAside);
  BottomLayer layer{};
  layer.most_drop = 50;
  view.pass.bottom_layer = &layer;
  int looks = 0;
  const auto found = [&](double rock, double bottom) {
    return march(view, {.pass = view.pass,
                        .pixel = view.pixel,
                        .drop = rock,
                        .looks = looks,
                        .shelf = (1 - 0.32) * 2,
                        .shelf_from = view.ray->shift_at(4).x,
                        .below = bottom});
  };
  EXPECT_EQ(found(2.1, 9).sure, 1);
  EXPECT_NEAR(found(2.1, 9).distance, 4, 0.1);
  EXPECT_EQ(found(5, 9).sure, 0);
  EXPECT_EQ(found(2.1, 2.1).sure, 0);
}

// The march meets a cliff that rises between two lookups, though the second lookup lies far behind
// the cliff's top, and less than a unit of the scene below the top.
TEST(BottomSearch, ACliffIsMetBetweenTwoLooks) {
  View view(kAside);
  int looks = 0;
  const double stride = view.on_screen(view.most) / 48;
  for (const double pixels : {0.0, 0.2, 0.4, 0.6, 0.8}) {
    const double distance = view.beyond(2, pixels * stride);
    const double from = view.ray->shift_at(distance).x;
    const double begins = view.ray->shift_at(view.beyond(distance, -0.3 * stride)).x;
    const auto found = march(
        view, {view.pass, view.pixel, 3, looks, 3, 0.55 * 0.5 * distance, from, from - begins});
    EXPECT_EQ(found.sure, 1) << pixels;
    EXPECT_LE(found.distance, distance * 1.05) << pixels;
  }
}

/// A bottom in front of whose pixel hangs a hull, always half as far below the water again as the
/// ray, which so never meets it, up to some pixels away.
struct Hull : FlatBottom {
  const ScreenRay<double>& ray;
  double pixels;

  bool hangs(Vec2<double> shift) const {
    return std::hypot(kSize.width * shift.x, kSize.height * shift.y) < pixels;
  }
  double depth_of(Vec2<double> shift) const {
    const double along = ray.s_at(shift.y / ray.across.y);
    return depth_at(hangs(shift) ? 1.5 * 0.5 * along + 0.01 : drop, shift);
  }
  double nearest(PlaneId, Vec2<double> shift) const { return depth_of(shift); }
  Four<double> read(PlaneId, const Quad& q) const {
    const double depth = depth_of(q.shift);
    return {depth, depth, depth, depth};
  }
};

// The ray passes the hull and leaves the picture before it meets the bottom: its end is not on the
// hull, of which the level at the pixel tells.
TEST(BottomSearch, RaysThatLeaveThePictureEndBeyondIt) {
  View view(kAside);
  int looks = 0;
  constexpr double kDrop = 2000;
  ASSERT_LT(0.5 * view.most, kDrop);
  const Hull tap{{view.pass, view.pixel, kDrop, looks}, *view.ray, 40};
  view.pixel.dry_depth = tap.depth_at(0.01, {0, 0});
  const SeenPlanes planes{PlaneId::kColorR, PlaneId::kDepth, view.pass.dry, false};
  int expected = 0;
  const auto found =
      BottomSearch<double, Hull>{view.pass, planes, view.pixel, tap, *view.ray, 0.5, 0, expected}
          .march();
  EXPECT_EQ(found.sure, 0);
  EXPECT_NEAR(found.distance, 2 * kDrop, 1e-6 * kDrop);
}

}  // namespace
}  // namespace limpid
