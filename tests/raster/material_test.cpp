#include <gtest/gtest.h>

#include "limpid/core/error.h"

#include "raster_scenes.h"

namespace limpid {
namespace {

using namespace test;

Rgb<double> color(const RasterImage& image, int x, int y) {
  return {at(image.color[0], x, y), at(image.color[1], x, y), at(image.color[2], x, y)};
}

void expect_color(const Rgb<double>& got, const Rgb<double>& expected, double tolerance = 2e-6) {
  EXPECT_NEAR(got.r, expected.r, tolerance);
  EXPECT_NEAR(got.g, expected.g, tolerance);
  EXPECT_NEAR(got.b, expected.b, tolerance);
}

/// A quad of `width` x `height` pixels from (8, 8) on; uv 0 0 at its lower left corner, as in
/// quad().
Model rectangle(int width, int height, const Material& material) {
  const int x = 8 + width, y = 8 + height;
  return model_of(
      {quad(pixel_point(8, y), pixel_point(x, y), pixel_point(x, 8), pixel_point(8, 8))}, material);
}

// --- vertex colors ---

TEST(Materials, VertexColorsAreMixedAcrossATriangle) {
  Material m = white();
  m.base_color = {1, 2, 0.5};
  Model model = rectangle(16, 16, m);
  model.meshes[0].colors = {{0, 0, 1, 1}, {1, 0, 1, 1}, {1, 1, 1, 1}, {0, 1, 1, 1}};
  const RasterImage image = drawn(model, flat_view(32, 32));
  for (const int x : {8, 11, 23}) {
    for (const int y : {8, 15, 23}) {
      const double s = (x + 0.5 - 8) / 16, t = (24 - y - 0.5) / 16;
      expect_color(color(image, x, y), {s, 2 * t, 0.5});
    }
  }
}

TEST(Materials, VertexColorsAreMixedInPerspective) {
  // A floor from z = -1 to -9 whose red is the distance: on the screen red is not linear.
  Model model = model_of({quad({-3, 0, -1}, {3, 0, -1}, {3, 0, -9}, {-3, 0, -9})});
  model.meshes[0].colors = {{0, 0, 0, 1}, {0, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, 1}};
  const RasterView view = perspective_view(64, 64, {0, 2, 2}, {0, 0, -4});
  const RasterImage image = drawn(model, view);
  const Rays rays = rays_of(view.camera, {64, 64});
  for (const int y : {24, 32, 44}) {
    const glm::dvec3 ray = rays.ray_at(32.5, y + 0.5);
    const double z = 2 + ray.z * (-2 / ray.y);
    ASSERT_EQ(at(image.coverage, 32, y), 1);
    EXPECT_NEAR(at(image.color[0], 32, y), (-1 - z) / 8, 2e-4);  // corners are snapped
  }
}

TEST(Materials, ACutLeavesColorsAndSecondUvsAlone) {
  Material m = white(Shading::kTextured);
  m.base_texture = 0;
  m.base_lookup = {1, Wrap::kRepeat, Wrap::kRepeat};
  Model model = model_of({quad({-3, 0, 3}, {3, 0, 3}, {3, 0, -9}, {-3, 0, -9})}, m);
  model.meshes[0].colors = {{0, 0, 0, 1}, {0, 1, 0, 1}, {1, 0, 0, 1}, {1, 1, 1, 1}};
  model.meshes[0].second_uvs = {{0, 0}, {2, 0}, {2, 4}, {0, 4}};
  model.meshes[0].uvs.clear();
  model.textures = {checker(8)};
  RasterView view = perspective_view(64, 64, {0, 2, 2}, {0, 0, -4});
  const RasterImage whole = drawn(model, view);
  view.clip_plane = glm::dvec4(0.3, 0, -1, -2);
  const RasterImage cut = drawn(model, view);
  int compared = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      if (at(cut.coverage, x, y) == 0) continue;
      ++compared;
      expect_color(color(cut, x, y), color(whole, x, y), 1e-3);
    }
  }
  EXPECT_GT(compared, 300);
}

