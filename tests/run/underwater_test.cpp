#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "optics/fresnel.h"
#include "optics/waves.h"
#include "support.h"

// A camera in the water, or half in the water: by the whole chain, in both runners.

namespace limpid {
namespace {

using test::Buffers;
using test::Picture;

constexpr Size kSize{64, 48};
constexpr double kNear = 0.1, kFov = 0.9, kIor = 1.333;
const SineWave kWave{0.03, 9, 4, 0.6, 2};

/// Looks along -z from `height` over the calm water, up by `pitch`.
Scene scene_at(double height, double pitch = 0, std::vector<SineWave> waves = {}) {
  Scene scene = test::simple_scene(kSize);
  const glm::dvec3 eye(0.3, height, 0.2);
  scene.camera->view =
      glm::lookAt(eye, eye + glm::dvec3(0, std::sin(pitch), -std::cos(pitch)), {0, 1, 0});
  scene.camera->projection =
      perspective(kFov, double(kSize.width) / kSize.height, kNear, 1e3, ClipSpace::kGl);
  scene.water->waves = std::move(waves);
  scene.time = 0.8;
  return scene;
}

glm::dvec3 ray_of(const Scene& scene, int x, int y) {
  return rays_of(*scene.camera, {kSize.width, kSize.height}).ray_at(x + 0.5, y + 0.5);
}

/// The height over the wave of a point of the ray.
double height_over_wave(const Scene& scene, int x, int y, double depth) {
  const glm::dvec3 at = scene.camera->eye() + depth * ray_of(scene, x, y);
  const PlaneAxes axes = plane_axes(scene.water->up);
  return at.y -
         wave_height(scene.water->waves, glm::dot(axes.x, at), glm::dot(axes.y, at), scene.time)
             .height;
}

/// The height over the wave of the window through which the view begins, at this pixel.
double window_over_wave(const Scene& scene, int x, int y) {
  return height_over_wave(scene, x, y, kNear);
}

/// A wall that fills the picture at this eye depth, and no surface in front of it.
Buffers wall_at(float depth) {
  Buffers b(rect_of(kSize));
  for (int c = 0; c < 3; ++c) {
    b.set(plane_after(PlaneId::kColorR, c),
          [=](int x, int y) { return 0.2f + test::noise(x / 6, y / 6, c); });
  }
  b.fill(PlaneId::kColorA, 0.5).fill(PlaneId::kShadow, 1);
  b.fill(PlaneId::kDepth, depth).fill(PlaneId::kSurfaceDepth, test::kInf);
  return b;
}

using Runner = Picture (*)(const Look&, const Frame&, const Scene&);
Picture run_fast(const Look& look, const Frame& frame, const Scene& scene) {
  return test::fused(look, frame, scene);
}

class Underwater : public testing::TestWithParam<Runner> {
 protected:
  static Picture run(const Look& look, const Buffers& b, const Scene& scene) {
    return GetParam()(look, b.frame, scene);
  }
};

INSTANTIATE_TEST_SUITE_P(Runners, Underwater, testing::Values(&test::reference, &run_fast),
                         [](const auto& p) { return p.index == 0 ? "Reference" : "Fused"; });

template <class Fn>
void for_each_pixel(Fn&& fn) {
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) fn(x, y);
  }
}

/// The physical look without the waves' own map; the mirror sees one color.
Look calm_look(Rgb<double> mirrored = {0, 0, 0}) {
  Look look;
  look.of<WaveNormals>().model = WaveNormals::Model::kSines;
  look.of<FresnelReflection>().source = FresnelReflection::Source::kConstant;
  look.of<FresnelReflection>().color = mirrored;
  look.of<PrismSplit>().gain = 0;
  look.of<Caustics>() = {.strength = 0, .sunlight = Caustics::Sunlight::kStraight};
  return look;
}

