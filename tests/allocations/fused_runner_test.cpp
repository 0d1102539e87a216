#include <gtest/gtest.h>

#include "limpid/run/fused.h"

#include "allocations/count.h"
#include "support.h"

namespace limpid {
namespace {

using test::Buffers;

TEST(Allocations, AreCounted) {
  const int before = test::allocations();
  const Plane plane({0, 0, 8, 8});
  EXPECT_GT(test::allocations(), before);
}

/// Memory is allocated in the first run of a size; later runs allocate none, whatever the look, the
/// budget and the threads.
TEST(Allocations, NoneAfterTheFirstFrame) {
  const Size size{301, 77};
  Buffers b = test::noisy_frame(rect_of(size));
  const test::NoiseMap map(16, 8);
  b.frame.wave_map = map.texture;
  Scene scene = test::simple_scene(size);
  scene.water->waves = {{0.05, 1, 0.5, 0, 2}, {0.03, 0.2, 2, 1, 3}};
  const test::Picture picture(b.frame.work());
  for (const Look& look : {Look{}, test::article_look()}) {
    for (const double max_error : {0.0, 0.01}) {
      const Plan plan = make_plan(look, test::inputs_of(b.frame, scene), kWholeState, max_error);
      for (const int threads : {1, 2}) {
        const auto executor = make_executor(threads);
        FusedRunner runner;
        RunTimes times;
        runner.run(plan, b.frame, scene, picture.target, *executor, {.times = &times});
        const int before = test::allocations();
        for (int frame = 0; frame < 3; ++frame) {
          scene.time += 0.04;
          runner.run(plan, b.frame, scene, picture.target, *executor, {.times = &times});
        }
        EXPECT_EQ(test::allocations(), before)
            << look.name << ", max_error " << max_error << ", " << threads << " threads";
      }
    }
  }
}

/// Runs do not allocate for a surface that is made where the frame has none, either.
TEST(Allocations, NoneForWaterThatWavesRaise) {
  const Size size{301, 77};
  Buffers b = test::noisy_frame(rect_of(size));
  b.frame.planes[index_of(PlaneId::kSurfaceDepth)] = {};
  b.frame.planes[index_of(PlaneId::kSurfaceNormalX)] = {};
  Scene scene = test::simple_scene(size);
  scene.water->waves = {{0.05, 1, 0.5, 0, 2}, {0.03, 0.2, 2, 1, 3}};
  Look look = test::article_look();
  look.of<WaveNormals>().model = WaveNormals::Model::kSines;
  const test::Picture picture(b.frame.work());
  const Plan plan = make_plan(look, test::inputs_of(b.frame, scene));
  ASSERT_TRUE(plan.completed.has(PlaneId::kSurfaceDepth));
  const auto executor = make_executor(2);
  FusedRunner runner;
  runner.run(plan, b.frame, scene, picture.target, *executor);
  const int before = test::allocations();
  for (int frame = 0; frame < 3; ++frame) {
    scene.time += 0.04;
    runner.run(plan, b.frame, scene, picture.target, *executor);
  }
  EXPECT_EQ(test::allocations(), before);
}

/// Nor for shadows that tell of the sun's light, and waves that only normals tell, however many
/// edges they have: there are none in the first frame.
TEST(Allocations, NoneForWhatALaterFrameTells) {
  const Size size{301, 77};
  Buffers b = test::noisy_frame(rect_of(size));
  for (int c = 0; c < 3; ++c) b.frame.planes[index_of(plane_after(PlaneId::kSunColorR, c))] = {};
  b.fill(PlaneId::kDepth, 16).fill(PlaneId::kShadow, 1);
  const Scene scene = test::simple_scene(size);
  Look look;
  look.of<WaveNormals>().filter = WaveNormals::Filter::kVariance;
  const test::Picture picture(b.frame.work());
  const Plan plan = make_plan(look, test::inputs_of(b.frame, scene));
  ASSERT_EQ(plan.look.of<Caustics>().sunlight, Caustics::Sunlight::kRefracted);
  const auto executor = make_executor(2);
  FusedRunner runner;
  runner.run(plan, b.frame, scene, picture.target, *executor);
  b.set(PlaneId::kShadow, [](int x, int y) { return (x + y) % 8 < 4 ? 1.0f : 0.0f; });
  const int before = test::allocations();
  runner.run(plan, b.frame, scene, picture.target, *executor);
  EXPECT_EQ(test::allocations(), before);
}

/// A smaller frame fits into the memory of a larger frame.
TEST(Allocations, NoneForASmallerFrame) {
  FusedRunner runner;
  const auto executor = make_executor(1);
  bool warm = false;
  for (const Size size : {Size{301, 77}, Size{40, 20}, Size{300, 33}}) {
    const Buffers b = test::noisy_frame(rect_of(size));
    const Scene scene = test::simple_scene(size);
    const test::Picture picture(b.frame.work());
    const Plan plan = make_plan(test::article_look(), test::inputs_of(b.frame, scene));
    const int before = test::allocations();
    runner.run(plan, b.frame, scene, picture.target, *executor);
    const int made = test::allocations() - before;
    if (warm) {
      EXPECT_EQ(made, 0) << size.width << "x" << size.height;
    }
    warm = true;
  }
}

}  // namespace
}  // namespace limpid
