#include "limpid/gpu/gpu_runner.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>
#include <thread>

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "limpid/core/error.h"

#include "complete/post.h"
#include "gpu/gpu.h"
#include "paths.h"
#include "plan/landscape.h"
#include "shade/bundled.h"

/// The runner on a device, compared with the reference and the fused runner: Mesa's lavapipe, or
/// the first device.

namespace limpid {
namespace {

using test::Below;
using test::Buffers;
using test::Picture;

class Gpu : public test::GpuTest {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    if (!IsSkipped()) runner.emplace();
  }
  std::optional<GpuRunner> runner;
  std::unique_ptr<Executor> executor = make_executor(2);
};

/// The distance of values from the judge's: the mean of all distances, the mean of those below
/// 1e-3, and the share of the others. Large values, such as depths, count by their own size.
struct Off {
  double mean = 0, near = 0, far = 0;
};

Off off(const std::vector<float>& got, const std::vector<float>& judge) {
  Off sum;
  for (std::size_t i = 0; i < got.size(); ++i) {
    const bool same = got[i] == judge[i] || (std::isnan(got[i]) && std::isnan(judge[i]));
    const double scale = std::max(1.0, std::abs(double(judge[i])));
    const double error = same ? 0 : std::abs(double(got[i]) - double(judge[i])) / scale;
    sum.mean += error;
    if (error <= 1e-3) sum.near += error;
    sum.far += !(error <= 1e-3);
  }
  sum.mean /= static_cast<double>(got.size());
  sum.near /= static_cast<double>(got.size());
  sum.far /= static_cast<double>(got.size());
  return sum;
}

std::vector<float> colors_of(const Picture& picture, const Rect& work) {
  std::vector<float> all;
  for (int y = work.y0; y < work.y1; ++y) {
    for (int x = work.x0; x < work.x1; ++x) {
      for (const View<float>& view : picture.target.color) all.push_back(view.at(x, y));
    }
  }
  return all;
}

/// The mean distance to the reference is at most `within` times the fused runner's, with as many
/// outliers: in the picture and in all outputs, some of which choose one of several values.
void expect_near(GpuRunner& runner, Executor& executor, const Look& look, const Frame& frame,
                 const Scene& scene, const std::string& name, double within = 1.5) {
  const Plan plan = make_plan(look, test::inputs_of(frame, scene), test::all_state());
  const Rect work = frame.work();
  Picture judge(work), rival(work), got(work);
  run_reference(plan, frame, scene, judge.target);
  run_fused(plan, frame, scene, rival.target, executor);
  runner.run(plan, frame, scene, got.target, executor);
  const auto expect = [&](const std::string& what, const std::vector<float>& ours,
                          const std::vector<float>& theirs, const std::vector<float>& wanted) {
    const Off gpu = off(ours, wanted), fused = off(theirs, wanted);
    std::printf("%-26s %-8s gpu mean %.2e far %.2e, fused mean %.2e far %.2e\n", name.c_str(),
                what.c_str(), gpu.mean, gpu.far, fused.mean, fused.far);
    EXPECT_TRUE(std::isfinite(gpu.mean)) << name << ", " << what;
    EXPECT_LE(gpu.near, within * fused.near + 1e-8) << name << ", " << what;
    if (what == "picture") {
      EXPECT_LE(gpu.mean, within * fused.mean + 1e-8) << name;
    }
    EXPECT_LE(gpu.far, within * fused.far + 2e-4) << name << ", " << what;
  };
  expect("picture", colors_of(got, work), colors_of(rival, work), colors_of(judge, work));
  expect("all", got.values(), rival.values(), judge.values());
}

/// A landscape, seen from above its water.
struct Land {
  explicit Land(int seed, Below below = Below::kHoles, double eye = 2, Size size = {210, 120})
      : scene(test::simple_scene(size)) {
    scene.camera->view =
        glm::lookAt(glm::dvec3(0, eye, 0), glm::dvec3(0.1, eye - 0.4, -1), {0, 1, 0});
    scene.sky = SkyLight{{0.4, 0.5, 0.6}};
    scene.time = 1.7;
    buffers = test::landscape(rect_of(size), scene, seed, seed % 2 == 0, below);
    buffers.frame.wave_map = map.texture;
  }
  Plan plan(const Look& look) const {
    return make_plan(look, test::inputs_of(buffers.frame, scene), test::all_state());
  }
  std::vector<float> by(GpuRunner& runner, const Look& look, Executor& executor) const {
    Picture picture(buffers.frame.work());
    runner.run(plan(look), buffers.frame, scene, picture.target, executor);
    return picture.values();
  }

