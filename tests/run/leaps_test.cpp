#include <cmath>
#include <cstring>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "limpid/core/simd.h"
#include "limpid/files/text/look_file.h"

#include "op/pass.h"
#include "plan/landscape.h"

/// A march that leaves out lookups (FusedOptions::leaps) against a march that does not.

namespace limpid {
namespace {

using test::Below;
using test::Buffers;

/// A marching look of shallow, wavy and murky water, whatever patchy_look() sets.
Look marching_look(int seed) {
  Look look = test::patchy_look(seed);
  Refraction::Params& refraction = look.of<Refraction>();
  refraction.model = Refraction::Model::kSnell;
  refraction.steps = Refraction::kMarch;
  if (seed % 2 == 0) refraction.rejection = Refraction::Rejection::kShorten;
  return look;
}

/// The count of the picture's numbers that change with leaps.
std::size_t others(const Look& look, const Frame& frame, const Scene& scene,
                   const std::string& simd) {
  const std::vector<float> with = test::fused(look, frame, scene, {.simd = simd}).values();
  const std::vector<float> without =
      test::fused(look, frame, scene, {.simd = simd, .leaps = false}).values();
  std::size_t count = 0;
  for (std::size_t i = 0; i < with.size(); ++i) {
    count += std::memcmp(&with[i], &without[i], sizeof(float)) != 0;
  }
  return count;
}

class Leaps : public testing::TestWithParam<std::string> {};

TEST_P(Leaps, ChangeNotABitOfLandscapes) {
  int seed = 0;
  for (const Size size : {Size{7, 5}, Size{131, 67}, Size{300, 200}}) {
    for (const double pitch : {0.1, 0.5, 1.2}) {
      Scene scene = test::simple_scene(size);
      scene.camera->view = glm::lookAt(
          glm::dvec3(0, 2, 0), glm::dvec3(0.1, 2 - std::sin(pitch), -std::cos(pitch)), {0, 1, 0});
      for (const bool surface : {false, true}) {
        for (const Below below : {Below::kNone, Below::kWhole, Below::kHoles, Below::kEmpty}) {
          ++seed;
          const Buffers b = test::landscape(rect_of(size), scene, seed, surface, below);
          EXPECT_EQ(others(marching_look(seed), b.frame, scene, GetParam()), 0u) << seed;
        }
      }
    }
  }
}

/// Marched over the depth of the mirrored scene, and over the picture itself.
TEST_P(Leaps, ChangeNotABitOfMirrorsAndShadows) {
  int seed = 0;
  for (const Size size : {Size{131, 67}, Size{300, 200}}) {
    for (const double pitch : {0.1, 0.5}) {
      Scene scene = test::simple_scene(size);
      scene.camera->view = glm::lookAt(
          glm::dvec3(0, 2, 0), glm::dvec3(0.1, 2 - std::sin(pitch), -std::cos(pitch)), {0, 1, 0});
      scene.sun = Sun{glm::normalize(glm::dvec3(0.4, 0.7, -0.3)), {3, 3, 3}};
      for (const bool reflection : {false, true}) {
        for (const Below below : {Below::kNone, Below::kWhole}) {
          ++seed;
          Buffers b = test::landscape(rect_of(size), scene, seed, seed % 3 == 0, below);
          b.set(PlaneId::kSurfaceShadow,
                [&](int x, int y) { return test::patch(x, y, seed) < 0.4f ? 0.3f : 1.0f; });
          for (int c = 0; c < 3 && !reflection; ++c) {
            b.frame.planes[index_of(plane_after(PlaneId::kReflectionR, c))] = {};
          }
          Look look = marching_look(2 * seed);
          look.of<FresnelReflection>() = {.source = FresnelReflection::Source::kAuto};
          look.of<DepthFog>() = {};
          look.of<WaterShadow>() = {};
          EXPECT_EQ(others(look, b.frame, scene, GetParam()), 0u) << seed;
        }
      }
    }
  }
}

TEST_P(Leaps, ChangeNotABitOfNoise) {
  for (int seed = 0; seed < 40; ++seed) {
    const Rect display = test::patchy_display(seed);
    const Buffers b = test::patchy_frame(display, seed);
    EXPECT_EQ(others(marching_look(seed), b.frame, test::patchy_scene(display), GetParam()), 0u)
        << seed;
  }
}

TEST_P(Leaps, ChangeNotABitWhereNumbersAreLargeOrSmall) {
  const Size size{160, 90};
  int seed = 100;
  for (const double scale : {1e-3, 1e3, 1e5}) {
    for (const bool orthographic_too : {false, true}) {
      Scene scene = test::simple_scene(size);
      scene.camera->view = glm::lookAt(glm::dvec3(0, 2 * scale, 0), glm::dvec3(0, 0, -4 * scale),
                                       glm::dvec3(0, 1, 0));
      scene.camera->projection =
          orthographic_too
              ? orthographic(8 * scale, 4.5 * scale, 0.1 * scale, 100 * scale, ClipSpace::kGl)
              : perspective(0.9, 16.0 / 9, 0.1 * scale, 1e4 * scale, ClipSpace::kGl);
      scene.water->height = 0.3 * scale;
      ++seed;
      const Buffers b = test::landscape(rect_of(size), scene, seed, seed % 2 == 0, Below::kNone);
      EXPECT_EQ(others(marching_look(seed), b.frame, scene, GetParam()), 0u) << scale;
    }
  }
}

/// Sets a plane to the eye depths of a surface with the heights `height_of(x, y)` over the calm
/// surface.
template <class HeightOf>
void set_heights(Buffers& b, const Scene& scene, PlaneId plane, Rect window, HeightOf&& height_of) {
  const Pass pass(scene, b.frame, 1.333, {});
  b.set(
      plane,
      [&](int x, int y) {
        const glm::dvec3 ray = pass.rays.ray_at(x + 0.5 - pass.corner.x, y + 0.5 - pass.corner.y);
        const double under = glm::dot(pass.up, ray), height = height_of(x, y);
        return under < 0 && std::isfinite(height)
                   ? static_cast<float>((height - pass.eye_above) / under)
                   : test::kInf;
      },
      window);
}

/// Low tide: all rendered water is below the calm level, which counts as the surface where no water
/// is rendered.
TEST_P(Leaps, ChangeNotABitWhereWaterIsLowerThanCalm) {
  const Size size{200, 120};
  const Scene scene = test::simple_scene(size);
  for (const int overscan : {0, 30}) {
    for (const double bank : {-0.05, 0.05}) {
      Buffers b = test::landscape(rect_of(size), scene, 1, false, Below::kWhole);
      const auto ashore = [](int x, int y) { return x > 150 || y < 20; };
      set_heights(b, scene, PlaneId::kSurfaceDepth, rect_of(size),
                  [&](int x, int y) { return ashore(x, y) ? HUGE_VAL : -0.1; });
      set_heights(b, scene, PlaneId::kBelowDepth,
                  Rect{-overscan, -overscan, size.width + overscan, size.height + overscan},
                  [&](int x, int y) { return ashore(x, y) ? bank : HUGE_VAL; });
      for (int seed = 0; seed < 6; ++seed) {
        Look look = marching_look(2 * seed);
        look.of<PrismSplit>().gain = 20;
        EXPECT_EQ(others(look, b.frame, scene, GetParam()), 0u) << overscan << " " << bank;
      }
    }
  }
}

/// Large products cancel in heights that are small.
TEST_P(Leaps, ChangeNotABitInNarrowViewsOfTiltedWater) {
  const Size size{200, 120};
  for (int seed = 0; seed < 12; ++seed) {
    const auto any = [&](int channel) { return double{test::noise(seed, channel, 71)} - 0.5; };
    Scene scene = test::simple_scene(size);
    const glm::dvec3 up = glm::normalize(glm::dvec3(any(0), any(1), any(2)));
    const PlaneAxes axes = plane_axes(up);
    scene.water = WaterPlane{up, 100 * any(3)};
    const glm::dvec3 eye = (scene.water->height + 2) * up;
    const double fov = seed % 2 == 0 ? 0.01 : 0.002;
    scene.camera->view = glm::lookAt(eye, eye + axes.x - (0.6 * fov + 0.002) * up, up);
    scene.camera->projection = perspective(fov, 5.0 / 3, 0.1, 1e5, ClipSpace::kGl);
    const Below below = seed % 3 == 0 ? Below::kHoles : Below::kNone;
    const Buffers b = test::landscape(rect_of(size), scene, seed, seed % 4 == 0, below);
    EXPECT_EQ(others(marching_look(seed), b.frame, scene, GetParam()), 0u) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Simd, Leaps, testing::ValuesIn(simd_targets()),
                         [](const auto& of) { return of.param; });

}  // namespace
}  // namespace limpid