TEST_P(Underwater, APixelIsInTheWaterWhereItsWindowIsUnderTheWave) {
  constexpr float kWall = 3;
  const Buffers b = wall_at(kWall);
  for (double height : {0.04, 0.0, -0.01}) {
    const Scene scene = scene_at(height, 0, {kWave});
    const Picture p = run(calm_look(), b, scene);
    int in_water = 0, in_air = 0;
    for_each_pixel([&](int x, int y) {
      const double over = window_over_wave(scene, x, y);
      if (std::abs(over) < 1e-6) return;  // too close for float
      const bool wet = over < 0;
      (wet ? in_water : in_air) += 1;
      EXPECT_EQ(p.target.alpha.at(x, y), wet ? 1 : 0.5f) << x << ", " << y << ": " << over;
      // The water begins at the eye, not at the window: the short path between the two counts too.
      const double distance = kWall * glm::length(ray_of(scene, x, y));
      EXPECT_NEAR(p.aov(Aov::kPath, x, y), wet ? distance : 0, 1e-5);
      EXPECT_EQ(p.aov(Aov::kSurfaceDepth, x, y), test::kInf);
      for (int c = 0; c < 3; ++c) {
        const float dry = b.frame.plane(plane_after(PlaneId::kColorR, c)).at(x, y);
        if (!wet) {
          EXPECT_EQ(p.target.color[c].at(x, y), dry);
        }
        if (wet) {
          EXPECT_NE(p.target.color[c].at(x, y), dry);
        }
        EXPECT_LE(p.aov(Aov::kTransmitted, x, y, c), dry);
        EXPECT_TRUE(!wet || p.aov(Aov::kTransmitted, x, y, c) > 0) << "the wall is seen";
      }
    });
    EXPECT_GT(in_water, 100) << height;
    EXPECT_GT(in_air, 100) << height;
  }
}

/// Without a plane of the surface and without known waves the ray meets the calm plane, from the
/// side on which the view begins.
TEST_P(Underwater, TheCalmPlaneIsNotMetBeforeTheWindow) {
  Buffers b = wall_at(3);
  b.frame.planes[index_of(PlaneId::kSurfaceDepth)] = {};
  Look look = calm_look();
  look.of<WaveNormals>().strength = 0;
  for (double height : {0.02, -0.02}) {
    const Scene scene = scene_at(height, 0, {kWave});
    const Picture p = run(look, b, scene);
    for_each_pixel([&](int x, int y) {
      const glm::dvec3 ray = ray_of(scene, x, y);
      const double over = height + kNear * ray.y, meets = -height / ray.y;
      if (std::abs(over) < 1e-6) return;
      const bool surface = meets > kNear && meets < 3;
      EXPECT_EQ(p.target.alpha.at(x, y), over < 0 || surface ? 1 : 0.5f);
      const double depth = p.aov(Aov::kSurfaceDepth, x, y);
      EXPECT_EQ(std::isfinite(depth), surface);
      if (surface) {
        EXPECT_NEAR(depth, meets, 1e-4 * meets);
      }
      if (over < 0 && !surface) {
        EXPECT_EQ(p.aov(Aov::kFresnel, x, y), 0);
        EXPECT_NEAR(p.aov(Aov::kPath, x, y), 3 * glm::length(ray), 1e-5);
      }
    });
  }
}

/// With known waves the ray meets the waves, and the waves tell on which side the view begins.
TEST_P(Underwater, WavesAreNotMetBeforeTheWindow) {
  constexpr float kWall = 3;
  Buffers b = wall_at(kWall);
  b.frame.planes[index_of(PlaneId::kSurfaceDepth)] = {};
  Look look = calm_look();
  look.of<WaveNormals>().strength = 1;
  int in_water = 0, from_below = 0, from_above = 0;
  for (const double height : {0.01, 0.04}) {
    const Scene scene = scene_at(height, 0, {kWave});
    const Picture p = run(look, b, scene);
    for_each_pixel([&](int x, int y) {
      const double over = window_over_wave(scene, x, y);
      if (std::abs(over) < 1e-6) return;  // too close for float
      const double depth = p.aov(Aov::kSurfaceDepth, x, y);
      const bool met = std::isfinite(depth);
      EXPECT_EQ(p.target.alpha.at(x, y), over < 0 || met ? 1 : 0.5f) << x << ", " << y;
      in_water += over < 0 && !met;
      (over < 0 ? from_below : from_above) += met;
      if (!met) return;
      EXPECT_GE(depth, kNear);
      EXPECT_LT(depth, kWall);
      EXPECT_NEAR(height_over_wave(scene, x, y, depth), 0, 1e-5);
    });
  }
  EXPECT_GT(in_water, 100);
  EXPECT_GT(from_below, 100);
  EXPECT_GT(from_above, 100);
}