TEST(Materials, FacesWithoutNormalsKeepTheirColors) {
  Model model = rectangle(16, 16, white());
  ASSERT_TRUE(model.meshes[0].normals.empty());
  model.meshes[0].colors = {{1, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}, {0, 1, 0, 1}};
  const RasterImage smooth = drawn(model, flat_view(32, 32));
  model.meshes[0].normals.assign(4, {0, 0, 1});
  const RasterImage given = drawn(model, flat_view(32, 32));
  expect_color(color(smooth, 12, 12), color(given, 12, 12));
  EXPECT_NEAR(at(smooth.color[1], 12, 12), (24 - 12.5) / 16, 1e-6);
}

TEST(Materials, OneMeshWithColorsLeavesTheOthersAlone) {
  Model model = rectangle(8, 16, white());
  model.meshes.push_back(model.meshes[0]);
  model.meshes[0].colors.assign(4, glm::vec4(0.5f, 0.25f, 1, 1));
  model.instances.push_back({1, glm::translate(glm::dmat4(1), glm::dvec3(8, 0, 0)), false});
  const RasterImage image = drawn(model, flat_view(32, 32));
  expect_color(color(image, 15, 16), {0.5, 0.25, 1});
  expect_color(color(image, 16, 16), {1, 1, 1});
}

// --- emission ---

TEST(Materials, EmissionIsSeenInTheDark) {
  Material m = white(Shading::kLambert);
  m.base_color = {0.5, 0.5, 0.5};
  m.ambient = {0.25, 0.25, 0.25};
  m.emission = {4, 2, 0};
  m.emissive_texture = 0;
  Model model = rectangle(16, 16, m);
  model.textures = {{1, 1, {0.5f, 1, 1, 1}}};
  const RasterLighting behind{Sun{{0, 0, -1}, {1, 1, 1}}, nullptr};
  expect_color(color(drawn(model, flat_view(32, 32), behind), 16, 16), {2.125, 2.125, 0.125});
  for (const Shading shading : {Shading::kPhong, Shading::kToon}) {
    model.materials[0].shading = shading;
    expect_color(color(drawn(model, flat_view(32, 32), behind), 16, 16), {2.125, 2.125, 0.125});
  }
}

TEST(Materials, BlackEmissionNeedsNoTexture) {
  Material m = white();
  m.emissive_texture = 0;
  Model model = rectangle(16, 16, m);
  model.textures = {{1, 1, {0.5f, 1, 1, 1}}};
  expect_color(color(drawn(model, flat_view(32, 32)), 16, 16), {1, 1, 1});
}

// --- textures ---

/// The texel that each of 12 pixels in a row shows, of four texels 1, 2, 3, 4: one each, from uv -1
/// to 2.
std::vector<int> texels_shown(Wrap wrap, bool down) {
  Material m = white(Shading::kTextured);
  m.base_texture = 0;
  m.base_lookup =
      down ? TextureLookup{0, Wrap::kRepeat, wrap} : TextureLookup{0, wrap, Wrap::kRepeat};
  Model model = down ? rectangle(4, 12, m) : rectangle(12, 4, m);
  const float far = 2, near = -1;
  model.meshes[0].uvs = down ? std::vector<glm::vec2>{{0, far}, {1, far}, {1, near}, {0, near}}
                             : std::vector<glm::vec2>{{near, 0}, {far, 0}, {far, 1}, {near, 1}};
  model.textures = {{down ? 1 : 4, down ? 4 : 1, {}}};
  for (float value : {1.0f, 2.0f, 3.0f, 4.0f}) {
    model.textures[0].rgba.insert(model.textures[0].rgba.end(), {value, value, value, 1});
  }
  const RasterImage image = drawn(model, flat_view(32, 32));
  std::vector<int> shown;
  for (int i = 8; i < 20; ++i) {
    const float value = down ? at(image.color[0], 10, i) : at(image.color[0], i, 10);
    EXPECT_NEAR(value, std::round(value), 1e-4);
    shown.push_back(static_cast<int>(std::lround(value)));
  }
  return shown;
}

