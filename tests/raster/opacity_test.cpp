#include <algorithm>

#include <gtest/gtest.h>

#include "limpid/core/simd.h"

#include "raster/shadow_map.h"
#include "raster_scenes.h"

namespace limpid {
namespace {

using namespace test;

const Rgb<double> kBackground{0.25, 0.5, 0.75};

Material sheet_of(AlphaMode mode, double alpha, Rgb<double> color = {1, 1, 1}) {
  Material m = white(Shading::kFlat);
  m.alpha_mode = mode;
  m.alpha = alpha;
  m.base_color = color;
  return m;
}

struct Sheet {
  Material material;
  double depth;
};

/// Squares of 20 x 20 pixels around the middle of 32 x 32, one behind the other.
Model sheets(const std::vector<Sheet>& list) {
  std::vector<Mesh> meshes;
  for (const Sheet& sheet : list) {
    const double d = sheet.depth;
    meshes.push_back(quad(pixel_point(6, 26, d), pixel_point(26, 26, d), pixel_point(26, 6, d),
                          pixel_point(6, 6, d)));
    meshes.back().material = static_cast<int>(meshes.size()) - 1;
  }
  Model model = model_of(std::move(meshes));
  model.materials.clear();
  for (const Sheet& sheet : list) model.materials.push_back(sheet.material);
  return model;
}

RasterImage shown(const Model& model) { return drawn(model, flat_view(32, 32)); }

void expect_color(const RasterImage& image, const Rgb<double>& expected, int x = 16, int y = 16) {
  EXPECT_NEAR(at(image.color[0], x, y), expected.r, 2e-6);
  EXPECT_NEAR(at(image.color[1], x, y), expected.g, 2e-6);
  EXPECT_NEAR(at(image.color[2], x, y), expected.b, 2e-6);
}

Rgb<double> over(double alpha, const Rgb<double>& front, const Rgb<double>& behind) {
  return alpha * front + (1 - alpha) * behind;
}

/// Opacity 1 to the left, 0 to the right, and on a line between from a quarter to three.
Model half_there(AlphaMode mode) {
  Model model = sheets({{sheet_of(mode, 1, {1, 0, 0}), 3}, {sheet_of({}, 1, {0, 1, 0}), 5}});
  model.textures = {{2, 1, {1, 1, 1, 1, 1, 1, 1, 0}}};
  model.materials[0].base_texture = 0;
  model.materials[0].base_lookup = {0, Wrap::kClamp, Wrap::kClamp};
  return model;
}

TEST(Opacity, OpaqueMaterialsIgnoreAlpha) {
  Model model = half_there(AlphaMode::kOpaque);
  model.materials[0].alpha = 0.25;
  model.meshes[0].colors.assign(4, glm::vec4(1, 1, 1, 0));
  const RasterImage image = shown(model);
  for (const int x : {7, 16, 25}) {
    expect_color(image, {1, 0, 0}, x);
    EXPECT_EQ(at(image.depth, x, 16), 3);
  }
}

TEST(Opacity, AMaskShowsWhatLiesBehind) {
  const RasterImage image = shown(half_there(AlphaMode::kMask));
  // u = (x + 0.5 - 6) / 20 and opacity 1.5 - 2 u: 0.55 at x = 15, 0.45 at x = 16.
  for (const int x : {6, 15}) {
    expect_color(image, {1, 0, 0}, x);
    EXPECT_EQ(at(image.depth, x, 16), 3);
  }
  for (const int x : {16, 25}) {
    expect_color(image, {0, 1, 0}, x);
    EXPECT_EQ(at(image.depth, x, 16), 5);
    EXPECT_EQ(at(image.coverage, x, 16), 1);
  }
}

TEST(Opacity, NothingIsWhereAMaskHidesAll) {
  Model model = half_there(AlphaMode::kMask);
  model.instances.pop_back();
  const RasterImage image = shown(model);
  expect_color(image, kBackground, 20);
  EXPECT_EQ(at(image.depth, 20, 16), kInfinity);
  EXPECT_EQ(at(image.coverage, 20, 16), 0);
  EXPECT_EQ(at(image.normal[2], 20, 16), 0);
  EXPECT_EQ(at(image.normal[2], 8, 16), 1);
}

TEST(Opacity, TheCutoffItselfIsThere) {
  for (const auto& [alpha, cutoff, there] : {std::tuple{0.5, 0.5, true},
                                             {0.5, 0.501, false},
                                             {0.2, 0.2, true},
                                             {1.0, 1.0, true},
                                             {1.0, 1.01, false},
                                             {0.0, 0.0, true}}) {
    Model model = sheets({{sheet_of(AlphaMode::kMask, alpha), 3}});
    model.materials[0].alpha_cutoff = cutoff;
    // One texel over and over: shares of texels that do not sum up to quite 1.
    model.textures = {{2, 2, std::vector<float>(16, 1.0f)}};
    model.materials[0].base_texture = 0;
    const RasterImage image = shown(model);
    for (int x = 6; x < 26; ++x) {
      EXPECT_EQ(at(image.coverage, x, 16), there ? 1 : 0) << alpha << " " << cutoff << " " << x;
    }
  }
}

TEST(Opacity, TwoLayersLieOverOneAnother) {
  const Rgb<double> near{1, 0, 0.5}, middle{0, 2, 0}, far{0.5, 0.5, 4};
  const RasterImage image = shown(sheets({{sheet_of(AlphaMode::kBlend, 0.25, near), 1},
                                          {sheet_of(AlphaMode::kBlend, 0.75, middle), 2},
                                          {sheet_of({}, 1, far), 3}}));
  expect_color(image, over(0.25, near, over(0.75, middle, far)));
  expect_color(image, kBackground, 3);
  const RasterImage open = shown(sheets({{sheet_of(AlphaMode::kBlend, 0.25, near), 1},
                                         {sheet_of(AlphaMode::kBlend, 0.75, middle), 2}}));
  expect_color(open, over(0.25, near, over(0.75, middle, kBackground)));
}

TEST(Opacity, IsFactorTimesTextureTimesVertexColor) {
  Model model = sheets({{sheet_of(AlphaMode::kBlend, 0.5, {2, 1, 1}), 1}});
  model.textures = {{1, 1, {0.5f, 1, 0.25f, 0.8f}}};
  model.materials[0].base_texture = 0;
  model.meshes[0].colors.assign(4, glm::vec4(0.5f, 0.25f, 1, 0.5f));
  expect_color(shown(model), over(0.5 * 0.8 * 0.5, {0.5, 0.25, 0.25}, kBackground));
}

TEST(Opacity, WhatIsOpaqueHidesBlendedSurfaces) {
  const Rgb<double> red{1, 0, 0}, green{0, 1, 0};
  expect_color(
      shown(sheets({{sheet_of(AlphaMode::kBlend, 0.5, red), 5}, {sheet_of({}, 1, green), 3}})),
      green);
  // So does an opaque blended sheet, and a masked sheet where its mask is opaque.
  expect_color(shown(sheets({{sheet_of(AlphaMode::kBlend, 0.5, red), 5},
                             {sheet_of(AlphaMode::kBlend, 1, green), 3}})),
               green);
  Model masked = half_there(AlphaMode::kMask);
  masked.materials.push_back(sheet_of(AlphaMode::kBlend, 0.5, {0, 0, 1}));
  masked.meshes.push_back(masked.meshes[1]);
  masked.meshes[2].material = 2;
  for (glm::vec3& p : masked.meshes[2].positions) p.z = -4;
  masked.instances.push_back({2, glm::dmat4(1), false});
  const RasterImage image = shown(masked);
  expect_color(image, {1, 0, 0}, 8);
  expect_color(image, over(0.5, {0, 0, 1}, green), 24);
}

TEST(Opacity, DepthIsOfTheFirstThatHidesHalf) {
  for (const auto& [alpha, depth] : {std::pair{0.49, 3.0}, {0.5, 2.0}, {0.75, 2.0}, {1.0, 2.0}}) {
    const RasterImage image = shown(sheets({{sheet_of(AlphaMode::kBlend, 0.3, {1, 0, 0}), 1},
                                            {sheet_of(AlphaMode::kBlend, alpha, {0, 1, 0}), 2},
                                            {sheet_of({}, 1, {0, 0, 1}), 3}}));
    EXPECT_EQ(at(image.depth, 16, 16), depth) << alpha;
    expect_color(image, over(0.3, {1, 0, 0}, over(alpha, {0, 1, 0}, {0, 0, 1})));
  }
  const RasterImage thin = shown(sheets({{sheet_of(AlphaMode::kBlend, 0.49), 1}}));
  EXPECT_EQ(at(thin.depth, 16, 16), kInfinity);
  EXPECT_EQ(at(thin.coverage, 16, 16), 0);
}

TEST(Opacity, PlanesAreTheSameWhateverElseIsWanted) {
  Model model = mixed_model();
  for (Material& m : model.materials) {
    m.alpha_mode = AlphaMode::kBlend;
    m.alpha = 0.6;
  }
  model.materials[1].alpha_mode = AlphaMode::kMask;
  for (std::size_t i = 3; i < model.textures[0].rgba.size(); i += 8) model.textures[0].rgba[i] = 0;
  const RasterView view = mixed_view(90, 70);
  const RasterImage all = drawn(model, view, low_sun());
  const std::vector<float> depth = values(drawn(model, view, low_sun(), {.depth = true}));
  const std::vector<float> color = values(drawn(model, view, low_sun(), {.color = true}));
  const std::vector<float> shadow = values(drawn(model, view, low_sun(), {.shadow = true}));
  for (int y = 0, i = 0; y < 70; ++y) {
    for (int x = 0; x < 90; ++x, ++i) {
      ASSERT_EQ(depth[static_cast<std::size_t>(i)], at(all.depth, x, y)) << x << " " << y;
      ASSERT_EQ(color[static_cast<std::size_t>(i)], at(all.color[0], x, y)) << x << " " << y;
      ASSERT_EQ(shadow[static_cast<std::size_t>(i)], at(all.shadow, x, y)) << x << " " << y;
    }
  }
}

TEST(Opacity, OrderOfTheFileDoesNotCount) {
  Model model = mixed_model();
  for (std::size_t i = 0; i < model.materials.size(); ++i) {
    model.materials[i].alpha_mode = static_cast<AlphaMode>(i % 3);
    model.materials[i].alpha = 0.2 + 0.15 * static_cast<double>(i);
  }
  model.materials[1].alpha_cutoff = 0.3;
  const RasterView view = mixed_view(90, 70);
  const std::vector<float> expected = values(drawn(model, view, low_sun()));
  std::reverse(model.instances.begin(), model.instances.end());
  EXPECT_EQ(values(drawn(model, view, low_sun())), expected);
  std::rotate(model.instances.begin(), model.instances.begin() + 2, model.instances.end());
  EXPECT_EQ(values(drawn(model, view, low_sun())), expected);
  EXPECT_EQ(values(rasterise(model, view, low_sun(), kEverything, *make_executor(3))), expected);
}

TEST(Opacity, SurfacesInOnePlaneLieInTheirOrder) {
  const Model model = sheets({{sheet_of(AlphaMode::kBlend, 0.25, {1, 0, 0}), 2},
                              {sheet_of(AlphaMode::kBlend, 0.75, {0, 1, 0}), 2}});
  expect_color(shown(model), over(0.25, {1, 0, 0}, over(0.75, {0, 1, 0}, kBackground)));
}

TEST(Opacity, LayersBeyondTheLimitAreLeftOut) {
  std::vector<Sheet> list;
  for (int i = 0; i < kBlendedLayers + 6; ++i) {
    list.push_back({sheet_of(AlphaMode::kBlend, 1.0 / 64, {1, 1, 1}), 1.0 + i});
  }
  const double left = std::pow(1 - 1.0 / 64, kBlendedLayers);
  expect_color(shown(sheets(list)), (1 - left) * Rgb<double>{1, 1, 1} + left * kBackground);
}

TEST(Opacity, LayersThatNothingShowsThroughEndThePixel) {
  std::vector<Sheet> list;
  for (int i = 0; i < 20; ++i) list.push_back({sheet_of(AlphaMode::kBlend, 0.75), 1.0 + i});
  list[7].material.base_color = {1e6, 1e6, 1e6};  // behind 7 sheets: a quarter to the power of 7
  const double left = std::pow(0.25, 6);
  ASSERT_EQ(left, 1.0 / 4096);
  expect_color(shown(sheets(list)), over(1 - left / 4, {1, 1, 1}, kBackground));
}

TEST(Opacity, EveryInstructionSetBlends) {
  const Rgb<double> near{1, 0, 0.5}, far{0, 2, 0};
  Model model = sheets(
      {{sheet_of(AlphaMode::kBlend, 0.25, near), 1}, {sheet_of(AlphaMode::kBlend, 0.4, far), 2}});
  for (const std::string& simd : simd_targets()) {
    const RasterImage image = drawn(model, flat_view(32, 32), {}, kEverything, simd);
    for (int x = 6; x < 26; ++x) {
      expect_color(image, over(0.25, near, over(0.4, far, kBackground)), x);
    }
  }
}

TEST(Opacity, BackFacesAreLeftOutOfTheLayers) {
  Model model = sheets({{sheet_of(AlphaMode::kBlend, 0.5, {1, 0, 0}), 2}});
  std::swap(model.meshes[0].indices[1], model.meshes[0].indices[2]);
  std::swap(model.meshes[0].indices[4], model.meshes[0].indices[5]);
  expect_color(shown(model), kBackground);
  model.materials[0].double_sided = true;
  expect_color(shown(model), over(0.5, {1, 0, 0}, kBackground));
}

/// A fence of two slats, each a quarter of the fence's width, over a floor, and the sun above.
Model fence() {
  Material slats = white(Shading::kLambert);
  slats.alpha_mode = AlphaMode::kMask;
  slats.base_texture = 0;
  slats.double_sided = true;
  Model model = model_of({quad({-2, 1, 2}, {2, 1, 2}, {2, 1, -2}, {-2, 1, -2}),
                          quad({-8, 0, 8}, {8, 0, 8}, {8, 0, -8}, {-8, 0, -8})},
                         slats);
  model.materials.push_back(white(Shading::kLambert));
  model.meshes[1].material = 1;
  model.textures = {{4, 1, {1, 1, 1, 1, 1, 1, 1, 0, 1, 1, 1, 1, 1, 1, 1, 0}}};
  return model;
}

TEST(Opacity, AMaskedFenceThrowsTheShadowOfItsSlats) {
  const Sun sun{{0, 1, 0}, {1, 1, 1}};
  const Model model = fence();
  const ShadowMap map = make_shadow_map(model, sun, std::nullopt, 512, *make_executor(1));
  const glm::dvec3 up(0, 1, 0);
  // Texels are one unit wide: from -2 to -1 the fence has a slat, from -1 to 0 a gap, and so on.
  for (const auto& [x, lit] : {std::pair{-1.5, 0.0}, {-0.5, 1.0}, {0.5, 0.0}, {1.5, 1.0}}) {
    EXPECT_EQ(shadow_at(map, {x, 0, 0.3}, up), lit) << x;
  }
}

TEST(Opacity, BlendedSurfacesThrowTheirShadowByTheRuleOfDepth) {
  const Sun sun{{0, 1, 0}, {1, 1, 1}};
  Model model = fence();
  model.materials[0].base_texture = -1;
  model.materials[0].alpha_mode = AlphaMode::kBlend;
  for (const auto& [alpha, lit] : {std::pair{0.49, 1.0}, {0.5, 0.0}}) {
    model.materials[0].alpha = alpha;
    const ShadowMap map = make_shadow_map(model, sun, std::nullopt, 256, *make_executor(1));
    EXPECT_EQ(shadow_at(map, {0.5, 0, 0.3}, {0, 1, 0}), lit) << alpha;
  }
}

TEST(Opacity, LayersAreLitWhereTheyAre) {
  // A lambert sheet in full sun over the background.
  Material m = sheet_of(AlphaMode::kBlend, 0.5, {1, 1, 1});
  m.shading = Shading::kLambert;
  m.ambient = {0, 0, 0};
  const Model model = sheets({{m, 1}});
  const RasterLighting light{Sun{{0, 0, 1}, {3, 2, 1}}, nullptr};
  expect_color(drawn(model, flat_view(32, 32), light), over(0.5, {3, 2, 1}, kBackground));
}

}  // namespace
}  // namespace limpid