TEST_P(Underwater, PixelsInTheAirDoNotKnowThatOthersAreInTheWater) {
  Buffers b = test::noisy_frame(rect_of(kSize));
  for (int i = 0; i < 4; ++i) {  // the two cameras use the layer below differently
    b.frame.planes[index_of(PlaneId::kBelowR) + i] = {};
  }
  const Scene half = scene_at(0.05, 0, {kWave}), above = scene_at(0.05);
  Look look;
  look.of<Refraction>().rejection = Refraction::Rejection::kSnap;
  // The entry points of light differ between the two.
  look.of<Caustics>() = {.strength = 0, .sunlight = Caustics::Sunlight::kStraight};
  const Picture p = run(look, b, half), q = run(look, b, above);
  int in_air = 0, differ = 0;
  for_each_pixel([&](int x, int y) {
    const double over = window_over_wave(half, x, y);
    if (std::abs(over) < 1e-6) return;
    for (int c = 0; c < 3; ++c) {
      const bool same = p.target.color[c].at(x, y) == q.target.color[c].at(x, y);
      if (over > 0) {
        EXPECT_TRUE(same) << x << ", " << y;
      }
      differ += !same;
    }
    in_air += over > 0;
  });
  EXPECT_GT(in_air, 500);
  EXPECT_GT(differ, 500);
}

TEST_P(Underwater, BeyondTheCriticalAngleTheSurfaceIsAMirror) {
  Buffers b = wall_at(test::kInf);
  b.frame.planes[index_of(PlaneId::kSurfaceDepth)] = {};
  const Scene scene = scene_at(-1, 0.8);  // rays 20 ... 72 degrees above the horizon, at x = 0
  Look look = calm_look({0.5, 0.6, 0.7});
  look.of<DepthFog>() = test::plain_fog(DepthFog::Model::kBeerLambert);
  look.of<DepthFog>().distance = DepthFog::Distance::kRefracted;
  look.of<DepthFog>().absorption = {0.3, 0.1, 0.05};
  look.of<DepthFog>().sunlight = DepthFog::Sunlight::kNone;
  const Picture p = run(look, b, scene);
  int total = 0, through = 0;
  for_each_pixel([&](int x, int y) {
    const glm::dvec3 ray = glm::normalize(ray_of(scene, x, y));
    const double degrees = std::acos(ray.y) * 180 / std::numbers::pi, distance = 1 / ray.y;
    if (std::abs(degrees - 48.6) < 0.2) return;
    EXPECT_NEAR(p.aov(Aov::kPath, x, y), distance, 1e-5 * distance);
    const double f = degrees > 48.6 ? 1 : fresnel_exact(ray.y, 1 / kIor);
    EXPECT_NEAR(p.aov(Aov::kFresnel, x, y), f, 2e-5);
    (degrees > 48.6 ? total : through) += 1;
    const double rates[] = {0.3, 0.1, 0.05}, mirrored[] = {0.5, 0.6, 0.7};
    for (int c = 0; c < 3; ++c) {
      const double survives = std::exp(-rates[c] * distance);
      EXPECT_NEAR(p.aov(Aov::kReflected, x, y, c), f * survives * mirrored[c], 2e-5);
      if (f == 1) {
        EXPECT_EQ(p.aov(Aov::kTransmitted, x, y, c), 0);
      }
      if (f < 1) {
        EXPECT_GT(p.aov(Aov::kTransmitted, x, y, c), 0);
      }
    }
  });
  EXPECT_GT(total, 500);
  EXPECT_GT(through, 500);
}