TEST(Materials, TexturesRepeatClampOrMirror) {
  const std::vector<int> repeated{1, 2, 3, 4, 1, 2, 3, 4, 1, 2, 3, 4};
  const std::vector<int> clamped{1, 1, 1, 1, 1, 2, 3, 4, 4, 4, 4, 4};
  const std::vector<int> mirrored{4, 3, 2, 1, 1, 2, 3, 4, 4, 3, 2, 1};
  for (const bool down : {false, true}) {
    EXPECT_EQ(texels_shown(Wrap::kRepeat, down), repeated);
    EXPECT_EQ(texels_shown(Wrap::kClamp, down), clamped);
    EXPECT_EQ(texels_shown(Wrap::kMirror, down), mirrored);
  }
}

TEST(Materials, ClampedTexturesDoNotMixTheirEnds) {
  // Between the last texel's centre and the edge, a lookup has the last texel alone, but half of
  // the first texel if the texture repeats.
  Material m = white(Shading::kTextured);
  m.base_texture = 0;
  Model model = rectangle(16, 16, m);
  model.meshes[0].uvs.assign(4, {1, 0.5f});
  model.textures = {{2, 1, {0, 0, 0, 1, 1, 1, 1, 1}}};
  for (const auto& [wrap, value] :
       {std::pair{Wrap::kRepeat, 0.5}, {Wrap::kClamp, 1.0}, {Wrap::kMirror, 1.0}}) {
    model.materials[0].base_lookup.wrap_u = wrap;
    EXPECT_NEAR(at(drawn(model, flat_view(32, 32)).color[0], 16, 16), value, 1e-6);
  }
}

TEST(Materials, ExtremeUvsGiveNoNaNHoweverTheyWrap) {
  for (const Wrap wrap : {Wrap::kClamp, Wrap::kMirror}) {
    Model model = mixed_model();
    for (Material& m : model.materials) m.base_lookup = m.specular_lookup = {0, wrap, wrap};
    for (Mesh& mesh : model.meshes) {
      for (glm::vec2& uv : mesh.uvs) uv *= 3e37f;
    }
    for (float value : values(drawn(model, mixed_view(40, 30), low_sun()))) {
      ASSERT_FALSE(std::isnan(value));
    }
  }
}

TEST(Materials, EachTextureHasItsOwnUvs) {
  Material m = white(Shading::kTextured);
  m.base_texture = 0;
  m.base_lookup = {1, Wrap::kClamp, Wrap::kClamp};
  m.emission = {1, 1, 1};
  m.emissive_texture = 1;
  Model model = rectangle(16, 16, m);
  model.meshes[0].uvs.assign(4, {0.25f, 0.5f});
  model.meshes[0].second_uvs.assign(4, {0.75f, 0.5f});
  model.textures = {{2, 1, {1, 0, 0, 1, 0, 1, 0, 1}}, {2, 1, {0, 0, 2, 1, 0, 0, 7, 1}}};
  expect_color(color(drawn(model, flat_view(32, 32)), 16, 16), {0, 1, 2});
}

// --- errors ---

TEST(Materials, BadModelsAreRefused) {
  const auto error_of = [](const Model& model) {
    try {
      Rasteriser{model};
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  Model model = rectangle(16, 16, white());
  model.meshes[0].name = "box";
  model.meshes[0].colors.resize(3);
  EXPECT_EQ(error_of(model),
            "mesh 'box' has 4 positions, 0 second uvs and 3 colors, expected one a vertex or none");
  model.meshes[0].colors.clear();
  model.materials[0].name = "lamp";
  model.materials[0].emissive_texture = 0;
  EXPECT_EQ(error_of(model), "material 'lamp': emissive_texture = 0: expected less than 0");
  model.materials[0].emissive_texture = -1;
  model.materials[0].base_lookup.uv_set = 2;
  EXPECT_EQ(error_of(model), "material 'lamp': uv set 2: expected 0 or 1");
}

}  // namespace
}  // namespace limpid
