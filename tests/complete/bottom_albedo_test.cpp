#include "complete/bottom_albedo.h"

#include <cmath>

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "complete/scattered_light.h"
#include "support.h"

// The albedo of a bottom in a basin, from above the water and from within.

namespace limpid {
namespace {

constexpr Size kSize{48, 36};

/// The albedo in green of a bottom in a basin 3 wide and 2 deep, seen along the basin from `height`
/// above the water; the bottom is 4 away.
float albedo_from(double height, ScatteredLightMaker& maker) {
  Scene scene = test::simple_scene(kSize);
  const glm::dvec3 eye(0, height, 0);
  scene.camera->view = glm::lookAt(eye, eye + glm::dvec3(0, -0.2, -1), {0, 1, 0});
  test::Buffers b(rect_of(kSize));
  for (int c = 0; c < 3; ++c) b.fill(plane_after(PlaneId::kColorR, c), 0.5f);
  b.fill(PlaneId::kShadow, 1);
  const Rays rays = rays_of(*scene.camera, {kSize.width, kSize.height});
  b.set(PlaneId::kDepth, [&](int x, int y) {
    const glm::dvec3 ray = rays.ray_at(x + 0.5, y + 0.5);
    const double floor = ray.y < 0 ? (-2 - height) / ray.y : HUGE_VAL;
    return static_cast<float>(std::min(floor, 1.5 / std::max(std::abs(ray.x), 1e-9)));
  });
  const Pass pass(scene, b.frame, 1.333, {});
  const ScatteredLights& light = maker.make({.absorption = {0.3, 0.1, 0.05}, .beam = 0.8});
  BottomAlbedo albedo;
  albedo.make(b.frame, pass, {0.4, 0.4, 0.4}, {light, {0.3, 0.1, 0.05}, 0.8}, *make_executor(1));
  return albedo.channel(1).view().at(24, 24);
}

TEST(BottomAlbedo, ChangesWithoutAStepWhereAViewGoesUnderTheWater) {
  ScatteredLightMaker maker;
  const float over = albedo_from(0.1, maker), under = albedo_from(-0.1, maker);
  const float whole = std::abs(over - under);
  EXPECT_GT(whole, 0.01f);  // walls around count only from above the water
  float before = over;
  for (int i = 1; i <= 40; ++i) {
    const float now = albedo_from(0.1 - 0.005 * i, maker);
    EXPECT_LT(std::abs(now - before), 0.25f * whole) << 0.1 - 0.005 * i;
    before = now;
  }
}

}  // namespace
}  // namespace limpid
