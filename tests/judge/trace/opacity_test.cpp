#include <gtest/gtest.h>

#include "limpid/raster/render_plate.h"

#include "judge/trace/trace_scenes.h"

/// Masked and blended surfaces, vertex colors, emission: rays give the picture of the raster pass.

namespace limpid::test {
namespace {

/// The share of the dry pixels that equal those of the raster pass. A floor hides the water.
double agreement(Model model) {
  model.meshes.push_back(level(-20, 300));
  model.meshes.back().material = static_cast<int>(model.materials.size());
  model.instances.push_back({static_cast<int>(model.meshes.size()) - 1, glm::dmat4(1), false});
  model.materials.push_back(lambert({0.4, 0.8, 0.6}));
  constexpr Size kSize{96, 72};
  Scene scene;
  scene.camera = mixed_view(kSize.width, kSize.height).camera;
  scene.water = WaterPlane{{0, 1, 0}, -60};
  auto executor = make_executor(1);
  const RenderedPlate plate = render_plate(model, scene, {.size = kSize},
                                           kColorPlanes | PlaneSet{PlaneId::kDepth}, *executor);
  TruthOptions options;
  options.size = kSize;
  const TruthPicture p = traced(model, scene, calm_look(), options);
  int near = 0, all = 0;
  for_each_pixel(kSize, [&](int x, int y) {
    if (std::isinf(plate.frame.plane(PlaneId::kDepth).at(x, y))) return;
    double off = 0;
    for (int c = 0; c < 3; ++c) {
      const double dry = plate.frame.plane(plane_after(PlaneId::kColorR, c)).at(x, y);
      off = std::max(off, std::abs(p.target.color[static_cast<std::size_t>(c)].at(x, y) - dry));
    }
    near += off < 2e-3;
    ++all;
  });
  EXPECT_GT(all, 3000);
  return static_cast<double>(near) / all;
}

/// Hills of all materials, with or without holes in their checks.
Model see_through(AlphaMode mode) {
  Model model = mixed_model();
  for (std::size_t i = 3; i < model.textures[0].rgba.size(); i += 4) {
    model.textures[0].rgba[i] = i % 8 == 3 ? 0.3f : 0.9f;
  }
  for (std::size_t i = 0; i + 1 < model.materials.size(); ++i) {
    model.materials[i].alpha_mode = mode;
    model.materials[i].alpha = 0.8;
    model.materials[i].double_sided = true;
  }
  return model;
}

TEST(TracedOpacity, MaskedPixelsAreTheRasterisers) {
  EXPECT_GT(agreement(see_through(AlphaMode::kMask)), 0.97);
}

TEST(TracedOpacity, BlendedPixelsAreTheRasterisers) {
  EXPECT_GT(agreement(see_through(AlphaMode::kBlend)), 0.97);
}

TEST(TracedOpacity, ColorsEmissionAndWrappingAreTheRasterisers) {
  Model model = mixed_model();
  for (std::size_t i = 0; i < model.materials.size(); ++i) {
    Material& m = model.materials[i];
    m.emission = {0.1 * static_cast<double>(i), 0.3, 0};
    m.emissive_texture = 0;
    m.emissive_lookup = {1, Wrap::kMirror, Wrap::kClamp};
    m.base_lookup = {0, i % 2 ? Wrap::kMirror : Wrap::kClamp, Wrap::kRepeat};
    Mesh& mesh = model.meshes[i];
    mesh.second_uvs = mesh.uvs;
    for (glm::vec2& uv : mesh.second_uvs) uv = uv * -0.5f + 1.5f;
    for (const glm::vec3& p : mesh.positions) {
      mesh.colors.emplace_back(0.5f + 0.1f * p.x, 1, 0.5f - 0.1f * p.z, 1);
    }
  }
  EXPECT_GT(agreement(model), 0.97);
}

/// A pane of flat color across the view, `height` over the water, and a floor. The pane is visible
/// from above only, so that no mirrored view meets it again.
Model pane_over(double height, AlphaMode mode, double alpha) {
  Material pane = white(Shading::kFlat);
  pane.base_color = {0.9, 0.2, 0.4};
  pane.alpha_mode = mode;
  pane.alpha = alpha;
  Model model = model_of({level(height), level(-2)}, lambert({0.5, 0.6, 0.7}));
  model.materials.push_back(pane);
  model.meshes[0].material = 1;
  return model;
}

/// Without a sun the pane casts no shadow.
TruthPicture ambient(const Model& model, double degrees = 40) {
  Scene scene = over_water(degrees);
  scene.sun.reset();
  Look look = calm_look();
  DepthFog::Params& fog = look.of<DepthFog>();
  fog.water_type = WaterType::kCustom;
  fog.absorption = {0.3, 0.2, 0.1};
  fog.scattering = {0.1, 0.2, 0.1};
  fog.ambient = {0.3, 0.5, 0.4};
  return traced(model, scene, look);
}

/// Light is additive: the picture with a pane of opacity a is a times the picture with an opaque
/// pane plus 1 - a times the picture without a pane, in the air and in the water.
TEST(TracedOpacity, APaneMixesWhatItIsWithWhatLiesBehind) {
  for (const double height : {0.5, -0.7}) {
    const TruthPicture none = ambient(pane_over(height, AlphaMode::kMask, 0));
    const TruthPicture whole = ambient(pane_over(height, AlphaMode::kOpaque, 1));
    for (const double alpha : {0.25, 0.75}) {
      const TruthPicture p = ambient(pane_over(height, AlphaMode::kBlend, alpha));
      for_each_pixel(kTraceSize, [&](int x, int y) {
        for (std::size_t c = 0; c < 3; ++c) {
          const double expected =
              alpha * whole.target.color[c].at(x, y) + (1 - alpha) * none.target.color[c].at(x, y);
          ASSERT_NEAR(p.target.color[c].at(x, y), expected, 2e-5) << height << " " << x << " " << y;
        }
      });
    }
  }
}

TEST(TracedOpacity, WhatIsMaskedAwayIsNowhere) {
  Model with = pane_over(0.5, AlphaMode::kMask, 0.3), without = with;
  without.instances.erase(without.instances.begin());
  const Scene scene = over_water(40);
  const TruthPicture p = traced(with, scene, Look{}), q = traced(without, scene, Look{});
  for_each_pixel(kTraceSize, [&](int x, int y) {
    for (std::size_t c = 0; c < 3; ++c) {
      ASSERT_EQ(p.target.color[c].at(x, y), q.target.color[c].at(x, y)) << x << " " << y;
    }
    ASSERT_EQ(value(p, Aov::kPath, x, y), value(q, Aov::kPath, x, y));
  });
}

TEST(TracedOpacity, ShadowsFallByTheRuleOfDepth) {
  // Without ambient light, surfaces out of the sun are black, except the pane.
  const auto floor_under = [&](AlphaMode mode, double alpha) {
    Model model = pane_over(3, mode, alpha);
    model.materials[0].ambient = {0, 0, 0};
    model.materials[1].base_color = {0, 0, 0};
    Scene scene = over_water(60);  // the view from under the pane
    scene.sun = Sun{{0, 1, 0}, {1, 1, 1}};
    Look look = calm_look();
    look.of<DepthFog>().water_type = WaterType::kCustom;
    look.of<DepthFog>().absorption = look.of<DepthFog>().scattering = {0, 0, 0};
    model.background = {0, 0, 0};
    return traced(model, scene, look).target.color[0].at(16, 12);
  };
  EXPECT_GT(floor_under(AlphaMode::kBlend, 0.49), 0.1);
  EXPECT_EQ(floor_under(AlphaMode::kBlend, 0.5), 0);
  EXPECT_GT(floor_under(AlphaMode::kMask, 0.49), 0.1);
  EXPECT_EQ(floor_under(AlphaMode::kMask, 0.5), 0);
}

}  // namespace
}  // namespace limpid::test
