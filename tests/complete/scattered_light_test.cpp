#include "complete/scattered_light.h"

#include <cmath>

#include <gtest/gtest.h>

#include "ops/depth_fog_kernel.h"
#include "ops/probe_strip.h"
#include "ops/tray.h"

namespace limpid {
namespace {

// Water that absorbs 99 parts of light for each part that it scatters returns no more than about
// one part, and deep water shows nothing of the bottom.
TEST(ScatteredLight, BoundsAreOfTheLightThatComes) {
  ScatteredLightMaker maker;
  const Rgb<double> absorption{0.99, 0.99, 0.99}, scattering{0.01, 0.01, 0.01};
  const ScatteredLight& dark = maker.make({absorption, scattering, 0, 0.8})[1];
  EXPECT_GT(dark.most_sky, 0);
  EXPECT_LT(dark.most_sky, 0.05);
  EXPECT_LT(dark.most_sun, 0.01);
  EXPECT_LT(dark.beyond_sky[ScatteredLight::kLayers - 1], 1e-6);
  EXPECT_LT(dark.beyond_sun[ScatteredLight::kLayers - 1], 1e-6);
  // No layer is farther from endless water than the layer above it.
  for (std::size_t k = 1; k < ScatteredLight::kLayers; ++k) {
    EXPECT_LE(dark.beyond_sky[k], dark.beyond_sky[k - 1]) << k;
    EXPECT_LE(dark.beyond_sun[k], dark.beyond_sun[k - 1]) << k;
  }
}

/// Water that absorbs nothing and scatters half of the light per unit of path, under an even sky of
/// radiance 1, over a bottom of albedo 0.9.
test::Tray furnace(double deep) {
  test::Tray tray({3, 2});
  for (int c = 0; c < 3; ++c) {
    tray.buffers.fill(plane_after(PlaneId::kColorR, c), 0.9f);
    tray.buffers.fill(plane_after(PlaneId::kAlbedoR, c), 0.9f);
  }
  tray.buffers.fill(PlaneId::kDepth, static_cast<float>(10 + deep));
  DepthFog::Params& fog = tray.look.of<DepthFog>();
  fog = test::plain_fog(DepthFog::Model::kRadiativeTransfer);
  fog.absorption = {0, 0, 0};
  fog.scattering = {0.5, 0.5, 0.5};
  fog.ambient = {1, 1, 1};
  fog.anisotropy = 0;
  return tray;
}
double light_from_below(const test::Tray& tray) {
  const test::Picture got = tray.wet();
  return got.aov(Aov::kTransmitted, 1, 1) + got.aov(Aov::kInScatter, 1, 1);
}

// All light of the sky comes back from water without an end. A bottom that is no more than half an
// optical depth under the surface absorbs a tenth of the light that arrives.
TEST(ScatteredLight, OfAWhiteFurnaceComesBackWhatTheBottomLeaves) {
  EXPECT_NEAR(light_from_below(furnace(1e4)), 1, 0.03);
  for (const double deep : {0.1, 0.3, 1.0}) {
    EXPECT_GT(light_from_below(furnace(deep)), 0.86) << deep;
    EXPECT_LT(light_from_below(furnace(deep)), 1) << deep;
  }
}

TEST(ScatteredLight, WhatADeepBottomChangesIsInTheBound) {
  const double endless = light_from_below(furnace(1e4));
  for (const double deep : {2.0, 6.0, 20.0}) {
    const test::Tray tray = furnace(deep);
    const DepthFog::Params& fog = tray.look.of<DepthFog>();
    Pass pass(tray.scene, tray.buffers.frame, 1.333, {});
    ScatteredLightMaker maker;
    pass.scattered_light = maker.make(Kernel<DepthFog>::scattering_water(fog, pass)).data();
    Ranges ranges;
    ranges.fog_path = {deep, deep};
    ranges.color = {{{0.9, 0.9}, {0.9, 0.9}, {0.9, 0.9}}};
    const double change = std::abs(light_from_below(tray) - endless);
    EXPECT_GT(change, 1e-4) << deep;
    EXPECT_LE(change, Kernel<DepthFog>::beyond(fog, pass, ranges)) << deep;
  }
}

/// Water without scattering, which returns light of a bottom that has stripes of albedo 0.2 in the
/// columns 4 and 5, else 0.6; the columns from 6 on lie in the shade.
test::Tray striped(bool told) {
  test::Tray tray({12, 3});
  const auto albedo = [](int x) { return x == 4 || x == 5 || x == 8 || x == 9 ? 0.2f : 0.6f; };
  const auto lit = [](int x) { return x < 6 ? 1.0f : 0.0f; };
  tray.scene.sun = Sun{.direction = {0, 1, 0}, .color = {2, 2, 2}};
  for (int c = 0; c < 3; ++c) {
    tray.buffers.set(plane_after(PlaneId::kColorR, c),
                     [=](int x, int) { return albedo(x) * (2 * lit(x) + 0.5f); });
    tray.buffers.fill(plane_after(PlaneId::kAlbedoR, c), 0.5f);
  }
  if (told) tray.buffers.set(PlaneId::kShadow, [=](int x, int) { return lit(x); });
  DepthFog::Params& fog = tray.look.of<DepthFog>();
  fog = test::plain_fog(DepthFog::Model::kRadiativeTransfer);
  fog.absorption = {0.02, 0.02, 0.02};
  fog.ambient = {0.5, 0.5, 0.5};
  fog.crossing = DepthFog::Crossing::kRadiance;
  return tray;
}

// What the surface throws back falls on each point alike, and each reflects it by its own albedo.
TEST(ScatteredLight, ThatComesBackToTheBottomKeepsItsTexture) {
  const test::Picture wet = striped(true).wet();
  const auto sent = [&](int x) { return wet.aov(Aov::kTransmitted, x, 1, 1); };
  EXPECT_NEAR(sent(4) / sent(2), 1 / 3.0, 1e-4);
  EXPECT_NEAR(sent(8) / sent(11), 1 / 3.0, 1e-4);
  // In the shade less light of its own, and as much of the rest.
  test::Tray bare = striped(true);
  bare.look.of<DepthFog>().model = DepthFog::Model::kBeerLambert;
  const test::Picture once = bare.wet();
  const auto more = [&](int x) { return sent(x) - once.aov(Aov::kTransmitted, x, 1, 1); };
  EXPECT_GT(more(2), 0.02);
  EXPECT_NEAR(more(11), more(2), 1e-3 * more(2));
}

// A bottom in stripes along the view, seen from a metre below the surface, and its mirror image in
// the surface three metres above it.
TEST(ScatteredLight, ThatComesBackKeepsTheTextureOfTheBottomSeenFromWithin) {
  constexpr Size kSize{24, 48};
  test::Tray tray(kSize);
  tray.look = striped(true).look;
  tray.look.of<FresnelReflection>() = {.source = FresnelReflection::Source::kAuto};
  tray.scene = test::simple_scene(kSize);
  tray.scene.sun = Sun{.direction = {0, 1, 0}, .color = {2, 2, 2}};
  tray.scene.camera->view =
      glm::lookAt(glm::dvec3(0, -1, 0), glm::dvec3(0, -1, -1), glm::dvec3(0, 1, 0));
  const Rays rays = rays_of(*tray.scene.camera, {kSize.width, kSize.height});
  tray.buffers.fill(PlaneId::kShadow, 1).set(PlaneId::kDepth, [&](int, int y) {
    const double sinks = -rays.ray_at(12, y + 0.5).y;
    return sinks > 0 ? static_cast<float>(2 / sinks) : HUGE_VALF;
  });
  tray.buffers.set(PlaneId::kSurfaceDepth, [&](int, int y) {
    const double rises = rays.ray_at(12, y + 0.5).y;
    return rises > 0 ? static_cast<float>(1 / rises) : HUGE_VALF;
  });
  for (int c = 0; c < 3; ++c) {
    tray.buffers.set(plane_after(PlaneId::kColorR, c),
                     [](int x, int) { return 2.5f * (x / 6 % 2 == 0 ? 0.2f : 0.6f); });
    tray.buffers.fill(plane_after(PlaneId::kAlbedoR, c), 0.5f);
  }
  const test::Picture wet = tray.wet();
  const auto seen = [&](int x) { return wet.aov(Aov::kTransmitted, x, 40, 1); };
  EXPECT_GT(wet.aov(Aov::kPath, 9, 40), 2);
  EXPECT_GT(seen(9), 0.5);
  EXPECT_NEAR(seen(15) / seen(9), 1 / 3.0, 1e-3);
  const auto mirrored = [&](int x) { return wet.aov(Aov::kReflected, x, 14, 1); };
  EXPECT_GT(mirrored(9), 0.5);
  EXPECT_NEAR(mirrored(15) / mirrored(9), 1 / 3.0, 1e-3);
}

// An object hides the bottom, which the layer below shows; the shadow on the surface tells its
// light.
TEST(ScatteredLight, ThatComesBackToHiddenBottomKeepsItsTexture) {
  test::Tray tray = striped(true);
  const View<const float> lit = tray.buffers.frame.plane(PlaneId::kShadow);
  tray.buffers.set(PlaneId::kSurfaceShadow, [&](int x, int y) { return lit.at(x, y); });
  tray.buffers.fill(PlaneId::kShadow, 1);
  for (int c = 0; c < 3; ++c) {
    const View<const float> color = tray.buffers.frame.plane(plane_after(PlaneId::kColorR, c));
    tray.buffers.set(plane_after(PlaneId::kBelowR, c),
                     [&](int x, int y) { return color.at(x, y); });
    tray.buffers.fill(plane_after(PlaneId::kColorR, c), 0.5f);
    tray.buffers.fill(plane_after(PlaneId::kSunColorR, c), 0.4f);
  }
  tray.buffers.fill(PlaneId::kBelowDepth, 14).fill(PlaneId::kDepth, 12);
  tray.look.of<Refraction>().model = Refraction::Model::kSnell;
  tray.look.of<Caustics>() = {};
  const test::Picture wet = tray.wet();
  const auto sent = [&](int x) { return wet.aov(Aov::kTransmitted, x, 1, 1); };
  EXPECT_NEAR(sent(4) / sent(3), 1 / 3.0, 0.01);
  EXPECT_NEAR(sent(8) / sent(7), 1 / 3.0, 0.01);
}

// A camera two metres over water as deep as that, under an even sky that fills the upper half.
TEST(ScatteredLight, IsThatOfTheVisibleSkyIfNothingElseTellsIt) {
  constexpr Size kSize{24, 48};
  constexpr float kSky = 0.75f;
  test::Tray tray(kSize);
  tray.look = striped(true).look;
  tray.look.of<DepthFog>().scattering = {0.2, 0.2, 0.2};
  tray.scene = test::simple_scene(kSize);
  tray.scene.camera->view =
      glm::lookAt(glm::dvec3(0, 2, 0), glm::dvec3(0, 2, -1), glm::dvec3(0, 1, 0));
  const Rays rays = rays_of(*tray.scene.camera, {kSize.width, kSize.height});
  const auto depth = [&](int, int y) {
    const double sinks = -rays.ray_at(12, y + 0.5).y;
    return sinks > 0 ? static_cast<float>(4 / sinks) : HUGE_VALF;
  };
  tray.buffers.set(PlaneId::kDepth, depth).fill(PlaneId::kShadow, 1);
  for (int c = 0; c < 3; ++c) {
    tray.buffers.set(plane_after(PlaneId::kColorR, c),
                     [&](int x, int y) { return depth(x, y) < 1e30f ? 0.25f : kSky; });
    tray.buffers.fill(plane_after(PlaneId::kAlbedoR, c), 0.5f);
  }
  const test::Picture shown = tray.wet();
  tray.scene.sky = SkyLight{.radiance = {kSky, kSky, kSky}};
  const test::Picture told = tray.wet();
  tray.scene.sky = SkyLight{.radiance = {2 * kSky, 2 * kSky, 2 * kSky}};
  const test::Picture other = tray.wet();
  const auto glow = [](const test::Picture& wet) { return wet.aov(Aov::kInScatter, 12, 40, 1); };
  EXPECT_GT(glow(told), 0.01);
  EXPECT_NEAR(glow(shown), glow(told), 1e-5);
  EXPECT_GT(glow(other), 1.2 * glow(told));
}

// In shade that nothing known lights, a color is no albedo.
TEST(ScatteredLight, IsThatOfTheBottomAroundInShadeWithoutASky) {
  test::Tray tray = striped(true);
  tray.look.of<DepthFog>().ambient = {0, 0, 0};
  const test::Picture wet = tray.wet();
  tray.look.of<DepthFog>().model = DepthFog::Model::kBeerLambert;
  const test::Picture once = tray.wet();
  const auto more = [&](int x) {
    return wet.aov(Aov::kTransmitted, x, 1, 1) - once.aov(Aov::kTransmitted, x, 1, 1);
  };
  EXPECT_GT(more(11), 0);
  EXPECT_NEAR(more(8), more(11), 1e-6);
  EXPECT_LT(more(11), more(2));
}

TEST(ScatteredLight, TakesAnAlbedoThatIsGivenAsItIs) {
  const auto completed = [](const test::Tray& tray) {
    return make_plan(tray.look, test::inputs_of(tray.buffers.frame, tray.scene)).completed;
  };
  test::Tray tray = striped(true);
  EXPECT_FALSE(completed(tray).has(PlaneId::kBasin));
  for (int c = 0; c < 3; ++c) tray.buffers.frame.planes[index_of(PlaneId::kAlbedoR) + c] = {};
  EXPECT_TRUE(completed(tray).covers(kAlbedoPlanes | PlaneSet{PlaneId::kBasin}));
}

// Without a shadow a dark texel may as well lie in the shade.
TEST(ScatteredLight, IsThatOfTheBottomAroundWhereNoShadowIsKnown) {
  const test::Picture wet = striped(false).wet();
  EXPECT_GT(wet.aov(Aov::kTransmitted, 4, 1, 1) / wet.aov(Aov::kTransmitted, 2, 1, 1), 0.36);
}

// Pixels whose views begin in the water do not change a pixel whose view begins in the air.
TEST(ScatteredLight, OfAViewFromTheAirDoesNotKnowOfOthers) {
  const test::Tray tray = furnace(3);
  const DepthFog::Params& fog = tray.look.of<DepthFog>();
  Pass pass(tray.scene, tray.buffers.frame, 1.333, kWholeState);
  ScatteringWater water = Kernel<DepthFog>::scattering_water(fog, pass);
  water.inside = true;
  ScatteredLightMaker maker;
  pass.scattered_light = maker.make(water).data();
  const auto seen = [&](bool submersible) {
    pass.submersible = submersible;
    test::ProbeStrip strip;
    for (int i = 0; i < 4; ++i) {
      strip.pixels.push_back(
          test::random_pixel(i, {StatePart::kPosition, StatePart::kPath, StatePart::kTransmitted}));
    }
    Kernel<DepthFog>::apply(fog, pass, strip);
    return strip.pixels;
  };
  const std::vector<Pixel<double>> alone = seen(false), among = seen(true);
  for (std::size_t i = 0; i < alone.size(); ++i) {
    EXPECT_GT(alone[i].in_scatter.g, 0);
    EXPECT_EQ(among[i].in_scatter, alone[i].in_scatter);
    EXPECT_EQ(among[i].sun_multiple, alone[i].sun_multiple);
  }
}

TEST(ScatteredLight, IsMadeAnewForOtherWater) {
  ScatteredLightMaker maker;
  const double clear = maker.make({{1, 1, 1}, {0.1, 0.1, 0.1}, 0, 0.8})[0].most_sun;
  const double murky = maker.make({{1, 1, 1}, {1, 1, 1}, 0, 0.8})[0].most_sun;
  EXPECT_GT(murky, 5 * clear);
  EXPECT_EQ(maker.make({{1, 1, 1}, {0.1, 0.1, 0.1}, 0, 0.8})[0].most_sun, clear);
}

}  // namespace
}  // namespace limpid
