#include "articles/article.h"
#include "optics/shading.h"
#include "raster/raster_scenes.h"

/// The shader primer, chapters 4 (light), 5 (diffuse and specular maps) and 6 (toon): the materials
/// of the raster pass. V = n = (0, 0, 1) in all pictures.

namespace limpid {
namespace {

using test::expect_rgb;

constexpr glm::dvec3 kSteep{0.28, 0, 0.96};  // n.L = R.V = .96, .96^20 = .4420024

Model square(Material material) {
  using test::pixel_point;
  return test::model_of(
      {test::quad(pixel_point(1, 7), pixel_point(7, 7), pixel_point(7, 1), pixel_point(1, 1))},
      std::move(material));
}

Rgb<double> drawn(const Model& model, glm::dvec3 to_sun, Rgb<double> sun = {1, 1, 1}) {
  const RasterImage image =
      test::drawn(model, test::flat_view(8, 8), RasterLighting{Sun{to_sun, sun}, nullptr});
  return {test::at(image.color[0], 4, 4), test::at(image.color[1], 4, 4),
          test::at(image.color[2], 4, 4)};
}

Material material_of(Shading shading, double ambient) {
  Material material = test::white(shading);
  material.ambient = {ambient, ambient, ambient};
  return material;
}

/// A square whose texture 0 is the diffuse map and 1 the specular map, each of one color.
Model mapped(Material material, std::vector<float> diffuse, std::vector<float> specular) {
  material.base_texture = 0;
  material.specular_texture = 1;
  Model model = square(material);
  model.textures = {{1, 1, std::move(diffuse)}, {1, 1, std::move(specular)}};
  return model;
}

// Chapter 4: saturate(dot(-lightDir, normal)), first without ambient.
TEST(ShaderPrimer, LambertIsTheCosine) {
  const Model model = square(material_of(Shading::kLambert, 0));
  expect_rgb(drawn(model, {0.8, 0, 0.6}), {0.6, 0.6, 0.6});
  expect_rgb(drawn(model, {0, 0, 1}), {1, 1, 1});
  expect_rgb(drawn(model, {0.8, 0, -0.6}), {0, 0, 0}, 0);
}

// Chapter 4: ambient .1 + diffuse .96 + specular .96^20, the latter only where diffuse.x > 0.
TEST(ShaderPrimer, PhongAddsTheGlint) {
  const Model model = square(material_of(Shading::kPhong, 0.1));
  const double sum = 0.1 + 0.96 + 0.4420024;
  expect_rgb(drawn(model, kSteep), {sum, sum, sum}, 5e-6);
  expect_rgb(drawn(model, {0.28, 0, -0.96}), {0.1, 0.1, 0.1}, 1e-7);
}

// Chapter 5, with albedo (.5, .25, 1), specular map (.5, 1, 0) and light color (2, 1, .5):
//   diffuse  = light albedo .96       = (.96, .24, .48)
//   specular = .4420024 map light     = (.4420024, .4420024, 0)
//   ambient  = .1 albedo              = (.05, .025, .1)
TEST(ShaderPrimer, DiffuseAndSpecularMaps) {
  const Model model =
      mapped(material_of(Shading::kPhong, 0.1), {0.5f, 0.25f, 1, 1}, {0.5f, 1, 0, 1});
  expect_rgb(drawn(model, kSteep, {2, 1, 0.5}), {1.4520024, 0.7070024, 0.58}, 1e-5);
}

// Departs: the gate is n.L. The chapter's gate is diffuse.x, the red of the lit albedo, so that a
// surface without red, or in light without red, does not glint at all.
TEST(ShaderPrimer, WhatIsNotRedGlintsToo) {
  const Model model = mapped(material_of(Shading::kPhong, 0), {0, 1, 1, 1}, {1, 1, 1, 1});
  expect_rgb(drawn(model, kSteep), {0.4420024, 1.4020024, 1.4020024}, 5e-6);
  expect_rgb(drawn(model, kSteep, {0, 1, 1}), {0, 1.4020024, 1.4020024}, 5e-6);
}

// Chapter 6: ceil(5 d) / 5 of d = saturate(n.L), times the surface's color (0, 1, 0), without
// ambient. Table 6.1: 0; above 0 to .2: .2; above .2 to .4: .4; ... above .8: 1.
TEST(ShaderPrimer, ToonHasFiveSteps) {
  Material material = material_of(Shading::kToon, 0);
  material.base_color = {0, 1, 0};
  const Model model = square(material);
  expect_rgb(drawn(model, {0.8, 0, -0.6}), {0, 0, 0}, 0);
  const double cosines[] = {0.01, 0.19, 0.21, 0.41, 0.59, 0.61, 0.79, 0.81, 1};
  const double steps[] = {0.2, 0.2, 0.4, 0.6, 0.6, 0.8, 0.8, 1, 1};
  for (int i = 0; i < 9; ++i) {
    const double d = cosines[i];
    expect_rgb(drawn(model, {std::sqrt(1 - d * d), 0, d}), {0, steps[i], 0}, 1e-6);
  }
}

// The steps are closed above: d = .6 is still the third.
TEST(ShaderPrimer, ToonStepsAreClosedAbove) {
  EXPECT_NEAR(toon_steps(0.6), 0.6, 1e-12);
  EXPECT_NEAR(toon_steps(0.6001), 0.8, 1e-12);
  EXPECT_EQ(toon_steps(0.0), 0);
}

}  // namespace
}  // namespace limpid
