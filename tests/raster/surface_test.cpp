#include <gtest/gtest.h>

#include "optics/shading.h"
#include "raster_scenes.h"

namespace limpid {
namespace {

using namespace test;

/// A square of 20 x 20 pixels around the middle of 32 x 32, its normal tilted by `normal`.
Model square(Material material, glm::vec3 normal = {0, 0, 1}) {
  Mesh mesh = quad(pixel_point(6, 26), pixel_point(26, 26), pixel_point(26, 6), pixel_point(6, 6));
  mesh.normals.assign(4, normal);
  return model_of({mesh}, std::move(material));
}

Rgb<double> color(const RasterImage& image, int x = 16, int y = 16) {
  return {at(image.color[0], x, y), at(image.color[1], x, y), at(image.color[2], x, y)};
}

void expect_color(const Rgb<double>& got, const Rgb<double>& expected, double tolerance = 2e-6) {
  EXPECT_NEAR(got.r, expected.r, tolerance);
  EXPECT_NEAR(got.g, expected.g, tolerance);
  EXPECT_NEAR(got.b, expected.b, tolerance);
}

/// The view looks down -z, so V = (0, 0, 1) everywhere. n.L = 0.6; R = 2 (n.L) n - L.
const RasterLighting kSlanted{Sun{{0.8, 0, 0.6}, {2, 1, 0.5}}, nullptr};

TEST(Surface, FlatIsTheBaseColor) {
  Material m = white(Shading::kFlat);
  m.base_color = {0.25, 0.5, 3};
  expect_color(color(drawn(square(m), flat_view(32, 32), kSlanted)), {0.25, 0.5, 3});
}

TEST(Surface, TexturedIsTheTextureTimesTheBaseColor) {
  Material m = white(Shading::kTextured);
  m.base_color = {1, 0.5, 2};
  m.base_texture = 0;
  Model model = square(m);
  model.textures = {{1, 1, {0.5f, 0.25f, 0.125f, 1}}};
  expect_color(color(drawn(model, flat_view(32, 32), kSlanted)), {0.5, 0.125, 0.25});
}

TEST(Surface, LambertByHand) {
  Material m = white(Shading::kLambert);
  m.base_color = {0.5, 1, 1};
  m.ambient = {0.1, 0.2, 0.3};
  // c (ambient + 0.6 S) = 0.5 (0.1 + 1.2), 0.2 + 0.6, 0.3 + 0.3
  expect_color(color(drawn(square(m), flat_view(32, 32), kSlanted)), {0.65, 0.8, 0.6});
}

TEST(Surface, PhongByHand) {
  Material m = white(Shading::kPhong);
  m.ambient = {0, 0, 0};
  m.specular = {1, 0.5, 0};
  m.power = 2;
  // R.V = 2 (0.6) - 0.6 = 0.6; squared 0.36; diffuse 0.6 S.
  expect_color(color(drawn(square(m), flat_view(32, 32), kSlanted)),
               {2 * 0.6 + 0.36 * 2, 0.6 + 0.5 * 0.36, 0.5 * 0.6});
}

TEST(Surface, PhongHasNoGlintWhereTheLightIsBehind) {
  Material m = white(Shading::kPhong);
  m.ambient = {0.25, 0.25, 0.25};
  const RasterLighting behind{Sun{{0.6, 0, -0.8}, {1, 1, 1}}, nullptr};
  const RasterImage image = drawn(square(m), flat_view(32, 32), behind);
  expect_color(color(image), {0.25, 0.25, 0.25});
  EXPECT_EQ(at(image.shadow, 16, 16), 0);
}

TEST(Surface, PhongTakesItsSpecularMap) {
  Material m = white(Shading::kPhong);
  m.base_color = {0, 0, 0};
  m.specular_texture = 0;
  m.power = 1;
  Model model = square(m);
  model.textures = {{1, 1, {0.5f, 1, 0, 1}}};
  expect_color(color(drawn(model, flat_view(32, 32), kSlanted)), {0.5 * 0.6 * 2, 0.6, 0});
}

TEST(Surface, ToonHasFiveSteps) {
  Material m = white(Shading::kToon);
  m.ambient = {0.1, 0.1, 0.1};
  for (const auto& [cosine, step] :
       {std::pair{0.05, 0.2}, {0.19, 0.2}, {0.21, 0.4}, {0.59, 0.6}, {0.61, 0.8}, {0.99, 1.0}}) {
    const RasterLighting light{Sun{{std::sqrt(1 - cosine * cosine), 0, cosine}, {1, 1, 1}},
                               nullptr};
    const double expected = 0.1 + step;
    expect_color(color(drawn(square(m), flat_view(32, 32), light)), {expected, expected, expected});
  }
  const RasterLighting behind{Sun{{0, 0, -1}, {1, 1, 1}}, nullptr};
  expect_color(color(drawn(square(m), flat_view(32, 32), behind)), {0.1, 0.1, 0.1});
}

TEST(Surface, ShadingFormulasInDouble) {
  EXPECT_DOUBLE_EQ(toon_steps(0.0), 0);
  EXPECT_DOUBLE_EQ(toon_steps(0.2), 0.2);
  EXPECT_DOUBLE_EQ(toon_steps(0.2001), 0.4);
  EXPECT_DOUBLE_EQ(toon_steps(1.0), 1);
  const Rgb<double> one{1, 1, 1}, none{0, 0, 0};
  EXPECT_EQ(lambert_shading(one, none, -0.5, 1.0, one), none);
  EXPECT_EQ(lambert_shading(one, none, 0.5, 0.5, one), (Rgb<double>{0.25, 0.25, 0.25}));
  const Vec3<double> up{0, 0, 1};
  EXPECT_EQ(phong_glint(one, 20.0, up, up, up, 0.5, one), (Rgb<double>{0.5, 0.5, 0.5}));
  EXPECT_EQ(phong_glint(one, 20.0, up, up, Vec3<double>{0, 0, -1}, 1.0, one), none);
}

TEST(Surface, NormalsGoByTheInverseTranspose) {
  Model model = square(white(), glm::vec3(glm::normalize(glm::dvec3(1, 0, 1))));
  model.instances[0].world_from_mesh = glm::scale(glm::dmat4(1), glm::dvec3(1, 1, 0.25));
  const RasterImage image = drawn(model, flat_view(32, 32));
  const glm::dvec3 expected = glm::normalize(glm::dvec3(1, 0, 4));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(at(image.normal[c], 16, 16), expected[c], 1e-6);
  EXPECT_EQ(at(image.normal[2], 2, 2), 0);
}

TEST(Surface, WithoutNormalsFacesAreFlat) {
  Model model = model_of({hills(4, 10, 1)});
  model.meshes[0].normals.clear();
  const RasterView view = perspective_view(40, 30, {0, 8, 2}, {0, 0, 0});
  const RasterImage image = drawn(model, view);
  const Mesh& m = model.meshes[0];
  int matched = 0;
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) {
      if (at(image.coverage, x, y) == 0) continue;
      double best = -1;
      for (std::size_t i = 0; i < m.indices.size(); i += 3) {
        const glm::dvec3 a(m.positions[m.indices[i]]), b(m.positions[m.indices[i + 1]]),
            c(m.positions[m.indices[i + 2]]);
        const glm::dvec3 n = glm::normalize(glm::cross(b - a, c - a));
        best = std::max(best, n.x * at(image.normal[0], x, y) + n.y * at(image.normal[1], x, y) +
                                  n.z * at(image.normal[2], x, y));
      }
      EXPECT_GT(best, 1 - 1e-6);
      ++matched;
    }
  }
  EXPECT_GT(matched, 200);
}

