#include <gtest/gtest.h>

#include "limpid/raster/render_plate.h"

#include "judge/trace/trace_scenes.h"
#include "support.h"

/// The chain beside the truth, in scenes where the chain's simplifications do not matter.

namespace limpid::test {
namespace {

constexpr Size kSize{48, 36};

/// The default look on calm water.
Look physical() {
  Look look;
  look.of<WaveNormals>().strength = 0;
  look.of<FresnelReflection>().source = FresnelReflection::Source::kPlanar;
  return look;
}

struct Both {
  Picture chain;
  TruthPicture truth;
};

/// Chain and truth of a picture whose plate has overscan, so that few rays leave the plate.
Both both(const Model& model, const Scene& scene, const Look& look, const Texture& wave_map = {}) {
  const auto executor = make_executor(1);
  RenderedPlate plate = render_plate(model, scene, {.size = kSize, .overscan = 24},
                                     renderable(model, scene), *executor);
  plate.frame.wave_map = wave_map;
  TruthOptions options = every_aov(kSize);
  options.wave_map = wave_map;
  return {reference(look, plate.frame, scene), traced(model, scene, look, options)};
}

/// A plain floor, a wall behind the water, all in the sun.
Model sunny_pool() {
  Mesh wall = quad({-60, 0, -25}, {60, 0, -25}, {60, 9, -25}, {-60, 9, -25});
  wall.uvs.clear();
  Model model = model_of({level(-1.2), wall}, lambert({0.8, 0.6, 0.4}));
  model.background = {0.3, 0.5, 0.9};
  return model;
}

Scene sunny(double degrees) {
  Scene scene = over_water(degrees, kSize);
  scene.sun->direction = glm::normalize(glm::dvec3(0.3, 0.8, 0.6));
  return scene;
}

TEST(ChainBesideTruth, AgreesOnCalmWaterOverALevelFloor) {
  for (double gain : {0.0, 1.0}) {
    Look look = physical();
    look.of<PrismSplit>().gain = gain;
    const Scene scene = sunny(35);
    const Both b = both(sunny_pool(), scene, look);
    int judged = 0;
    for_each_pixel(kSize, [&](int x, int y) {
      if (std::isinf(value(b.truth, Aov::kSurfaceDepth, x, y))) return;
      if (b.chain.aov(Aov::kConfidence, x, y) < 1) return;
      ++judged;
      for (Aov aov : {Aov::kTransmitted, Aov::kInScatter, Aov::kReflected, Aov::kHighlight}) {
        for (int c = 0; c < 3; ++c) {
          const double got = b.chain.aov(aov, x, y, c), right = value(b.truth, aov, x, y, c);
          // The chain uses one index for everything except directions.
          EXPECT_NEAR(got, right, gain == 0 ? 2e-5 : 0.025 * right + 2e-5);
        }
      }
      EXPECT_NEAR(b.chain.aov(Aov::kPath, x, y), value(b.truth, Aov::kPath, x, y), 2e-4);
      EXPECT_NEAR(b.chain.aov(Aov::kFresnel, x, y), value(b.truth, Aov::kFresnel, x, y), 1e-6);
      for (Aov map : {Aov::kStmapR, Aov::kStmapG, Aov::kStmapB}) {
        EXPECT_NEAR(kSize.width * (b.chain.aov(map, x, y, 0) - value(b.truth, map, x, y, 0)), 0,
                    0.02);
        EXPECT_NEAR(kSize.height * (b.chain.aov(map, x, y, 1) - value(b.truth, map, x, y, 1)), 0,
                    0.02);
      }
    });
    EXPECT_GT(judged, 800);
  }
}

TEST(ChainBesideTruth, AgreesOnTheWavesOfAWind) {
  const NoiseMap map(8, 8);
  for (const WaveNormals::Model model :
       {WaveNormals::Model::kSlopes, WaveNormals::Model::kFourMaps, WaveNormals::Model::kTwoFlows,
        WaveNormals::Model::kDudv}) {
    Look look = physical();
    look.of<WaveNormals>().model = model;
    look.of<WaveNormals>().strength = 1;
    look.of<WaveNormals>().wind = 3;
    Scene scene = sunny(50);
    scene.time = 2.7;
    const Both b = both(sunny_pool(), scene, look, map.texture);
    double steepest = 0;
    int judged = 0;
    for_each_pixel(kSize, [&](int x, int y) {
      if (b.chain.aov(Aov::kConfidence, x, y) < 1) return;
      ++judged;
      for (int c = 0; c < 3; ++c) {
        const double right = value(b.truth, Aov::kNormal, x, y, c);
        EXPECT_NEAR(b.chain.aov(Aov::kNormal, x, y, c), right, 1e-6);
        if (c == 0) steepest = std::max(steepest, std::abs(right));
      }
    });
    EXPECT_GT(judged, 500);
    EXPECT_GT(steepest, 0.1);
  }
}

TEST(ChainBesideTruth, AgreesOnWhichWayAMapsWavesBendTheView) {
  const NoiseMap map(8, 8);
  Look look = physical();
  look.of<PrismSplit>().gain = 0;
  look.of<WaveNormals>().strength = 0.3;
  const Scene scene = sunny(50);
  const Both b = both(sunny_pool(), scene, look, map.texture);
  int judged = 0;
  for_each_pixel(kSize, [&](int x, int y) {
    if (b.chain.aov(Aov::kConfidence, x, y) < 1) return;
    ++judged;
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(b.chain.aov(Aov::kNormal, x, y, c), value(b.truth, Aov::kNormal, x, y, c), 1e-6);
    }
    EXPECT_NEAR(b.chain.aov(Aov::kFresnel, x, y), value(b.truth, Aov::kFresnel, x, y), 1e-6);
    EXPECT_NEAR(
        kSize.width * (b.chain.aov(Aov::kStmapG, x, y, 0) - value(b.truth, Aov::kStmapG, x, y, 0)),
        0, 0.1);
    EXPECT_NEAR(
        kSize.height * (b.chain.aov(Aov::kStmapG, x, y, 1) - value(b.truth, Aov::kStmapG, x, y, 1)),
        0, 0.1);
    EXPECT_NEAR(b.chain.aov(Aov::kHighlight, x, y), value(b.truth, Aov::kHighlight, x, y), 1e-5);
  });
  EXPECT_GT(judged, 800);
}

/// Without waves, the reflection is the picture that mirrored rays see.
TEST(ChainBesideTruth, AgreesOnWhatCalmWaterMirrors) {
  const Scene scene = sunny(10);
  Look look = physical();
  look.of<PrismSplit>().gain = 0;
  const Both b = both(sunny_pool(), scene, look);
  int wall = 0, sky = 0;
  for_each_pixel(kSize, [&](int x, int y) {
    const glm::dvec3 d = view_through(scene, x, y, kSize);
    if (std::isinf(value(b.truth, Aov::kSurfaceDepth, x, y)) || d.y > -0.02) return;
    const glm::dvec3 eye = scene.camera->eye();
    const double height = -d.y / -d.z * (25 + eye.z) - eye.y;  // of the mirrored ray at the wall
    if (std::abs(height - 9) < 0.5 || std::abs(height) < 0.2) return;
    const bool meets = height > 0 && height < 9;
    (meets ? wall : sky) += 1;
    const double f = value(b.truth, Aov::kFresnel, x, y);
    const double mirrored = value(b.truth, Aov::kReflected, x, y, 2) / f;
    const double sunlit = 0.4 * (0.2 + scene.sun->direction.z * 2);
    EXPECT_NEAR(mirrored, meets ? sunlit : 0.9, 1e-5);
    EXPECT_NEAR(b.chain.aov(Aov::kReflected, x, y, 2), value(b.truth, Aov::kReflected, x, y, 2),
                1e-5);
  });
  EXPECT_GT(wall, 200);
  EXPECT_GT(sky, 100);
}

}  // namespace
}  // namespace limpid::test
