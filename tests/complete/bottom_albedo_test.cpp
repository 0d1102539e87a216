#include "complete/bottom_albedo.h"

#include <cmath>
#include <vector>

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
  return albedo.channel(1).view().at(24, 24) * albedo.basin().view().at(24, 24);
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

/// The albedo in green in the middle of an endless floor that is 1 deep, seen from 8 above; lit
/// where lit(x, y).
template <class Lit>
double albedo_of_floor(const WaterOver& water, Lit&& lit) {
  constexpr Size kWide{320, 320};
  constexpr double kAlbedo = 0.6, kSky = 0.1;
  Scene scene = test::simple_scene(kWide);
  const glm::dvec3 eye(0, 8, 0);
  scene.camera->view = glm::lookAt(eye, glm::dvec3(0, 0, 0), {0, 0, -1});
  test::Buffers b(rect_of(kWide));
  b.fill(PlaneId::kDepth, 9);
  b.set(PlaneId::kShadow, lit);
  const double sun = scene.sun->direction.y;
  for (int c = 0; c < 3; ++c) {
    const double full = sun * (c == 0   ? scene.sun->color.r
                               : c == 1 ? scene.sun->color.g
                                        : scene.sun->color.b);
    b.set(plane_after(PlaneId::kColorR, c),
          [&](int x, int y) { return static_cast<float>(kAlbedo * (full * lit(x, y) + kSky)); });
  }
  const Pass pass(scene, b.frame, 1.333, {});
  BottomAlbedo albedo;
  albedo.make(b.frame, pass, {kSky, kSky, kSky}, water, *make_executor(1));
  return albedo.channel(1).view().at(160, 160) * albedo.basin().view().at(160, 160);
}

// Half of the floor is in the shade of something above, and the surface throws back half as much of
// the sun's light: the albedo is that of a floor in full light that the water makes as bright.
TEST(BottomAlbedo, FloorInTheShadeThrowsBackLess) {
  ScatteredLightMaker maker;
  const WaterOver water{
      maker.make({.absorption = {0.05, 0.05, 0.05}, .beam = 0.8}), {0.05, 0.05, 0.05}, 0.8};
  EXPECT_NEAR(albedo_of_floor(water, [](int, int) { return 1.0f; }), 0.6, 1e-3);
  const double half =
      albedo_of_floor(water, [](int x, int y) { return (x / 16 + y / 16) % 2 == 0 ? 1.0f : 0.0f; });
  const ScatteredLight& light = water.light[1];
  const double back = light.back_at_once + layer_power(light.back, layer_variable(0.05));
  const Scene scene = test::simple_scene(kSize);
  const double full = scene.sun->direction.y * scene.sun->color.g;
  const double lit = (0.5 * full + 0.1) / (full + 0.1);
  const double had = 1;  // without scattering
  EXPECT_NEAR(half * (1 / (1 - half * back) - had), lit * 0.36 * back / (1 - 0.6 * back), 0.01);
  EXPECT_LT(half, 0.5);
}

/// The albedo in green along a row of a strip that shows water 1 deep, 5 long, from above. The
/// right half of the floor is brighter.
std::vector<float> albedo_of_strip(int width, const WaterOver& water) {
  const Size size{width, width / 60};
  Scene scene = test::simple_scene(size);
  scene.camera->view = glm::lookAt(glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 0), {0, 0, -1});
  scene.camera->projection = perspective(2 * std::atan(2.5 / 60 / 2), 60, 0.1, 1e3, ClipSpace::kGl);
  scene.sun.reset();
  test::Buffers b(rect_of(size));
  b.fill(PlaneId::kDepth, 2);
  for (int c = 0; c < 3; ++c) {
    b.set(plane_after(PlaneId::kColorR, c),
          [&](int x, int) { return 2 * x < width ? 0.1f : 0.7f; });
  }
  const Pass pass(scene, b.frame, 1.333, {});
  BottomAlbedo albedo;
  albedo.make(b.frame, pass, {1, 1, 1}, water, *make_executor(1));
  const float* row = albedo.channel(1).view().row(size.height / 2);
  return {row, row + width};
}

TEST(BottomAlbedo, ReachesAsFarInALargerPicture) {
  ScatteredLightMaker maker;
  const WaterOver water{
      maker.make({.absorption = {0.1, 0.1, 0.1}, .beam = 0.8}), {0.1, 0.1, 0.1}, 0.8};
  const std::vector<float> albedo = albedo_of_strip(1920, water),
                           larger = albedo_of_strip(3840, water);
  EXPECT_GT(albedo[1100], 0.45f);
  EXPECT_LT(albedo[1100], 0.65f);
  for (std::size_t x = 0; x < albedo.size(); ++x) EXPECT_NEAR(larger[2 * x], albedo[x], 4e-3f) << x;
}

}  // namespace
}  // namespace limpid