TEST(Winding, BackFacesAreCulledUnlessDoubleSided) {
  const auto covered = [](const Model& model, bool flip = false, bool cull = true) {
    RasterView view = flat_view(32, 32);
    view.flip_winding = flip;
    view.cull = cull;
    return at(drawn(model, view).coverage, 16, 16) == 1;
  };
  Model front = square(white()), back = square(white());
  std::swap(back.meshes[0].indices[1], back.meshes[0].indices[2]);
  std::swap(back.meshes[0].indices[4], back.meshes[0].indices[5]);
  EXPECT_TRUE(covered(front));
  EXPECT_FALSE(covered(back));
  EXPECT_FALSE(covered(front, true));
  EXPECT_TRUE(covered(back, true));
  EXPECT_TRUE(covered(back, false, false));
  back.materials[0].double_sided = true;
  EXPECT_TRUE(covered(back));
  // A mirrored instance turns its triangles around; its outer sides stay outer sides.
  front.instances[0].world_from_mesh = glm::translate(glm::dmat4(1), glm::dvec3(32, 0, 0)) *
                                       glm::scale(glm::dmat4(1), glm::dvec3(-1, 1, 1));
  EXPECT_TRUE(covered(front));
}

TEST(Winding, TheBackOfADoubleSidedFaceHasItsNormalTowardsTheViewer) {
  Material m = white();
  m.double_sided = true;
  Model model = square(m, {0, 0, -1});
  std::swap(model.meshes[0].indices[1], model.meshes[0].indices[2]);
  std::swap(model.meshes[0].indices[4], model.meshes[0].indices[5]);
  EXPECT_EQ(at(drawn(model, flat_view(32, 32)).normal[2], 16, 16), 1);
}

