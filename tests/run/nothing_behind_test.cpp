#include <cmath>
#include <cstring>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "limpid/files/text/look_file.h"

#include "paths.h"
#include "support.h"

// Water without a bottom in the fused pass, with the bundled looks.

namespace limpid {
namespace {

constexpr Size kSize{300, 80};
constexpr float kSky = 100;

/// A bottom with gaps of 3 x 3 pixels here and there, where the dry picture shows a sky, if `gaps`;
/// over the horizon a sky, if `horizon`.
struct Sea {
  Sea(bool gaps, bool horizon) : map(16, 8), sky(12, 6), buffers(rect_of(kSize)) {
    scene = test::simple_scene(kSize);
    const Rays rays = rays_of(*scene.camera, {kSize.width, kSize.height});
    const auto depth = [&](int x, int y) {
      const double z = -3 / rays.ray_at(x + 0.5, y + 0.5).y;
      const bool gap = gaps && y > 30 && test::noise(x / 3, y / 3, 3) < 0.1f;
      if (z < 0) return horizon ? test::kInf : 1e5f;
      return gap ? test::kInf : static_cast<float>(z);
    };
    for (int c = 0; c < 3; ++c) {
      buffers.set(plane_after(PlaneId::kColorR, c), [&](int x, int y) {
        return std::isinf(depth(x, y)) ? kSky : 0.5f * test::noise(x / 2, y / 2, c);
      });
    }
    buffers.set(PlaneId::kDepth, depth);
    buffers.frame.wave_map = map.texture;
    buffers.frame.environment = sky.texture;
  }
  test::NoiseMap map, sky;
  test::Buffers buffers;
  Scene scene;
};

Look shipped(const std::string& name) {
  const std::filesystem::path folders[] = {std::filesystem::path(LIMPID_DATA) / "looks"};
  return look_named(name, folders);
}

constexpr const char* kLooks[] = {"physical", "fast", "realistic", "monogame", "rito"};

TEST(NothingBehindFused, AgreesWithTheReferenceAndShowsNoSky) {
  const Sea sea(true, true);
  for (const char* name : kLooks) {
    const Look look = shipped(name);
    const test::Picture judge = test::reference(look, sea.buffers.frame, sea.scene);
    for (const std::string& simd : simd_targets()) {
      const test::Picture got = test::fused(look, sea.buffers.frame, sea.scene, {.simd = simd});
      int far = 0, wet = 0;
      for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x) {
          if (std::isinf(got.aov(Aov::kSurfaceDepth, x, y))) continue;
          ++wet;
          ASSERT_LE(got.aov(Aov::kTransmitted, x, y), 1) << name << " at " << x << ", " << y;
          far += std::abs(got.color(x, y).r - judge.color(x, y).r) > 1e-3;
        }
      }
      EXPECT_GT(wet, 1000);
      EXPECT_LT(far, wet / 200) << name << ", " << simd
                                << ": a lookup between two texels may round";
    }
  }
}

/// Away from the gaps no pixel changes: a cell that has no gap in its reach computes the same bits
/// as without gaps.
TEST(NothingBehindFused, ASkyBesideTheWaterChangesNoBitOfIt) {
  for (const char* name : {"physical", "fast", "realistic", "monogame"}) {
    const Sea with(false, true), without(false, false);
    const Look look = shipped(name);
    const test::Picture a = test::fused(look, with.buffers.frame, with.scene);
    const test::Picture b = test::fused(look, without.buffers.frame, without.scene);
    int same = 0;
    for (int y = 60; y < kSize.height; ++y) {
      for (int x = 0; x < kSize.width; ++x) {
        const Rgb<double> p = a.color(x, y), q = b.color(x, y);
        ASSERT_TRUE(p.r == q.r && p.g == q.g && p.b == q.b) << name << " at " << x << ", " << y;
        ++same;
      }
    }
    EXPECT_GT(same, 1000);
  }
}

TEST(NothingBehindFused, BoundsHoldWithAMaximumError) {
  const Sea sea(true, true);
  for (const char* name : kLooks) {
    const Look look = shipped(name);
    const Inputs inputs = test::inputs_of(sea.buffers.frame, sea.scene);
    test::Picture exact(sea.buffers.frame.work()), cheap(sea.buffers.frame.work());
    const auto executor = make_executor(1);
    run_fused(make_plan(look, inputs), sea.buffers.frame, sea.scene, exact.target, *executor);
    const double error = 0.05;
    run_fused(make_plan(look, inputs, {}, error), sea.buffers.frame, sea.scene, cheap.target,
              *executor);
    for (int y = 0; y < kSize.height; ++y) {
      for (int x = 0; x < kSize.width; ++x) {
        ASSERT_NEAR(exact.color(x, y).r, cheap.color(x, y).r, error + 1e-5)
            << name << " at " << x << ", " << y;
      }
    }
  }
}

}  // namespace
}  // namespace limpid
