#include "ops/penetration_kernel.h"
#include "ops/probe_strip.h"
#include "ops/tray.h"

namespace limpid {
namespace {

using test::Noise;
using test::Tray;

Penetration::Params view_angle(double alpha, double amount, double power) {
  return {Penetration::Model::kViewAngle, alpha, amount, power};
}

/// Dry color 0.5; fog of color (0.1, 0.2, 0.3) that hides the dry color.
Tray murky_tray() {
  Tray tray({6, 4});
  tray.look.of<DepthFog>().alpha = 1;
  tray.look.of<DepthFog>().density = 1000;
  tray.look.of<DepthFog>().color = {0.1, 0.2, 0.3};
  return tray;
}

// Seen straight down: a = 0.9 - 0.3 = 0.6 whatever the power.
TEST(Penetration, StraightDownByHand) {
  for (double power : {0.0, 1.0, 5.0}) {
    Tray tray = murky_tray();
    test::expect_rgb(tray.wet().color(2, 2), {0.1, 0.2, 0.3});
    tray.look.of<Penetration>() = view_angle(0.9, 0.3, power);
    test::expect_rgb(tray.wet().color(2, 2), {0.26, 0.32, 0.38});
  }
}

// At 60 degrees from straight down V.up is 1/2: 1 - 0.8 (1/2)^2 = 0.8 of each part of the surface
// is left.
TEST(Penetration, EveryPartOfTheSurfaceIsBlended) {
  test::ProbeStrip strip;
  strip.pixels.push_back(test::random_pixel(3, {}));
  Pixel<double>& p = strip.pixels[0];
  p.to_viewer = {std::sqrt(0.75), 0.5, 0};
  p.transmitted = {1, 2, 3};
  p.in_scatter = {0.5, 0.25, 0.125};
  p.reflected = {10, 20, 30};
  p.highlight = {100, 200, 300};
  Pixel<double> before = p, black = p;
  black.transmitted = {0, 0, 0};
  const Size size{4, 3};
  const test::Buffers buffers = test::noisy_frame(rect_of(size));
  const Pass pass(test::simple_scene(size), buffers.frame, 1.333, {});
  const Penetration::Params params = view_angle(1, 0.8, 2);
  Kernel<Penetration>::apply(params, pass, strip);
  test::expect_rgb(p.in_scatter, {0.4, 0.2, 0.1}, 1e-12);
  test::expect_rgb(p.reflected, {8, 16, 24}, 1e-12);
  test::expect_rgb(p.highlight, {80, 160, 240}, 1e-12);
  // The probe's value of the dry color is added, by a fifth.
  test::ProbeStrip of_dry;
  of_dry.pixels.push_back(black);
  Kernel<Penetration>::apply(params, pass, of_dry);
  const Rgb<double> let_through = of_dry.pixels[0].transmitted;
  EXPECT_GT(let_through.r, 0);
  test::expect_rgb(p.transmitted - let_through, 0.8 * before.transmitted, 1e-12);
}

TEST(Penetration, OpaqueAndClearSurfaces) {
  const Size size{23, 17};
  Noise noise(size);
  noise.look = Look{};
  const test::Picture opaque = noise.wet();
  noise.look.of<Penetration>() = view_angle(0, 1, 5);
  const test::Picture clear = noise.wet();
  const auto dry = [&](int c, int x, int y) {
    return noise.buffers.frame.plane(plane_after(PlaneId::kColorR, c)).at(x, y);
  };
  noise.look.of<Penetration>() = view_angle(0.7, 0, 5);
  const test::Picture half = noise.wet();
  each_wet(opaque, size, [&](int x, int y) {
    if (std::isinf(noise.buffers.frame.plane(PlaneId::kDepth).at(x, y))) {
      test::expect_rgb(clear.color(x, y), opaque.color(x, y), 0);  // no bottom is visible
      return;
    }
    const Rgb<double> picture{dry(0, x, y), dry(1, x, y), dry(2, x, y)};
    test::expect_rgb(clear.color(x, y), picture, 0);
    test::expect_rgb(half.color(x, y), 0.7 * opaque.color(x, y) + 0.3 * picture);
  });
}

// The article means to see through the water in views down, not towards the horizon.
TEST(Penetration, LetsThroughLessTowardsTheHorizon) {
  Noise noise({5, 40});
  noise.buffers.fill(PlaneId::kSurfaceDepth, 3).fill(PlaneId::kDepth, 5);
  for (int c = 0; c < 3; ++c) noise.buffers.fill(plane_after(PlaneId::kColorR, c), 1);
  noise.look.of<DepthFog>().alpha = 1;
  noise.look.of<DepthFog>().density = 1000;
  noise.look.of<DepthFog>().color = {0, 0, 0};
  noise.look.of<Penetration>() = view_angle(1, 1, 5);
  const test::Picture got = noise.wet();
  for (int y = 1; y < 40; ++y) EXPECT_GT(got.color(2, y).r, got.color(2, y - 1).r) << y;
}

TEST(Penetration, TheWavesDoNotMatter) {
  Tray tray = murky_tray();
  tray.look.of<Penetration>() = view_angle(1, 0.5, 3);
  const Rgb<double> calm = tray.wet().color(2, 2);
  tray.buffers.normal({0.6, 0.8, 0});
  test::expect_rgb(tray.wet().color(2, 2), calm, 0);
}

TEST(Penetration, NoneFromBelow) {
  Tray tray = murky_tray();
  tray.scene.camera->projection = perspective(1, 1, 0.1, 100, ClipSpace::kGl);
  tray.scene.camera->view =
      glm::lookAt(glm::dvec3(0, -10, 0), glm::dvec3(0, 0, 0), glm::dvec3(0, 0, -1));
  const test::Picture without = tray.wet();
  tray.look.of<Penetration>() = view_angle(0.2, 0.1, 1);
  EXPECT_EQ(tray.wet().values(), without.values());
}

// At 60 degrees from straight down 0.5 x 0.5^2 is let through, and may replace light of 2.
TEST(Penetration, BoundIsOfTheSteepestView) {
  const Tray tray({1, 1});
  const Pass pass(tray.scene, tray.buffers.frame, 1.333, {});
  Ranges ranges;
  ranges.sink = {0.1, 0.5};
  ranges.color = {{{0, 1}, {0, 0}, {0, 0}}};
  ranges.light = 1;
  EXPECT_NEAR(Kernel<Penetration>::bound(view_angle(1, 0.5, 2), pass, ranges), 0.125 * 2, 1e-12);
}

}  // namespace
}  // namespace limpid
