#include "complete/heights.h"

#include <gtest/gtest.h>

#include "limpid/core/simd.h"

#include "ops/refraction_kernel.h"
#include "plan/landscape.h"
#include "plan/survey_scan.h"

namespace limpid {
namespace {

using test::Below;
using test::Buffers;
using test::kInf;
using test::landscape;
using test::noise;

Look marching_look() {
  Look look;  // the physical models
  look.of<Refraction>().steps = Refraction::kMarch;
  return look;
}

/// The heights of one frame, with its plan and pass.
struct Measured {
  Measured(const Buffers& buffers, const Scene& scene, const Look& look = marching_look(),
           const std::string& simd = {})
      : frame(buffers.frame),
        plan(make_plan(look, test::inputs_of(frame, scene), test::all_state())),
        pass(scene, frame, look.water.ior, plan.made),
        seen(SeenPlanes::of(pass).depth) {
    heights.make(plan, frame, pass, *make_executor(2), simd);
  }
  const HeightBound& bound() const { return heights.bound(); }

  /// Least and greatest height at which a ray through a texel sees the surface there.
  Range heights_at(int x, int y) const {
    Range range{HUGE_VAL, -HUGE_VAL};
    for (const double at_x : {x + 0.0, x + 0.5, x + 1.0}) {
      for (const double at_y : {y + 0.0, y + 0.5, y + 1.0}) {
        const glm::dvec2 p(at_x - pass.corner.x, at_y - pass.corner.y);
        const glm::dvec3 from =
            pass.rays.origin + p.x * pass.rays.origin_dx + p.y * pass.rays.origin_dy;
        const glm::dvec3 to = pass.rays.ray_at(p.x, p.y);
        const double under = glm::dot(pass.up, to);
        const double height =
            pass.eye_above + glm::dot(pass.up, from) + double{frame.plane(seen).at(x, y)} * under;
        range = {std::min(range.min, height), under < 0 ? std::max(range.max, height) : HUGE_VAL};
      }
    }
    return range;
  }
  SeenHeights of(const Rect& box) const {
    return bound().of(box.x0, box.y0, box.x1 - 1, box.y1 - 1);
  }
  /// As SeenHeights::deepest, texel by texel.
  double deepest(const Rect& box) const {
    double deepest = -HUGE_VAL;
    for (int y = box.y0; y < box.y1; ++y) {
      for (int x = box.x0; x < box.x1; ++x) {
        if (!(frame.plane(seen).at(x, y) < 1e30f)) return HUGE_VAL;
        deepest = std::max(deepest, -heights_at(x, y).min);
      }
    }
    return deepest;
  }
  /// As SeenHeights::highest, texel by texel.
  double highest(const Rect& box) const {
    double highest = -HUGE_VAL;
    for (int y = box.y0; y < box.y1; ++y) {
      for (int x = box.x0; x < box.x1; ++x) {
        if (!(frame.plane(seen).at(x, y) < 1e30f)) continue;
        const Range here = heights_at(x, y);
        if (here.min <= bound().most) highest = std::max(highest, here.max);
      }
    }
    return highest;
  }