// In uniform water with uniform in-scatter a path that the surface bends is as bright as a straight
// path.
TEST_P(Underwater, WhatTheSurfaceMirrorsIsSeenThroughTheWaterToo) {
  constexpr double kDeep = 3, kAmbient = 0.2, kRate = 0.3;  // half of it scattered
  constexpr float kLight = 0.8f;
  Look look = calm_look();
  look.of<DepthFog>() = test::plain_fog(DepthFog::Model::kBeerLambert);
  look.of<DepthFog>().distance = DepthFog::Distance::kRefracted;
  look.of<DepthFog>().absorption = look.of<DepthFog>().scattering = {0.15, 0.15, 0.15};
  look.of<DepthFog>().ambient = {kAmbient, kAmbient, kAmbient};
  using Source = FresnelReflection::Source;
  for (const Source source : {Source::kPlanar, Source::kAuto}) {
    // At the second pitch most of the mirrored light lies beyond the picture.
    for (const double pitch : {0.1, 0.4}) {
      Scene scene = scene_at(-1, pitch);
      scene.sun.reset();
      Buffers b = wall_at(test::kInf);
      b.frame.planes[index_of(PlaneId::kSurfaceDepth)] = {};
      const auto to_level = [&](double up, int x, int y) {
        const double distance = up / ray_of(scene, x, y).y;
        return distance > 0 ? static_cast<float>(distance) : test::kInf;
      };
      b.set(PlaneId::kDepth, [&](int x, int y) { return to_level(1 - kDeep, x, y); });
      for (int c = 0; c < 3; ++c) b.fill(plane_after(PlaneId::kColorR, c), kLight);
      look.of<FresnelReflection>().source = source;
      if (source == Source::kPlanar) {
        for (int c = 0; c < 3; ++c) b.fill(plane_after(PlaneId::kReflectionR, c), kLight);
        b.set(PlaneId::kReflectionDepth, [&](int x, int y) { return to_level(1 + kDeep, x, y); });
      }
      const Picture p = run(look, b, scene);
      int total = 0;
      for_each_pixel([&](int x, int y) {
        const double sine = glm::normalize(ray_of(scene, x, y)).y;
        const double degrees = std::asin(sine) * 180 / std::numbers::pi;
        if (!(degrees > 2 && degrees < 41)) return;  // 41.4: beyond, light passes
        const double left = std::exp(-kRate * (1 + kDeep) / sine);
        const double expected = kLight * left + kAmbient / 2 * (1 - left);
        const double off = source == Source::kPlanar ? 1e-4 : 0.02;  // depths are those of pixels
        const double seen = p.aov(Aov::kReflected, x, y, 1) + p.aov(Aov::kInScatter, x, y, 1);
        EXPECT_NEAR(seen, expected, off) << x << ", " << y << ", " << pitch;
        ++total;
      });
      EXPECT_GT(total, 300);
    }
  }
}

