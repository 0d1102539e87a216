#include <algorithm>
#include <cmath>
#include <cstdio>

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "plan/landscape.h"
#include "sanitized.h"
#include "shade/bundled.h"
#include "shade/vulkan_host.h"

/// Shaders as a device runs them, beside the reference and the fused pass: Mesa's lavapipe, or
/// whatever device comes first.

namespace limpid {
namespace {

using test::Below;
using test::Buffers;
using test::VulkanHost;

class Device : public testing::Test {
 protected:
  void SetUp() override {
    if (test::kSanitized) GTEST_SKIP() << "drivers are not instrumented";
    const auto name = VulkanHost::device_name();
    if (!name) GTEST_SKIP() << "no Vulkan device: install mesa-vulkan-drivers";
  }
};

/// How far a picture is from the judge's: the mean over all channels of wet pixels, and the share
/// of values that are off by more than 1e-3.
struct Off {
  double mean = 0, far = 0, most = 0;
};

Off off(const std::vector<double>& got, const std::vector<double>& judge) {
  Off sum;
  for (std::size_t i = 0; i < got.size(); ++i) {
    const double error = std::abs(got[i] - judge[i]);
    sum.mean += error;
    sum.far += error > 1e-3;
    sum.most = std::max(sum.most, error);
  }
  sum.mean /= static_cast<double>(got.size());
  sum.far /= static_cast<double>(got.size());
  return sum;
}

std::vector<double> colors_of(const test::Picture& picture, const Rect& work) {
  std::vector<double> all;
  for (int y = work.y0; y < work.y1; ++y) {
    for (int x = work.x0; x < work.x1; ++x) {
      const Rgb<double> c = picture.color(x, y);
      all.insert(all.end(), {c.r, c.g, c.b});
    }
  }
  return all;
}

/// `within` times as far from the reference in the mean as the fused pass, and as many outliers.
void expect_near(VulkanHost& host, const Look& look, const Frame& frame, const Scene& scene,
                 double within, const std::string& name) {
  const Plan plan = make_plan(look, test::inputs_of(frame, scene));
  const Rect work = frame.work();
  test::Picture judge(work), rival(work);
  run_reference(plan, frame, scene, judge.target);
  run_fused(plan, frame, scene, rival.target, *make_executor(1));
  ShaderOptions options;
  options.stage = ShaderOptions::Stage::kCompute;
  const ShaderText shader(plan, frame, scene, options);
  const std::vector<float> four = host.run(shader, frame)[0];
  std::vector<double> got;
  for (std::size_t i = 0; i < four.size(); ++i) {
    if (i % 4 != 3) got.push_back(static_cast<double>(four[i]));
  }
  const std::vector<double> wanted = colors_of(judge, work);
  const Off ours = off(got, wanted), fused = off(colors_of(rival, work), wanted);
  std::printf("%-24s shader mean %.2e far %.2e most %.2e, fused mean %.2e far %.2e most %.2e\n",
              name.c_str(), ours.mean, ours.far, ours.most, fused.mean, fused.far, fused.most);
  EXPECT_TRUE(std::isfinite(ours.mean)) << name;
  EXPECT_LE(ours.mean, within * fused.mean + 1e-8) << name;
  EXPECT_LE(ours.far, within * fused.far + 2e-4) << name;
}

TEST_F(Device, ShaderIsAsNearTheReferenceAsTheFusedPass) {
  VulkanHost host;
  int seed = 100;
  for (const char* name : test::kShippedLooks) {
    for (const Below below : {Below::kNone, Below::kHoles}) {
      ++seed;
      const Size size{210, 120};
      Scene scene = test::simple_scene(size);
      scene.camera->view = glm::lookAt(glm::dvec3(0, 2, 0), glm::dvec3(0.1, 1.6, -1), {0, 1, 0});
      scene.sky = SkyLight{{0.4, 0.5, 0.6}};
      scene.time = 1.7;
      Buffers b = test::landscape(rect_of(size), scene, seed, seed % 2 == 0, below);
      const test::NoiseMap map(64, 32);
      b.frame.wave_map = map.texture;
      expect_near(host, test::shipped_look(name), b.frame, scene, 1.5, name);
    }
  }
  EXPECT_EQ(host.messages(), std::vector<std::string>());
}

TEST_F(Device, ShaderIsAsNearTheReferenceOverBundledScenes) {
  VulkanHost host;
  test::for_each_bundled({192, 108}, [&](const std::string& name, Subject& subject) {
    for (const char* look_name : test::kShippedLooks) {
      const Look look = test::shipped_look(look_name);
      const Frame frame = subject.frame_for(subject.plan(look));
      expect_near(host, look, frame, subject.scene(), 1.5, name + " " + look_name);
    }
  });
  EXPECT_EQ(host.messages(), std::vector<std::string>());
}

}  // namespace
}  // namespace limpid
