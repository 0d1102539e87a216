#include <cstring>

#include <gtest/gtest.h>

#include "limpid/core/simd.h"
#include "limpid/load/look_file.h"

#include "plan/landscape.h"

/// A march that leaves out looks (FusedOptions::leaps) against one that does not.

namespace limpid {
namespace {

using test::Below;
using test::Buffers;

/// Of shallow, wavy and murky water, whatever patchy_look() says, but marching.
Look marching_look(int seed) {
  Look look = test::patchy_look(seed);
  Refraction::Params& refraction = look.of<Refraction>();
  refraction.model = Refraction::Model::kSnell;
  refraction.steps = Refraction::kMarch;
  if (seed % 2 == 0) refraction.rejection = Refraction::Rejection::kShorten;
  return look;
}

/// How many of the numbers of the picture are others with leaps.
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

INSTANTIATE_TEST_SUITE_P(Simd, Leaps, testing::ValuesIn(simd_targets()),
                         [](const auto& of) { return of.param; });

}  // namespace
}  // namespace limpid