TEST_P(Underwater, SnellBendsOutwardsToWhatStandsInTheAir) {
  constexpr double kCeiling = 2;  // above the water
  const Scene scene = scene_at(-1, 1.2);
  Buffers b = wall_at(1);
  b.frame.planes[index_of(PlaneId::kSurfaceDepth)] = {};
  b.set(PlaneId::kDepth,
        [&](int x, int y) { return float((kCeiling + 1) / ray_of(scene, x, y).y); });
  for (int c = 0; c < 3; ++c) {  // the layer below the water is not visible in the air
    b.fill(plane_after(PlaneId::kBelowR, c), 0);
  }
  b.fill(PlaneId::kBelowDepth, test::kInf);
  const Picture p = run(calm_look(), b, scene);
  for (const glm::ivec2 at : {glm::ivec2(32, 20), glm::ivec2(40, 30), glm::ivec2(22, 24)}) {
    const glm::dvec3 eye = scene.camera->eye(), in = glm::normalize(ray_of(scene, at.x, at.y));
    const glm::dvec3 surface = eye + in / in.y;
    const glm::dvec3 level(kIor * in.x, 0, kIor * in.z);
    const glm::dvec3 out = level + glm::dvec3(0, std::sqrt(1 - glm::dot(level, level)), 0);
    EXPECT_LT(out.y, in.y) << "away from the normal";
    const glm::dvec3 end = surface + (kCeiling / out.y) * out;
    const glm::dvec4 clip = scene.camera->projection * scene.camera->view * glm::dvec4(end, 1);
    const double u = 0.5 + 0.5 * clip.x / clip.w, v = 0.5 + 0.5 * clip.y / clip.w;
    ASSERT_TRUE(u > 0.05 && u < 0.95 && v > 0.05 && v < 0.95) << u << ", " << v;
    EXPECT_NEAR(p.aov(Aov::kStmapG, at.x, at.y, 0), u, 0.02 / kSize.width);
    EXPECT_NEAR(p.aov(Aov::kStmapG, at.x, at.y, 1), v, 0.02 / kSize.height);
    EXPECT_EQ(p.aov(Aov::kConfidence, at.x, at.y), 1);
    EXPECT_GT(p.aov(Aov::kTransmitted, at.x, at.y), 0);
  }
}

/// The noise with a far depth wherever no surface was hit.
Buffers noise_with_an_end() {
  const Buffers noise = test::noisy_frame(rect_of(kSize));
  Buffers b = test::noisy_frame(rect_of(kSize));
  for (PlaneId depth : {PlaneId::kDepth, PlaneId::kBelowDepth}) {
    const auto& was = noise.frame.plane(depth);
    b.set(
        depth, [&](int x, int y) { return std::min(was.at(x, y), 50.0f); }, was.window);
  }
  return b;
}

/// The number of values that differ between the two runners by more than rounding.
std::size_t differences(const Frame& frame, const Scene& scene, std::size_t& values) {
  const std::vector<float> judge = test::reference({}, frame, scene).values();
  const std::vector<float> got = test::fused({}, frame, scene).values();
  EXPECT_EQ(judge.size(), got.size());
  std::size_t nan = 0, far = 0;
  for (std::size_t i = 0; i < judge.size(); ++i) {
    nan += std::isnan(judge[i]) || std::isnan(got[i]);
    const double allowed = 1e-3 * (1 + std::abs(judge[i]));
    far += !(judge[i] == got[i] || std::abs(judge[i] - got[i]) < allowed);
  }
  EXPECT_EQ(nan, 0u);
  values = judge.size();
  return far;
}

TEST(UnderwaterSweep, NoNanAndTheRunnersAgreeThroughTheSurface) {
  const Buffers whole = test::noisy_frame(rect_of(kSize));
  Buffers bare = test::noisy_frame(rect_of(kSize));
  for (PlaneId absent : {PlaneId::kBelowDepth, PlaneId::kSurfaceDepth}) {
    bare.frame.planes[index_of(absent)] = {};
  }
  const Buffers ending = noise_with_an_end();
  for (double height : {-1.0, -0.2, -0.05, -0.01, 0.0, 0.01, 0.05, 0.2, 1.0}) {
    const Scene scene = scene_at(height, -0.1, {kWave});
    std::size_t values = 0;
    const std::size_t far_ending = differences(ending.frame, scene, values);
    const std::size_t far = differences(whole.frame, scene, values);
    const std::size_t far_bare = differences(bare.frame, scene, values);
    // For an eye in the calm plane, rounding decides whether a ray meets the plane.
    if (height == 0) continue;
    // So low over the water a ray crosses many texels of the noise in a short path: floats are off
    // by 1e-4 there, and at the edge of two texels or at the waterline either side may be taken.
    EXPECT_LE(far_ending, values / 2000) << height;
    // A third of this noise has no surface: half of a texel's weight decides, too, whether a ray
    // has an end and whether an object hides the end; all values of the pixel follow.
    EXPECT_LE(far, values / 90) << height;
    EXPECT_LE(far_bare, values / 90) << height;
  }
}

}  // namespace
}  // namespace limpid
