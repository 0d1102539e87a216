#include "complete/water_floor.h"

#include <array>

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "op/pass.h"
#include "support.h"

// The bottom of a picture as one level floor, seen from one below the surface.

namespace limpid {
namespace {

constexpr Size kSize{64, 48};
constexpr double kAlbedo = 0.4, kDeep = 3, kSky = 0.2;

/// `lit(x, y)`: share of the light; `wall`: distance ahead; texels with `missing(x, y)` hit
/// nothing.
template <class Lit, class Missing>
WaterFloor floor_of(Lit&& lit, double wall, Missing&& missing, Size size = kSize) {
  Scene scene = test::simple_scene(size);
  const glm::dvec3 eye(0, -1, 0);
  scene.camera->view = glm::lookAt(eye, eye + glm::dvec3(0, -1, -1), {0, 1, 0});
  test::Buffers b(rect_of(size));
  const Rays rays = rays_of(*scene.camera, {size.width, size.height});
  b.set(PlaneId::kDepth, [&](int x, int y) {
    const glm::dvec3 ray = rays.ray_at(x + 0.5, y + 0.5);
    const double floor = ray.y < 0 ? (1 - kDeep) / ray.y : HUGE_VAL;
    return static_cast<float>(missing(x, y) ? HUGE_VAL : std::min(floor, -wall / ray.z));
  });
  for (int c = 0; c < 3; ++c) {
    const Rgb<double>& color = scene.sun->color;
    const double sun =
        scene.sun->direction.y * std::array{color.r, color.g, color.b}[static_cast<std::size_t>(c)];
    b.set(plane_after(PlaneId::kColorR, c),
          [&](int x, int y) { return static_cast<float>(kAlbedo * lit(x, y) * (sun + kSky)); });
  }
  return water_floor(b.frame, Pass(scene, b.frame, 1.333, {}), {kSky, kSky, kSky});
}

constexpr auto kFull = [](int, int) { return 1.0; };
constexpr auto kNowhere = [](int, int) { return false; };

TEST(WaterFloor, IsTheVisibleFloor) {
  for (const Size size : {kSize, Size{1, 1}}) {
    const WaterFloor floor = floor_of(kFull, 1e6, kNowhere, size);
    EXPECT_NEAR(floor.depth, kDeep, 1e-5);
    EXPECT_NEAR(floor.albedo.r, kAlbedo, 1e-5);
    EXPECT_NEAR(floor.albedo.b, kAlbedo, 1e-5);
    EXPECT_EQ(floor.share, 1);
  }
}

TEST(WaterFloor, HasTheShadeInItsAlbedo) {
  const auto half = [](int x, int) { return x < 32 ? 1.0 : 0.0; };
  EXPECT_NEAR(floor_of(half, 1e6, kNowhere).albedo.g, kAlbedo / 2, 0.01);
}

TEST(WaterFloor, OfAWallCountsItsFootMost) {
  const double depth = floor_of(kFull, 2, kNowhere).depth;
  EXPECT_GT(depth, 0.85 * kDeep);
  EXPECT_LT(depth, kDeep);
}

TEST(WaterFloor, IsThereForAShareOfTheViews) {
  EXPECT_NEAR(floor_of(kFull, 1e6, [](int x, int) { return x < 16; }).share, 0.75, 0.01);
  EXPECT_EQ(floor_of(kFull, 1e6, [](int, int) { return true; }).share, 0);
}

}  // namespace
}  // namespace limpid
