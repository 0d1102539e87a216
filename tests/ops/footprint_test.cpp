#include "op/footprint.h"

#include <numbers>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "op/pixel_start.h"
#include "ops/probe_strip.h"
#include "ops/wave_normals_kernel.h"

// The footprint of one pixel on the water, and the waves in the footprint.

namespace limpid {
namespace {

constexpr Size kSize{64, 48};

/// The pixel at x, y of a frame without waves.
Pixel<double> calm_pixel(const Pass& c, double x, double y) {
  const RowRays<double> row(c, y);
  Pixel<double> p{};
  begin_pixel(c, row, x, 1.0, row.calm_depth(x), 1e9, p);
  begin_state(kWholeState, c, Rgb<double>{0, 0, 0}, p);
  return p;
}

Pass context_of(const Scene& scene) {
  static const test::Buffers buffers = [] {
    test::Buffers b(rect_of(kSize));
    for (const PlaneId id :
         {PlaneId::kColorR, PlaneId::kColorG, PlaneId::kColorB, PlaneId::kDepth}) {
      b.fill(id, 1);
    }
    return b;
  }();
  return Pass(scene, buffers.frame, 1.333, kWholeState);
}

Vec2<double> on_map(const Pass& c, const Pixel<double>& p) {
  return {dot(vec3_of<double>(c.map_x), p.surface_point),
          dot(vec3_of<double>(c.map_y), p.surface_point)};
}

TEST(Footprint, IsThatOfNeighbouringRays) {
  for (const bool orthographic : {false, true}) {
    Scene scene = test::simple_scene(kSize);
    if (orthographic) {
      scene.camera->projection = limpid::orthographic(2.4, 1.8, 0.1, 100, ClipSpace::kGl);
    }
    const Pass c = context_of(scene);
    for (const double y : {20.5, 30.5, 47.5}) {
      const Sym2<double> got = footprint(c, calm_pixel(c, 13.5, y));
      const auto across = [&](double dx, double dy) {
        const Vec2<double> to = on_map(c, calm_pixel(c, 13.5 + dx, y + dy));
        const Vec2<double> from = on_map(c, calm_pixel(c, 13.5 - dx, y - dy));
        return Vec2<double>{(to.x - from.x) / (2 * (dx + dy)), (to.y - from.y) / (2 * (dx + dy))};
      };
      const Vec2<double> x = across(1e-3, 0), down = across(0, 1e-3);
      EXPECT_NEAR(12 * got.xx, x.x * x.x + down.x * down.x, 1e-5);
      EXPECT_NEAR(12 * got.xy, x.x * x.y + down.x * down.y, 1e-5);
      EXPECT_NEAR(12 * got.yy, x.y * x.y + down.y * down.y, 1e-5);
    }
  }
}

// A camera below the surface has, upside down, the same footprints as a camera as far above the
// surface.
TEST(Footprint, FromBelowIsThatFromAbove) {
  Scene scene = test::simple_scene(kSize), below = scene;
  below.camera->view = glm::scale(glm::dmat4(1), glm::dvec3(1, -1, 1)) * below.camera->view *
                       glm::scale(glm::dmat4(1), glm::dvec3(1, -1, 1));
  const Pass c = context_of(scene), under = context_of(below);
  ASSERT_NEAR(under.eye_above, -c.eye_above, 1e-12);
  for (const double y : {20.5, 30.5, 47.5}) {
    const Sym2<double> want = footprint(c, calm_pixel(c, 13.5, y));
    const Sym2<double> got = footprint(under, calm_pixel(under, 13.5, kSize.height - y));
    EXPECT_NEAR(got.xx, want.xx, 1e-9 * want.xx);
    EXPECT_NEAR(got.yy, want.yy, 1e-9 * want.yy);
  }
}

// The four parts of a pixel lie one behind another on the water, each a quarter as long; in a
// rolled camera the parts lie side by side on the screen.
TEST(Footprint, OfAPartIsShorterTheWayTheWaterRecedes) {
  for (const double roll : {0.0, 0.5 * std::numbers::pi}) {
    Scene scene = test::simple_scene(kSize);
    scene.camera->view =
        glm::dmat4(glm::rotate(glm::dmat4(1), roll, glm::dvec3(0, 0, 1))) * scene.camera->view;
    const Pass whole = context_of(scene);
    const Pixel<double> centre = calm_pixel(whole, 32.5, 24.5);
    const Sym2<double> all = footprint(whole, centre);
    double mean = 0;
    for (int i = 0; i < 4; ++i) {
      scene.part = {i, 4};
      const Pass c = context_of(scene);
      const Pixel<double> p = calm_pixel(c, 32.5, 24.5);
      const Sym2<double> part = footprint(c, p);
      // The view is along map y there.
      EXPECT_NEAR(part.yy / all.yy, 1. / 16, 0.01);
      EXPECT_NEAR(part.xx / all.xx, 1, 0.05);
      const double off = on_map(c, p).y - on_map(whole, centre).y;
      const double length = std::sqrt(12 * all.yy);
      EXPECT_NEAR(std::abs(off) / length, i == 0 || i == 3 ? 0.375 : 0.125, 0.03);
      mean += off / 4;
      EXPECT_DOUBLE_EQ(p.uv.x, centre.uv.x);
    }
    EXPECT_NEAR(mean / std::sqrt(12 * all.yy), 0, 0.01);
  }
}

// Straight down the water recedes in no direction.
TEST(Footprint, PartsLieBelowOneAnotherStraightDown) {
  Scene scene = test::simple_scene(kSize);
  scene.camera->view = glm::lookAt(glm::dvec3(0, 2, 0), glm::dvec3(0, 0, 0), glm::dvec3(0, 0, -1));
  scene.part = {0, 2};
  const Pass c = context_of(scene);
  EXPECT_NEAR(c.off_centre.x, 0, 1e-12);
  EXPECT_NEAR(c.off_centre.y, -0.25, 1e-12);
}

TEST(Footprint, OfAllOfAPixelHasTheBitsOfThePixel) {
  Scene scene = test::simple_scene(kSize);
  const Pass plain = context_of(scene);
  scene.part = {0, 1};
  const Pass c = context_of(scene);
  EXPECT_EQ(c.rays.ray, plain.rays.ray);
  EXPECT_EQ(c.part.ray_dy, plain.rays.ray_dy);
  scene.part = {1, 1};
  EXPECT_THROW(context_of(scene), Error);
}

TEST(Footprint, HasBoundsAtTheHorizon) {
  const Scene scene = test::simple_scene(kSize);
  const Pass c = context_of(scene);
  Pixel<double> p = calm_pixel(c, 13.5, 30.5);
  for (const double rise : {0.0, 1e-9, -1e-9, 1e-300}) {
    p.to_viewer = normalize_or<double>({0.3, rise, 1}, {0, 0, 1});
    p.surface_depth = 1e30;
    const Sym2<double> got = footprint(c, p);
    EXPECT_TRUE(std::isfinite(got.xx) && std::isfinite(got.xy) && std::isfinite(got.yy));
    EXPECT_LE(got.yy, 1e12);
  }
}

/// Mean and covariance of the slopes of a wave over a Gaussian footprint, by many samples.
struct Seen {
  Vec2<double> mean{0, 0};
  Sym2<double> spread{0, 0, 0};
};
Seen sampled(const SineWave& wave, Vec2<double> at, Sym2<double> footprint) {
  Seen seen;
  const double a = std::sqrt(footprint.xx), b = footprint.xy / a;
  const double rest = std::sqrt(std::max(footprint.yy - b * b, 0.0));
  double weights = 0;
  for (double u = -5; u <= 5; u += 0.05) {
    for (double v = -5; v <= 5; v += 0.05) {
      const double weight = std::exp(-0.5 * (u * u + v * v));
      const double x = at.x + a * u, y = at.y + b * u + rest * v;
      const double rise = wave.amplitude * std::cos(wave.k_x * x + wave.k_y * y + wave.phase);
      const Vec2<double> slope{wave.k_x * rise, wave.k_y * rise};
      seen.mean = seen.mean + weight * slope;
      seen.spread = seen.spread +
                    weight * Sym2<double>{slope.x * slope.x, slope.x * slope.y, slope.y * slope.y};
      weights += weight;
    }
  }
  seen.mean = (1 / weights) * seen.mean;
  const Sym2<double> square{seen.mean.x * seen.mean.x, seen.mean.x * seen.mean.y,
                            seen.mean.y * seen.mean.y};
  seen.spread = (1 / weights) * seen.spread + -1.0 * square;
  return seen;
}

TEST(Sines, WhatAPixelCannotResolveBecomesVariance) {
  Scene scene = test::simple_scene(kSize);
  const Pass c = context_of(scene);
  const SineWave wave{0.02, 3, 5, 0.7, 0};
  WaveNormals::Params params;
  params.model = WaveNormals::Model::kSines;
  params.filter = WaveNormals::Filter::kVariance;
  params.strength = 1;
  params.waves = {wave};
  for (const double y : {18.5, 22.5, 30.5, 47.5}) {
    test::ProbeStrip strip;
    strip.pixels.push_back(calm_pixel(c, 20.5, y));
    const Vec2<double> at = on_map(c, strip.pixels[0]);
    const Seen seen = sampled(wave,
                              {at.x + dot(vec3_of<double>(c.map_x), vec3_of<double>(c.eye)),
                               at.y + dot(vec3_of<double>(c.map_y), vec3_of<double>(c.eye))},
                              footprint(c, strip.pixels[0]));
    Kernel<WaveNormals>::apply(params, c, strip);
    const Pixel<double>& p = strip.pixels[0];
    const double up = dot(p.normal, vec3_of<double>(c.up));
    EXPECT_NEAR(-dot(p.normal, vec3_of<double>(c.map_x)) / up, seen.mean.x, 2e-5) << y;
    EXPECT_NEAR(-dot(p.normal, vec3_of<double>(c.map_y)) / up, seen.mean.y, 2e-5) << y;
    EXPECT_NEAR(p.slope_variance.xx, seen.spread.xx, 1e-6) << y;
    EXPECT_NEAR(p.slope_variance.xy, seen.spread.xy, 1e-6) << y;
    EXPECT_NEAR(p.slope_variance.yy, seen.spread.yy, 1e-6) << y;
  }
}

}  // namespace
}  // namespace limpid