  Scene scene;
  test::NoiseMap map{64, 32};
  Buffers buffers{rect_of({1, 1})};
};

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

Look look_named(const std::string& name) {
  return load_look(std::string(LIMPID_DATA) + "/looks/" + name + ".toml");
}

TEST_F(Gpu, IsAsNearTheReferenceAsTheFusedRunner) {
  int seed = 100;
  for (const char* name : test::kShippedLooks) {
    for (const Below below : {Below::kNone, Below::kHoles}) {
      Land land(++seed, below);
      Look look = look_named(name);
      expect_near(*runner, *executor, look, land.buffers.frame, land.scene, name);
      if (name != std::string("physical")) continue;
      // Murky, with the sun behind the viewer, so that shafts are seen.
      land.scene.sun->direction = {0, 0.6, 0.8};
      look.of<DepthFog>().model = DepthFog::Model::kBeerLambert;
      look.of<DepthFog>().scattering = {0.5, 0.5, 0.5};
      look.of<DepthFog>().anisotropy = 0;
      look.of<WaterShadow>().shafts = 1;
      expect_near(*runner, *executor, look, land.buffers.frame, land.scene, "murky, with shafts");
    }
  }
}

TEST_F(Gpu, IsAsNearTheReferenceOverBundledScenes) {
  test::for_each_bundled({192, 108}, [&](const std::string& name, Subject& subject) {
    for (const char* look_name : test::kShippedLooks) {
      const Look look = look_named(look_name);
      const Plan all = subject.plan(look, 0, test::all_state());
      expect_near(*runner, *executor, look, subject.frame_for(all), subject.scene(),
                  name + " " + look_name);
    }
  });
}

TEST_F(Gpu, SeesTheWaterFromWithinIt) {
  for (const double eye : {-0.5, 0.03}) {
    const Size size{90, 60};
    Scene scene = test::simple_scene(size);
    scene.water->waves = {{0.02, 3, 1, 0.4, 2}, {0.01, -1, 5, 1.4, 3}};
    scene.camera->view =
        glm::lookAt(glm::dvec3(0, eye, 0), glm::dvec3(0.1, eye + 0.01, -1), {0, 1, 0});
    scene.time = 2.5;
    Buffers b(rect_of(size));
    for (int c = 0; c < 3; ++c) {
      b.set(plane_after(PlaneId::kColorR, c), [&](int x, int y) { return test::noise(x, y, c); });
    }
    b.set(PlaneId::kDepth, [](int x, int y) { return 1 + 6 * test::noise(x / 3, y / 3, 9); });
    const test::NoiseMap map(16, 8);
    b.frame.wave_map = map.texture;
    expect_near(*runner, *executor, look_named("physical"), b.frame, scene,
                "eye at " + std::to_string(eye));
  }
}

/// Edges are mixed on the CPU, in the picture and in the AOVs that sum to the picture.
TEST_F(Gpu, MixesEdges) {
  test::Post post;
  post.blur = 6;
  post.make();
  const Look look = look_named("physical");
  const Plan plan = make_plan(look, test::inputs_of(post.buffers.frame, post.scene));
  const Rect work = post.buffers.frame.work();
  Picture judge(work), got(work);
  Plane uncovered(work), expected(work);
  judge.target.uncovered = expected.view();
  got.target.uncovered = uncovered.view();
  run_reference(plan, post.buffers.frame, post.scene, judge.target);
  runner->run(plan, post.buffers.frame, post.scene, got.target, *executor);
  int mixed = 0;
  for (int y = work.y0; y < work.y1; ++y) {
    for (int x = work.x0; x < work.x1; ++x) {
      EXPECT_EQ(uncovered.view().at(x, y), expected.view().at(x, y));
      mixed += uncovered.view().at(x, y) < 1;
    }
  }
  EXPECT_GT(mixed, 100);
  EXPECT_LT(off(colors_of(got, work), colors_of(judge, work)).mean, 1e-5);
}

TEST_F(Gpu, CopiesDryPixelsBitForBit) {
  const Land land(9);  // whose data window is larger than alpha's, the display window
  Buffers b = test::landscape(rect_of({210, 120}), land.scene, 9, false, Below::kNone);
  b.set(PlaneId::kColorA, [](int x, int y) { return test::noise(x, y, 5); });
  const Plan plan = make_plan(look_named("realistic"), test::inputs_of(b.frame, land.scene));
  const Rect work = b.frame.work();
  Picture judge(work), got(work);
  run_reference(plan, b.frame, land.scene, judge.target);
  runner->run(plan, b.frame, land.scene, got.target, *executor);
  int dry = 0;
  for (int y = work.y0; y < work.y1; ++y) {
    for (int x = work.x0; x < work.x1; ++x) {
      const float alpha = judge.target.alpha.at(x, y);
      EXPECT_EQ(got.target.alpha.at(x, y), alpha);
      if (alpha == 1) continue;
      ++dry;
      for (int c = 0; c < 3; ++c) {
        const PlaneId plane = plane_after(PlaneId::kColorR, c);
        EXPECT_EQ(got.target.color[static_cast<std::size_t>(c)].at(x, y),
                  b.frame.plane(plane).at(x, y));
      }
    }
  }
  EXPECT_GT(dry, 1000);
}

/// Memory and pipelines that are kept from other frames change no bit.
TEST_F(Gpu, GivesTheSameBitsAfterOtherFrames) {
  const Land land(11), other(12, Below::kNone, 2, {97, 61});
  const Look physical = look_named("physical"), fast = look_named("fast");
  const std::vector<float> first = land.by(*runner, physical, *executor);
  other.by(*runner, physical, *executor);
  land.by(*runner, fast, *executor);
  other.by(*runner, fast, *executor);
  EXPECT_TRUE(same_bits(land.by(*runner, physical, *executor), first));
  EXPECT_TRUE(same_bits(land.by(*runner, physical, *make_executor(1)), first));
  GpuRunner fresh;
  EXPECT_TRUE(same_bits(land.by(fresh, physical, *executor), first));
}

TEST_F(Gpu, RunnersShareTheDeviceOnAnyThreads) {
  const Land land(13);
  const Look look = look_named("realistic");
  const std::vector<float> expected = land.by(*runner, look, *executor);
  std::vector<std::vector<float>> got(4);
  std::vector<std::thread> threads;
  for (std::vector<float>& picture : got) {
    threads.emplace_back([&] {
      GpuRunner own;
      const auto serial = make_executor(1);
      for (int i = 0; i < 3; ++i) picture = land.by(own, look, *serial);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::vector<float>& picture : got) EXPECT_TRUE(same_bits(picture, expected));
}

TEST_F(Gpu, RefusesDevicesThatAreNotThere) {
  const auto refusal = [](const GpuOptions& options) -> std::string {
    try {
      GpuRunner made(options);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal({.device = "no such device"})
                .find("no GPU has 'no such device' in its name: expected a part of one of "),
            0u);
  const std::vector<GpuInfo> known = gpu_devices();
  ASSERT_FALSE(known.empty());
  EXPECT_EQ(refusal({.device = known[0].name}), "");
  EXPECT_EQ(runner->device().find(known[0].name), 0u);
}

TEST_F(Gpu, RefusesFramesThatAreTooLarge) {
  Land wide(14, Below::kNone, 2, {40000, 1});
  try {
    wide.by(*runner, look_named("realistic"), *executor);
    FAIL() << "expected a device with a limit";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("a picture of 40000x1 pixels: "), std::string::npos)
        << error.what();
  }
  const Land land(15);  // a new run succeeds
  EXPECT_FALSE(land.by(*runner, look_named("realistic"), *executor).empty());
}

/// A file of the cache is used if its bytes are as written, and is made anew otherwise.
TEST_F(Gpu, KeepsPipelinesInAFolder) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(testing::TempDir()) / "limpid_gpu_cache" / "made";
  fs::remove_all(folder.parent_path());
  const Land land(16);
  const Look look = look_named("realistic");
  const std::vector<float> expected = land.by(*runner, look, *executor);
  runner.reset();  // frees the device too, which has the pipeline
  const auto start = [&] {
    GpuRunner own({.cache = folder});
    EXPECT_TRUE(same_bits(land.by(own, look, *executor), expected));
  };
  start();
  ASSERT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
  const fs::path file = fs::directory_iterator(folder)->path();
  const auto written = fs::last_write_time(file);
  const auto size = fs::file_size(file);
  start();
  EXPECT_EQ(fs::last_write_time(file), written);
  fs::resize_file(file, size - 1);
  start();
  EXPECT_EQ(fs::file_size(file), size);
  {
    std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
    bytes.seekp(200);
    bytes.put('\x5a').put('\xa5');
  }
  start();
  EXPECT_EQ(fs::file_size(file), size);
  fs::remove_all(folder.parent_path());
  std::ofstream(folder.parent_path()) << "a file where a folder should be";
  start();
  fs::remove(folder.parent_path());
}

}  // namespace
}  // namespace limpid