TEST(Texture, UvIsPerspectiveCorrect) {
  // A ramp in u on ground that runs into the distance: the color is u.
  Material m = white(Shading::kTextured);
  m.base_texture = 0;
  Mesh ground = quad({-2, 0, 0}, {2, 0, 0}, {2, 0, -6}, {-2, 0, -6});
  ground.uvs = {{0.2f, 0.5f}, {0.2f, 0.5f}, {0.8f, 0.5f}, {0.8f, 0.5f}};
  Model model = model_of({ground}, m);
  ModelTexture ramp{16, 1, {}};
  for (int x = 0; x < 16; ++x) {
    const float u = (static_cast<float>(x) + 0.5f) / 16;
    ramp.rgba.insert(ramp.rgba.end(), {u, u, u, 1});
  }
  model.textures = {ramp};
  const RasterView view = perspective_view(200, 160, {0, 1.5, 1}, {0, 0, -2});
  const RasterImage image = drawn(model, view);
  const Rays rays = rays_of(view.camera, {200, 160});
  int covered = 0;
  for (int y = 0; y < 160; ++y) {
    for (int x = 0; x < 200; ++x) {
      if (at(image.coverage, x, y) == 0) continue;
      const glm::dvec3 ray = rays.ray_at(x + 0.5, y + 0.5);
      const double z = 1 - 1.5 / ray.y * ray.z;
      EXPECT_NEAR(at(image.color[0], x, y), 0.2 - 0.1 * z, 5e-4) << x << ' ' << y;
      ++covered;
    }
  }
  EXPECT_GT(covered, 5000);
}

/// The middle row of a square whose texture, a checker of 64 x 64, has `texels` to a pixel.
std::vector<float> row_of_checker(double texels) {
  Material m = white(Shading::kTextured);
  m.base_texture = 0;
  Model model = square(m);
  const float span = static_cast<float>(20 * texels / 64);
  model.meshes[0].uvs = {{0, span}, {span, span}, {span, 0}, {0, 0}};
  model.textures = {checker(64)};
  const RasterImage image = drawn(model, flat_view(32, 32));
  std::vector<float> row;
  for (int x = 8; x < 24; ++x) row.push_back(at(image.color[0], x, 16));
  return row;
}

TEST(Texture, MipLevelFollowsTheFootprint) {
  const std::vector<float> sharp = row_of_checker(1);
  for (std::size_t i = 0; i < sharp.size(); ++i) {
    EXPECT_NEAR(sharp[i], i % 2 ? sharp[1] : 1 - sharp[1], 1e-4);
    EXPECT_NEAR(std::abs(sharp[i] - 0.5), 0.5, 1e-4);
  }
  // 1.4 texels a pixel still read the first level, 1.43 the second level, which is all grey.
  float spread = 0;
  for (float value : row_of_checker(1.4)) spread = std::max(spread, std::abs(value - 0.5f));
  EXPECT_GT(spread, 0.2f);
  for (double texels : {1.43, 2.0, 5.0, 64.0, 500.0}) {
    for (float value : row_of_checker(texels)) EXPECT_NEAR(value, 0.5, 1e-6) << texels;
  }
}

TEST(Texture, TheLastMipLevelIsTheMeanAlsoForOddSizes) {
  for (const auto& [width, height] : {std::pair{5, 3}, {1, 7}, {13, 1}, {6, 9}}) {
    Material m = white(Shading::kTextured);
    m.base_texture = 0;
    Model model = square(m);
    ModelTexture texture{width, height, {}};
    Random random(7);
    double sum = 0;
    for (int i = 0; i < width * height; ++i) {
      const float value = static_cast<float>(random.next());
      sum += value;
      texture.rgba.insert(texture.rgba.end(), {value, value, value, 1});
    }
    model.textures = {texture};
    for (glm::vec2& uv : model.meshes[0].uvs) uv *= 1000.0f;
    EXPECT_NEAR(color(drawn(model, flat_view(32, 32))).r, sum / (width * height), 1e-6);
  }
}

}  // namespace
}  // namespace limpid
