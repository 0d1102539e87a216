#include "limpid/raster/rasterise.h"

#include "articles/article.h"
#include "optics/shading.h"
#include "raster/raster_scenes.h"

/// The article on specular light by Phong's model: ambient + diffuse + specular, for the raster
/// pass (shading `phong`) and as the model `phong` of sun_highlight.

namespace limpid {
namespace {

using test::expect_rgb;

/// A white square in the article's shader: ambient .1, specular power 20.
Material article_material() {
  Material material = test::white(Shading::kPhong);
  material.ambient = {0.1, 0.1, 0.1};
  material.specular = {1, 1, 1};
  material.power = 20;
  return material;
}

Model square(Material material) {
  using test::pixel_point;
  return test::model_of(
      {test::quad(pixel_point(1, 7), pixel_point(7, 7), pixel_point(7, 1), pixel_point(1, 1))},
      std::move(material));
}

Rgb<double> drawn(const Model& model, const RasterView& view, glm::dvec3 to_sun, int x, int y) {
  const RasterLighting light{Sun{to_sun, {1, 1, 1}}, nullptr};
  const RasterImage image = test::drawn(model, view, light);
  return {test::at(image.color[0], x, y), test::at(image.color[1], x, y),
          test::at(image.color[2], x, y)};
}

// n = V = (0, 0, 1), L = (.28, 0, .96): diffuse n.L = .96; reflect(-L, n) = (-.28, 0, .96), R.V =
// .96, .96^20 = .4420024. Departs: the sum, 1.5020024, is not clamped; the article says that HLSL
// clamps the sum to 1, but an 8-bit picture does so.
TEST(PhongSpecular, AmbientDiffuseSpecular) {
  const double sum = 0.1 + 0.96 + 0.4420024;
  expect_rgb(drawn(square(article_material()), test::flat_view(8, 8), {0.28, 0, 0.96}, 4, 4),
             {sum, sum, sum}, 5e-6);
}

// if (diffuse.x > 0): light from (.8, 0, -.6) is behind the face, so only the ambient is left.
TEST(PhongSpecular, NothingGlintsBehind) {
  expect_rgb(drawn(square(article_material()), test::flat_view(8, 8), {0.8, 0, -0.6}, 4, 4),
             {0.1, 0.1, 0.1}, 1e-7);
}

// Where the gate matters: L = (-.8, 0, -.6) is behind, but R = 2 (n.L) n - L = (.8, 0, -.6) still
// has R.V = .768 - .168 = .6 with the flat view V = (.96, 0, .28).
TEST(PhongSpecular, TheGateIsNotInTheLobe) {
  const Vec3<double> n{0, 0, 1}, v{0.96, 0, 0.28}, l{-0.8, 0, -0.6};
  const Rgb<double> one{1, 1, 1};
  EXPECT_NEAR(phong_lobe(n, v, l, 1.0), 0.6, 1e-12);
  EXPECT_EQ(phong_glint(one, 1.0, n, v, l, 1.0, one), (Rgb<double>{0, 0, 0}));
}

// Departs: the article's view vector is made of Position.zyz, a slip for xyz. From (0, 0, 4) the
// point (3, 0, 0) has V = (-.6, 0, .8). With L = (.6, 0, .8), R = (-.6, 0, .8) = V: specular 1. By
// the slip V would be (0, 0, 1) and the specular .8^20 = .0115.
TEST(PhongSpecular, ViewVectorIsThatOfThePoint) {
  Material material = article_material();
  material.base_color = {0, 0, 0};
  const Model model =
      test::model_of({test::quad({-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0})}, material);
  RasterView view;
  view.display = view.window = {0, 0, 5, 5};
  view.camera.view = glm::lookAt(glm::dvec3(0, 0, 4), glm::dvec3(0, 0, 0), glm::dvec3(0, 1, 0));
  // The centre of the last pixel of five is .8 from the middle: .8 * .9375 * 4 = 3.
  view.camera.projection = perspective(2 * std::atan(0.9375), 1, 0.1, 100, ClipSpace::kGl);
  expect_rgb(drawn(model, view, {0.6, 0, 0.8}, 4, 2), {1, 1, 1}, 2e-5);
}

// Departs: normals go by the inverse transpose. (1, 0, 1) on a square made four times thinner is
// (1, 0, 4) / sqrt(17); the article's mul(normal, World) makes it (1, 0, .25) / 1.0308, and n.L
// with L = (0, 0, 1) .2425 instead of .9701.
TEST(PhongSpecular, NormalsOfScaledMeshesStayNormal) {
  Material material = test::white(Shading::kLambert);
  material.ambient = {0, 0, 0};
  Model model = square(material);
  model.meshes[0].normals.assign(4, glm::vec3(0.70710678f, 0, 0.70710678f));
  model.instances[0].world_from_mesh = glm::scale(glm::dmat4(1), glm::dvec3(1, 1, 0.25));
  const double cosine = 0.9701425;
  expect_rgb(drawn(model, test::flat_view(8, 8), {0, 0, 1}, 4, 4), {cosine, cosine, cosine});
}

// The same lobe on water, V = (0, 1, 0), L = (.28, .96, 0), calm: .96^20 of the sun's color.
TEST(PhongSpecular, OnWater) {
  test::Tray tray({8, 8});
  tray.scene.sun = Sun{{0.28, 0.96, 0}, {2, 1, 0.5}};
  tray.look.of<SunHighlight>().model = SunHighlight::Model::kPhong;
  tray.look.of<SunHighlight>().power = 20;
  tray.look.of<SunHighlight>().strength = 1;
  expect_rgb(rgb_of(tray.wet(), Aov::kHighlight, 3, 3), {0.8840049, 0.4420024, 0.2210012}, 5e-6);
}

}  // namespace
}  // namespace limpid
