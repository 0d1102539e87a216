#include "op/screen_ray.h"

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "op/pixel.h"
#include "op/pixel_start.h"
#include "support.h"

namespace limpid {
namespace {

/// A ray from the middle of a picture, in this direction.
ScreenRay<double> ray_towards(const Pass& c, Vec3<double> direction) {
  Pixel<double> p{};
  p.uv = {0.5, 0.5};
  p.surface_depth = 6;
  return ScreenRay<double>(c, p, direction);
}

TEST(ScreenRay, ShareOfTheWayOnScreenAndBack) {
  const Size size{64, 48};
  const test::Buffers b = test::noisy_frame(rect_of(size));
  const Scene scene = test::simple_scene(size);
  const Pass c(scene, b.frame, 1.333, {});
  const Vec3<double> directions[] = {{0, -1, 0}, {0.3, -0.8, 0.5}, {-0.2, -0.7, -0.6}};
  for (const Vec3<double>& direction : directions) {
    const ScreenRay<double> ray = ray_towards(c, direction);
    for (const double end : {0.5, 3.0}) {
      EXPECT_NEAR(ray.share_at(0, end), 0, 1e-12);
      EXPECT_NEAR(ray.share_at(end, end), 1, 1e-12);
      for (const double t : {0.01, 0.3, 0.9}) {
        const double s = ray.at_share(t, end);
        EXPECT_NEAR(ray.share_at(s, end), t, 1e-12);
        // Shares are of the ray on screen: the shift at a share is that part of the shift at the
        // end.
        EXPECT_NEAR(ray.shift_at(s).y, t * ray.shift_at(end).y, 1e-12);
      }
    }
  }
}

// What a pixel knows of the rest of the screen, besides the rays of the camera.

constexpr Size kSize{64, 48};

/// Perspective, turned off the axes of the world, and parallel; both level and rolled.
template <class Visit>
void for_each_view(Visit&& visit) {
  const test::Buffers b = test::noisy_frame(rect_of(kSize));
  for (const double roll : {0.0, 0.3}) {
    for (const bool parallel : {false, true}) {
      Scene scene = test::simple_scene(kSize);
      scene.camera->view =
          glm::rotate(glm::dmat4(1), roll, glm::dvec3(0, 0, 1)) * scene.camera->view;
      if (parallel) scene.camera->projection = orthographic(2.4, 1.8, 0.1, 100, ClipSpace::kGl);
      visit(Pass(scene, b.frame, 1.333, {}), parallel);
    }
  }
}

Pixel<double> pixel_at(const Pass& c, double x, double y, double surface_depth) {
  Pixel<double> p{};
  begin_pixel(c, RowRays<double>(c, y), x, 1.0, surface_depth, 1e9, p);
  return p;
}

/// The visible point at x, y and eye depth `depth`, relative to the eye.
Vec3<double> point_at(const Pass& c, double x, double y, double depth) {
  const RowRays<double> row(c, y);
  return row.origin_at(x) + depth * row.ray_at(x);
}

Vec2<double> shift_of(double right, double down) {
  return {right / kSize.width, down / kSize.height};
}

double height_of(const Pass& c, const Vec3<double>& point) {
  return c.eye_above + dot(vec3_of<double>(c.up), point);
}

TEST(ScreenRay, PassesThroughWhatTheCameraSeesAtItsPlaces) {
  for_each_view([](const Pass& c, bool parallel) {
    const Pixel<double> p = pixel_at(c, 20.5, 30.5, 3);
    for (const Vec2<double>& pixels : {Vec2<double>{9, 4}, {-7, 12}, {0.5, -3}, {-15, -2}}) {
      const Vec3<double> end = point_at(c, 20.5 + pixels.x, 30.5 + pixels.y, 5);
      const Vec3<double> offset = end - p.surface_point;
      const double far = length(offset);
      const ScreenRay<double> ray(c, p, (1 / far) * offset);
      const Vec2<double> shift = shift_of(pixels.x, pixels.y), got = ray.shift_at(far);
      EXPECT_NEAR(got.x, shift.x, 1e-9) << parallel;
      EXPECT_NEAR(got.y, shift.y, 1e-9) << parallel;
      EXPECT_NEAR(ray.depth_at(far), 5, 1e-9) << parallel;
      // The shift as a multiple of `across`, and back.
      const double reach = shift.y / ray.across.y;
      EXPECT_NEAR(ray.s_at(reach), far, 1e-6 * far) << parallel;
    }
  });
}

TEST(ScreenRay, VanishesWhereItsDirectionIsSeen) {
  for_each_view([](const Pass& c, bool parallel) {
    if (parallel) return;
    const Pixel<double> p = pixel_at(c, 20.5, 30.5, 3);
    const RowRays<double> row(c, 34.5);
    const Vec3<double> direction = normalize_or(row.ray_at(29.5), {0, 1, 0});
    const ScreenRay<double> ray(c, p, direction);
    EXPECT_NEAR(ray.shift_at(HUGE_VAL).x, 9.0 / 64, 1e-9);
    EXPECT_NEAR(ray.shift_at(HUGE_VAL).y, 4.0 / 48, 1e-9);
    EXPECT_EQ(ray.s_at(2 / ray.w_step), HUGE_VAL) << "twice as far as the vanishing point";
    // Towards the viewer and past the viewer, the shift is huge, on the same side, and finite.
    const ScreenRay<double> back(c, p, -1.0 * direction);
    const Vec2<double> past = back.shift_at(1e4);
    EXPECT_GT(std::abs(past.x), 100);
    EXPECT_TRUE(std::isfinite(past.x) && std::isfinite(past.y));
    EXPECT_EQ(past.x > 0, back.across.x > 0);
  });
}

TEST(ScreenRay, HeightsAndWaysAreThoseOfThePointsSeen) {
  for_each_view([](const Pass& c, bool parallel) {
    const Pixel<double> p = pixel_at(c, 20.5, 30.5, 3);
    for (const Vec2<double>& pixels : {Vec2<double>{0, 0}, {9, 4}, {-7, 12}, {11, -20}}) {
      const Vec2<double> shift = shift_of(pixels.x, pixels.y);
      for (const double depth : {0.5, 3.0, 40.0}) {
        const Vec3<double> there = point_at(c, 20.5 + pixels.x, 30.5 + pixels.y, depth);
        EXPECT_NEAR(height_at(c, p, shift, depth), height_of(c, there), 1e-9) << parallel;
        const Vec3<double> want = there - p.surface_point, got = offset_to(c, p, shift, depth);
        EXPECT_NEAR(got.x, want.x, 1e-9) << parallel;
        EXPECT_NEAR(got.y, want.y, 1e-9) << parallel;
        EXPECT_NEAR(got.z, want.z, 1e-9) << parallel;
      }
    }
  });
}

TEST(ScreenRay, DropsAreFoundWhereTheyAre) {
  for_each_view([](const Pass& c, bool parallel) {
    const Pixel<double> p = pixel_at(c, 20.5, 30.5, 3);
    for (const Vec2<double>& pixels : {Vec2<double>{0, 0}, {9, 4}, {-7, 12}}) {
      const double x = 20.5 + pixels.x, y = 30.5 + pixels.y;
      const Vec2<double> shift = shift_of(pixels.x, pixels.y);
      for (const double drop : {0.0, 0.25, 2.0}) {
        const double depth = depth_at_drop(c, p, shift, drop);
        ASSERT_TRUE(std::isfinite(depth)) << parallel;
        EXPECT_NEAR(height_of(c, point_at(c, x, y, depth)), -drop, 1e-9) << parallel;
      }
      const double here = RowRays<double>(c, y).calm_depth(x);
      EXPECT_NEAR(calm_depth_at(c, p, shift), here, 1e-9) << parallel;
      const double below = RowRays<double>(c, y + 1).calm_depth(x);
      EXPECT_NEAR(calm_depth_step(c, p, shift), std::abs(here - below), 1e-9) << parallel;
    }
  });
}

TEST(ScreenRay, ReachEndsAtTheEdgeThatTheWayLeadsTo) {
  const Bounds bounds{{0.125, 0.25}, {0.875, 1}};
  const Vec2<double> uv{0.5, 0.75};
  const auto reach = [&](double x, double y) { return reach_in(bounds, uv, Vec2<double>{x, y}); };
  EXPECT_NEAR(reach(0.25, 0), 1.5, 1e-4);
  EXPECT_NEAR(reach(-0.75, 0), 0.5, 1e-4);
  EXPECT_NEAR(reach(0, 0.125), 2, 1e-4);
  EXPECT_NEAR(reach(0, -0.25), 2, 1e-4);
  EXPECT_NEAR(reach(0.25, 0.125), 1.5, 1e-4) << "the nearer of both";
  EXPECT_NEAR(reach(0.125, 0.25), 1, 1e-4);
  EXPECT_GT(reach(0, 0), 1e12) << "no way leads nowhere";
  EXPECT_NEAR(reach_in(bounds, Vec2<double>{0, 0.75}, Vec2<double>{-0.25, 0}), 0, 1e-4)
      << "from outside";
}

TEST(ScreenRay, ReachAheadEndsAtTheEdgeThatTheWayMainlyLeadsTo) {
  const test::Buffers buffers(rect_of({400, 200}));
  const Pass view(test::simple_scene({400, 200}), buffers.frame, 1.333, {});
  const Bounds bounds{{0.125, 0.25}, {0.875, 1}};
  const auto reach = [&](double x, double y) {
    return reach_ahead(view, bounds, Vec2<double>{0.875, 0.75}, Vec2<double>{x, y});
  };
  EXPECT_NEAR(reach(0.1, -0.25), 2, 1e-4) << "up, although a side is nearer";
  EXPECT_NEAR(reach(0.1, -0.19), 0, 1e-4) << "40 pixels to the right, 38 up";
  EXPECT_NEAR(reach(-0.25, 0.125), 3, 1e-4);
}

}  // namespace
}  // namespace limpid
