#include "raster/shadow_map.h"

#include <gtest/gtest.h>

#include "limpid/core/error.h"

#include "raster_scenes.h"

namespace limpid {
namespace {

using namespace test;

/// A box from min to max, its faces outwards.
Mesh box(glm::vec3 low, glm::vec3 high) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.positions.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y,
                                i & 4 ? high.z : low.z);
  }
  mesh.indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                  2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  return mesh;
}

Model box_on_ground() {
  return model_of(
      {quad({-8, 0, 8}, {8, 0, 8}, {8, 0, -8}, {-8, 0, -8}), box({-1, 0, -1}, {1, 2, 1})},
      white(Shading::kLambert));
}

TEST(ShadowMap, OfABoxByHand) {
  // The sun stands 45 degrees high in +x: the box of height 2 shades x from -3 to its side at -1.
  const Model model = box_on_ground();
  const Sun sun{glm::normalize(glm::dvec3(1, 1, 0)), {1, 1, 1}};
  const ShadowMap map = make_shadow_map(model, sun, std::nullopt, 512, *make_executor(2));
  const glm::dvec3 up(0, 1, 0);
  for (double z : {-0.8, 0.0, 0.8}) {
    for (double x : {-2.7, -2.0, -1.3}) EXPECT_EQ(shadow_at(map, {x, 0, z}, up), 0) << x;
    for (double x : {-7.9, -5.0, -3.2, 1.2, 4.0, 7.9}) EXPECT_EQ(shadow_at(map, {x, 0, z}, up), 1);
  }
  for (double z : {-1.3, 1.3}) EXPECT_EQ(shadow_at(map, {-2, 0, z}, up), 1);
  EXPECT_EQ(shadow_at(map, {0, 2, 0}, up), 1);             // the roof
  EXPECT_EQ(shadow_at(map, {1, 1, 0}, {1, 0, 0}), 1);      // the sunny side
  EXPECT_EQ(shadow_at(map, {-1, 1, 0}, {-1, 0, 0}), 0);    // the far side faces away
  EXPECT_EQ(shadow_at(map, {100, 0, 100}, up), 1);         // outside the map
  EXPECT_NEAR(shadow_at(map, {-3, 0, 0}, up), 0.5, 0.45);  // in the blur of the rim
}

TEST(ShadowMap, ThePassEvaluatesItAtEachPixel) {
  const Model model = box_on_ground();
  const Sun sun{glm::normalize(glm::dvec3(1, 0.7, 0.4)), {1, 1, 1}};
  const ShadowMap map = make_shadow_map(model, sun, std::nullopt, 256, *make_executor(1));
  const RasterView view = perspective_view(120, 90, {-3, 6, 7}, {-1, 0, 0});
  const RasterImage image = drawn(model, view, {sun, &map});
  const Rays rays = rays_of(view.camera, {120, 90});
  int dark = 0, lit = 0, unequal = 0;
  for (int y = 0; y < 90; ++y) {
    for (int x = 0; x < 120; ++x) {
      if (at(image.coverage, x, y) == 0) {
        EXPECT_EQ(at(image.shadow, x, y), 1);
        continue;
      }
      const glm::dvec3 p =
          view.camera.eye() + double(at(image.depth, x, y)) * rays.ray_at(x + 0.5, y + 0.5);
      const glm::dvec3 n(at(image.normal[0], x, y), at(image.normal[1], x, y),
                         at(image.normal[2], x, y));
      const double expected = shadow_at(map, p, n);
      // Float against double may fall on the other side of a comparison, rarely.
      unequal += std::abs(at(image.shadow, x, y) - expected) > 2e-3;
      dark += expected == 0;
      lit += expected == 1;
      // Lambert: ambient + n.L shadow.
      const double cosine = std::max(0.0, glm::dot(n, sun.direction));
      EXPECT_NEAR(at(image.color[0], x, y), 0.2 + cosine * at(image.shadow, x, y), 1e-5);
    }
  }
  EXPECT_LE(unequal, 20);
  EXPECT_GT(dark, 300);
  EXPECT_GT(lit, 3000);
}

TEST(ShadowMap, SlopesDoNotShadeThemselves) {
  const Model model = model_of({hills(40, 20, 0.8)});
  const Sun sun{glm::normalize(glm::dvec3(0.2, 1, 0.3)), {1, 1, 1}};
  const ShadowMap map = make_shadow_map(model, sun, std::nullopt, 200, *make_executor(1));
  const RasterView view = perspective_view(100, 80, {0, 9, 9}, {0, 0, 0});
  const RasterImage image = drawn(model, view, {sun, &map});
  for (int y = 0; y < 80; ++y) {
    for (int x = 0; x < 100; ++x) ASSERT_NEAR(at(image.shadow, x, y), 1, 1e-6) << x << ' ' << y;
  }
}

TEST(ShadowMap, BoundsGiveFinerTexelsAndKeepWhatCastsIntoThem) {
  const Model model = box_on_ground();
  const Sun sun{glm::normalize(glm::dvec3(1, 1, 0)), {1, 1, 1}};
  const auto executor = make_executor(1);
  const ShadowMap all = make_shadow_map(model, sun, std::nullopt, 128, *executor);
  const ShadowMap part =
      make_shadow_map(model, sun, Box{{-3, 0, -1}, {-1, 0.1, 1}}, 128, *executor);
  EXPECT_LT(part.texel, 0.4 * all.texel);
  EXPECT_EQ(shadow_at(part, {-2, 0, 0}, {0, 1, 0}), 0);  // though the roof is outside the bounds
}

TEST(ShadowMap, WaterCastsNoShadow) {
  Model model = box_on_ground();
  model.instances[1].water = true;
  const Sun sun{glm::normalize(glm::dvec3(1, 1, 0)), {1, 1, 1}};
  const ShadowMap map = make_shadow_map(model, sun, std::nullopt, 128, *make_executor(1));
  EXPECT_EQ(shadow_at(map, {-2, 0, 0}, {0, 1, 0}), 1);
}

TEST(ShadowMap, RefusesBadSizesAndSuns) {
  const Model model = box_on_ground();
  const auto executor = make_executor(1);
  EXPECT_THROW(make_shadow_map(model, Sun{}, std::nullopt, 0, *executor), Error);
  EXPECT_THROW(make_shadow_map(model, Sun{{0, 2, 0}, {1, 1, 1}}, std::nullopt, 64, *executor),
               Error);
  Model empty = model;
  empty.instances.clear();
  EXPECT_EQ(
      shadow_at(make_shadow_map(empty, Sun{}, std::nullopt, 16, *executor), {0, 0, 0}, {0, 1, 0}),
      1);
}

}  // namespace
}  // namespace limpid