  Frame frame;
  Plan plan;
  Pass pass;
  PlaneId seen;
  Heights heights;
};

/// A box in a window, of any size.
Rect any_box(const Rect& window, int seed) {
  const auto side = [&](int low, int high, int channel) {
    const double a = low + double{noise(seed, channel, 31)} * (high - low);
    const double b = a + double{noise(seed, channel, 32)} * noise(seed, channel, 33) * (high - a);
    return std::pair{static_cast<int>(a), std::min(static_cast<int>(b) + 1, high)};
  };
  const auto [x0, x1] = side(window.x0, window.x1, 0);
  const auto [y0, y1] = side(window.y0, window.y1, 1);
  return {x0, y0, x1, y1};
}

std::vector<Scene> scenes_for(Size size) {
  Scene level = test::simple_scene(size), across = level, tilted = level, high = level;
  across.camera->projection = orthographic(4, 3, 0.1, 100, ClipSpace::kGl);
  tilted.camera->view = glm::lookAt(glm::dvec3(1, 0, 3), glm::dvec3(0, 5, 1), glm::dvec3(1, 0, 2));
  tilted.water = WaterPlane{{0, 0, 1}, 0.5};
  high.camera->view = glm::lookAt(glm::dvec3(0, 1e4, 0), glm::dvec3(0, 0, -2e4), {0, 1, 0});
  high.camera->projection =
      perspective(0.5, double(size.width) / size.height, 1, 1e9, ClipSpace::kReversed);
  return {level, across, tilted, high};
}

TEST(Heights, NothingThatIsSeenStandsHigher) {
  int seed = 0, empty = 0, finite = 0;
  for (const Size size : {Size{1, 1}, Size{33, 17}, Size{150, 90}}) {
    for (const Scene& scene : scenes_for(size)) {
      for (const bool surface : {false, true}) {
        for (const Below below : {Below::kNone, Below::kWhole, Below::kHoles, Below::kEmpty}) {
          const Buffers b = landscape(rect_of(size), scene, ++seed, surface, below);
          for (const std::string& simd : simd_targets()) {
            const Measured m(b, scene, marching_look(), simd);
            ASSERT_TRUE(m.bound().known);
            const Rect& window = m.frame.plane(m.seen).window;
            for (int i = 0; i < 30; ++i) {
              const Rect box = any_box(window, 100 * seed + i);
              const double highest = m.highest(box);
              const SeenHeights bound = m.of(box);
              ASSERT_GE(bound.highest, highest) << seed << " " << simd;
              ASSERT_GE(bound.deepest, m.deepest(box)) << seed << " " << simd;
              empty += bound.highest < -1e30f;
              finite += std::isfinite(bound.highest);
            }
          }
        }
      }
    }
  }
  EXPECT_GT(empty, 100);
  EXPECT_GT(finite, 1000);
}

/// Of a basin 1.5 deep the heights are right within the height of a texel.
TEST(Heights, AreNotFarAbove) {
  const Size size{320, 200};
  const Scene scene = test::simple_scene(size);
  Buffers b(rect_of(size));
  const Pass pass(scene, b.frame, 1.333, {});
  for (int c = 0; c < 3; ++c) b.fill(plane_after(PlaneId::kColorR, c), 0.5f);
  b.set(PlaneId::kDepth, [&](int x, int y) {
    const RowRays<double> rays(pass, y + 0.5);
    return static_cast<float>(rays.calm_depth(x + 0.5) * (2 + 1.5) / 2);
  });
  const Measured m(b, scene);
  const SeenHeights whole = m.of({0, 96, 320, 200}), part = m.of({40, 184, 61, 191});
  EXPECT_NEAR(whole.highest, -1.5, 0.1);
  EXPECT_NEAR(part.highest, -1.5, 0.03);
  EXPECT_GE(whole.highest, part.highest);
  EXPECT_NEAR(whole.deepest, 1.5, 0.1);
  EXPECT_NEAR(part.deepest, 1.5, 0.03);
  // The bottom lies at 0.4 of the path to the covered height: within the same errors.
  const double share = Kernel<Refraction>::kShareOfPath;
  EXPECT_NEAR(part.covers, -1.5 / share, 0.1);
  // Under water that stands 0.3 higher the path to the bottom is 1.8 deep.
  b.set(PlaneId::kSurfaceDepth, [&](int x, int y) {
    const RowRays<double> rays(pass, y + 0.5);
    return static_cast<float>(rays.calm_depth(x + 0.5) * (2 - 0.3) / 2);
  });
  EXPECT_NEAR(Measured(b, scene).of({40, 184, 61, 191}).covers, 0.3 - 1.8 / share, 0.1);
}

/// A picture on its side gives the same errors as an upright picture.
TEST(Heights, AreAsSureHoweverTheCameraIsRolled) {
  const Size size{200, 200};
  Scene scene = test::simple_scene(size);
  const HeightError level = calm_error(WaterView(scene, rect_of(size)));
  scene.camera->view = glm::rotate(glm::dmat4(1), std::numbers::pi / 2, {0, 0, 1}) *
                       scene.camera->view;  // the picture's top is on the left
  const HeightError rolled = calm_error(WaterView(scene, rect_of(size)));
  EXPECT_NEAR(rolled.over / level.over, 1, 1e-5);
  EXPECT_NEAR(rolled.under / level.under, 1, 1e-5);
}

TEST(Heights, WhatStandsHigherThanTheWaterDoesNotCount) {
  const Size size{64, 32};
  const Scene scene = test::simple_scene(size);
  Buffers b(rect_of(size));
  for (int c = 0; c < 3; ++c) b.fill(plane_after(PlaneId::kColorR, c), 0.5f);
  b.fill(PlaneId::kDepth, 0.5f);  // the camera is 2 above the water
  EXPECT_EQ(Measured(b, scene).of({0, 0, 64, 32}).highest, -kInf);
  EXPECT_EQ(Measured(b, scene).of({0, 0, 64, 32}).covers, kInf);
}

/// The depths are those that a mirrored ray may hit where the ray is marched over the picture
/// itself, and no others: the ray does not hit surfaces under the calm water.
TEST(Heights, DepthsOfWhatTheMirrorMayHit) {
  const Size size{64, 32};
  const Scene scene = test::simple_scene(size);
  Buffers b(rect_of(size));
  for (int c = 0; c < 3; ++c) b.fill(plane_after(PlaneId::kColorR, c), 0.5f);
  b.set(PlaneId::kDepth, [&](int x, int y) { return y < 8 ? kInf : x < 16 ? 0.5f : 500.0f; });
  Look look = marching_look();
  look.of<FresnelReflection>().source = FresnelReflection::Source::kAuto;
  const Measured m(b, scene, look);
  const RangeBound& mirrored = m.heights.mirrored();
  ASSERT_TRUE(mirrored.known);
  EXPECT_EQ(mirrored.plane, PlaneId::kDepth);
  EXPECT_EQ(mirrored.of(0, 0, 15, 7).low, kInf);
  EXPECT_EQ(mirrored.of(0, 0, 15, 7).high, -kInf);
  EXPECT_EQ(mirrored.of(0, 8, 15, 31).low, 0.5f);
  EXPECT_EQ(mirrored.of(0, 8, 15, 31).high, 0.5f);
  EXPECT_EQ(mirrored.of(16, 24, 63, 31).low, kInf);  // deep under the water
  EXPECT_EQ(mirrored.of(0, 24, 63, 31).low, 0.5f);
}

TEST(Heights, NothingIsKnownWhereNothingAsks) {
  const Size size{40, 30};
  Scene scene = test::simple_scene(size);
  const Buffers b = landscape(rect_of(size), scene, 1, false, Below::kNone);
  Look look = marching_look();
  look.of<Refraction>().steps = 4;
  EXPECT_FALSE(Measured(b, scene, look).bound().known);
  look.of<Refraction>() = {.model = Refraction::Model::kNormalOffset, .strength = 0.1};
  EXPECT_FALSE(Measured(b, scene, look).bound().known);
  EXPECT_TRUE(Measured(b, scene).bound().known);
  scene.water->height = 3;  // over the camera
  EXPECT_FALSE(Measured(b, scene).bound().known);
  scene = test::simple_scene(size);
  scene.camera->projection = orthographic(4, 3, 0.1, 100, ClipSpace::kGl);
  EXPECT_TRUE(Measured(b, scene).bound().known);
  scene.camera->view = glm::lookAt(glm::dvec3(0, -3, 0), glm::dvec3(0, 0, -1), glm::dvec3(0, 1, 0));
  EXPECT_FALSE(Measured(b, scene).bound().known);
}

}  // namespace
}  // namespace limpid
