#include "complete/plate_waves.h"

#include <cmath>
#include <numbers>

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "op/pass.h"
#include "optics/waves.h"
#include "support.h"

namespace limpid {
namespace {

using test::Buffers;

constexpr Size kSize{96, 64};
constexpr double kWidth = 6, kHeight = 4;

/// A camera that looks straight down on 6 x 4 units of water at the height 1.
Scene seen_in_parallel() {
  Scene scene;
  const glm::dvec3 eye(3, 4, 2);
  scene.camera = Camera{glm::lookAt(eye, eye - glm::dvec3(0, 1, 0), {0, 0, -1}),
                        orthographic(kWidth, kHeight, 0.1, 100, ClipSpace::kGl), ClipSpace::kGl};
  scene.water = WaterPlane{{0, 1, 0}, 1};
  return scene;
}

/// A sine that repeats `across` times across the picture and `down` times down it.
SineWave wave(double amplitude, int across, int down, double phase) {
  const double turn = 2 * std::numbers::pi;
  return {amplitude, turn * across / kWidth, turn * down / kHeight, phase, 0};
}

/// The waves' normals on a plane, as in a renderer's bump map.
Buffers bumped(const Scene& scene, const std::vector<SineWave>& waves) {
  Buffers b(rect_of(kSize));
  b.fill(PlaneId::kDepth, 50);
  const Pass pass(scene, b.frame, 1.333, kWholeState);
  for (int i = 0; i < 3; ++i) {
    b.set(plane_after(PlaneId::kSurfaceNormalX, i), [&](int x, int y) {
      const glm::dvec3 p = pass.eye + pass.rays.origin_at(x + 0.5, y + 0.5);
      const WaveHeight at =
          wave_height(waves, glm::dot(pass.map_x, p), glm::dot(pass.map_y, p), scene.time);
      const glm::dvec3 n =
          glm::normalize(pass.up - at.slope_x * pass.map_x - at.slope_y * pass.map_y);
      return static_cast<float>(n[i]);
    });
  }
  return b;
}

PlateWaves waves_of(const Scene& scene, const Buffers& buffers) {
  return plate_waves_of(buffers.frame, Pass(scene, buffers.frame, 1.333, kWholeState));
}

TEST(PlateWaves, OfSinesAreThoseOfTheirNormals) {
  const Scene scene = seen_in_parallel();
  const std::vector<SineWave> waves{wave(0.03, 3, 1, 0.4), wave(0.02, -1, 4, 2)};
  WaterView view(scene, rect_of(kSize), {.raises = true, .waves = waves, .scale = 0.5});
  const PlateWaves of_sines = plate_waves_of_sines(view),
                   found = waves_of(scene, bumped(scene, waves));
  EXPECT_EQ(of_sines.raised, 1);
  EXPECT_NEAR(4 * of_sines.variance.xx, found.variance.xx, 0.02 * found.variance.xx);
  EXPECT_NEAR(4 * of_sines.variance.yy, found.variance.yy, 0.02 * found.variance.yy);
  EXPECT_NEAR(of_sines.turn.xx, found.turn.xx, 0.05 * found.turn.xx);
  EXPECT_NEAR(of_sines.turn.yy, found.turn.yy, 0.05 * found.turn.yy);
  EXPECT_EQ(plate_waves_of_sines(WaterView(scene, rect_of(kSize))).variance.xx, 0);
}

TEST(PlateWaves, SayHowSinesLeanAndTurn) {
  const Scene scene = seen_in_parallel();
  const std::vector<SineWave> waves{wave(0.03, 3, 1, 0.4), wave(0.02, -1, 4, 2)};
  const PlateWaves found = waves_of(scene, bumped(scene, waves));
  Sym2<double> variance{0, 0, 0}, turn{0, 0, 0};
  double whole = 0;
  for (const SineWave& w : waves) {
    const double half = 0.5 * w.amplitude * w.amplitude;
    const double energy = half * (w.k_x * w.k_x + w.k_y * w.k_y);
    const Sym2<double> square{w.k_x * w.k_x, w.k_x * w.k_y, w.k_y * w.k_y};
    variance = variance + half * square;
    turn = turn + energy * square;
    whole += energy;
  }
  turn = (1 / whole) * turn;
  // Over whole periods but for a row and a column; a sine's chord over a pixel is a little shorter.
  const double size = variance.xx + variance.yy, fast = turn.xx + turn.yy;
  EXPECT_NEAR(found.variance.xx, variance.xx, 0.02 * size);
  EXPECT_NEAR(found.variance.xy, variance.xy, 0.02 * size);
  EXPECT_NEAR(found.variance.yy, variance.yy, 0.02 * size);
  EXPECT_NEAR(found.turn.xx, turn.xx, 0.04 * fast);
  EXPECT_NEAR(found.turn.xy, turn.xy, 0.04 * fast);
  EXPECT_NEAR(found.turn.yy, turn.yy, 0.04 * fast);
  EXPECT_EQ(found.raised, 0);
}

TEST(PlateWaves, OfCalmOrHiddenWaterAreNone) {
  const Scene scene = seen_in_parallel();
  for (const float depth : {50.0f, 1.0f}) {
    Buffers calm = bumped(scene, {});
    calm.fill(PlaneId::kDepth, depth);
    const PlateWaves found = waves_of(scene, calm);
    EXPECT_EQ(found.variance.xx + found.variance.yy, 0);
    EXPECT_EQ(found.turn.xx + found.turn.yy, 0);
    EXPECT_EQ(found.raised, 0);
  }
}

// The water lies 3 under the eye; a depth in halves is off by at most a 2048th of that. From a
// 2000th of it to four times as much the water goes over from a plane to a raised surface.
TEST(PlateWaves, RaiseTheSurfaceBeyondWhatADepthIsOff) {
  const Scene scene = seen_in_parallel();
  const struct {
    double amplitude, raised;
  } waters[] = {{0, 0}, {0.0014, 0}, {0.003, 1.0 / 3}, {0.0045, 2.0 / 3}, {0.01, 1}};
  for (const auto& water : waters) {
    Buffers b = bumped(scene, {});
    b.set(PlaneId::kSurfaceDepth, [&](int x, int) {
      return static_cast<float>(3 + (x % 2 == 0 ? 1 : -1) * water.amplitude);
    });
    EXPECT_NEAR(waves_of(scene, b).raised, water.raised, 1e-3) << water.amplitude;
  }
}

/// The smoothness of a sea to the horizon with slopes of one direction, slope(distance, row).
template <class Slope>
double smoothness_of(const Slope& slope) {
  Scene scene;
  const glm::dvec3 eye(0, 2, 0);
  scene.camera = Camera{glm::lookAt(eye, eye - glm::dvec3(0, 0.3, 1), {0, 1, 0}),
                        perspective(0.6, 1.5, 0.1, 1e5, ClipSpace::kGl), ClipSpace::kGl};
  scene.water = WaterPlane{};
  Buffers b(rect_of({192, 128}));
  b.fill(PlaneId::kDepth, 1e6f);
  const Pass pass(scene, b.frame, 1.333, kWholeState);
  for (int i = 0; i < 3; ++i) {
    b.set(plane_after(PlaneId::kSurfaceNormalX, i), [&](int x, int y) {
      const glm::dvec3 ray = pass.rays.ray_at(x + 0.5, y + 0.5);
      const glm::dvec3 at = -2 / std::min(ray.y, -1e-9) * ray;
      return static_cast<float>(glm::normalize(glm::dvec3(0, 1, slope(at, y)))[i]);
    });
  }
  return waves_of(scene, b).smooth;
}

// Far waves that a pixel does not resolve have nothing in common with those of the next. Far waves
// of a coarse mesh, here a radian from row to row, have: cos(1) = 1 / (1 + x / 2) for x = 1.7,
// which stands for 4 and more.
TEST(PlateWaves, OfACoarseMeshAreSmooth) {
  const double steep = 0.05;
  const auto sine = [&](const glm::dvec3& at) { return steep * std::sin(2.1 * at.z + 0.3 * at.x); };
  EXPECT_LT(smoothness_of([&](const glm::dvec3& at, int) { return sine(at); }), 0.06);
  const double smooth = smoothness_of([&](const glm::dvec3& at, int row) {
    return at.z < -8 ? steep * std::sin(row + 0.01 * at.x) : sine(at);
  });
  EXPECT_GT(smooth, 1 / 1.7 - 1. / 4);
  EXPECT_LT(smooth, 1 / 1.7);
}

}  // namespace
}  // namespace limpid
