#include <gmock/gmock.h>

#include "limpid/core/error.h"
#include "limpid/files/exr/exr_file.h"
#include "limpid/gpu/gpu_runner.h"

#include "paths.h"
#include "sanitized.h"
#include "tool/made_plate.h"
#include "tool/tool.h"

/// --runner gpu on the first device: Mesa's lavapipe on a machine without a GPU.

namespace limpid::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class GpuToolTest : public ToolTest {
 protected:
  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "drivers are not instrumented";
    try {
      if (gpu_devices().empty()) GTEST_SKIP() << "no GPU: install mesa-vulkan-drivers";
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
    setenv("XDG_CACHE_HOME", (folder_ / "cache").c_str(), 1);
  }
  void TearDown() override { unsetenv("XDG_CACHE_HOME"); }
};

TEST_F(GpuToolTest, GivesThePictureOfTheReference) {
  composed("reference.exr", {"--runner", "reference", "--float", "--aov", "all"});
  composed("gpu.exr", {"--runner", "gpu", "--float", "--aov", "all"});
  EXPECT_TRUE(same("gpu.exr", "reference.exr", 3e-4));
  EXPECT_TRUE(std::filesystem::is_directory(folder_ / "cache/limpid"));
  composed("again.exr",
           {"--runner", "gpu", "--float", "--aov", "all", "--gpu", gpu_devices()[0].name});
  EXPECT_EQ(text_of("again.exr"), text_of("gpu.exr"));
  const auto options = ExrFile::open(folder_ / "gpu.exr").text_attribute(0, "limpid/options");
  ASSERT_TRUE(options.has_value());
  EXPECT_THAT(*options, HasSubstr("runner = \"gpu\"\n"));
  EXPECT_THAT(*options, HasSubstr("gpu = \"" + gpu_devices()[0].name + " ("));
}

/// Deep output and wave samples equal those of the fused runner.
TEST_F(GpuToolTest, WritesWhatOthersWrite) {
  const Words scene{std::string(LIMPID_DATA) + "/scenes/pool.toml",
                    "--size",
                    "96x54",
                    "--time",
                    "1.5",
                    "--float"};
  const auto water = [&](const std::string& runner, const Words& more) {
    Words words{"water"};
    words.insert(words.end(), scene.begin(), scene.end());
    words.insert(words.end(), {"--runner", runner});
    words.insert(words.end(), more.begin(), more.end());
    const Ran ran = limpid(words);
    EXPECT_EQ(ran.code, 0) << ran.err;
  };
  for (const char* runner : {"reference", "gpu"}) {
    const std::string name = runner;
    water(name, {"--deep", name + "_deep.exr", "-o", name + ".exr"});
    water(name, {"--samples", "2", "-o", name + "_samples.exr"});
  }
  EXPECT_TRUE(same("gpu.exr", "reference.exr", 5e-3));
  EXPECT_TRUE(same("gpu_samples.exr", "reference_samples.exr", 5e-3));
  EXPECT_THAT(iinfo("gpu_deep.exr"), HasSubstr("deep"));
}

TEST_F(GpuToolTest, FramesOfASequenceAreThoseAlone) {
  for (int frame = 1; frame <= 4; ++frame) {
    PlateOptions options;
    options.depth_code = [=](double z, double) { return z * (1 + 0.02 * frame); };
    write_plate(folder_ / ("p.000" + std::to_string(frame) + ".exr"), options);
  }
  const auto run = [&](const std::string& plate, const std::string& output, const Words& more) {
    Words words{"composite", plate, "--scene", "scene.toml", "--look",
                "look.toml", "-o",  output,    "--runner",   "gpu"};
    words.insert(words.end(), more.begin(), more.end());
    const Ran ran = limpid(words);
    EXPECT_EQ(ran.code, 0) << ran.err;
  };
  run("p.#.exr", "w.#.exr", {"--frames", "1-4", "--frames-in-flight", "3"});
  for (const std::string frame : {"0001", "0004"}) {
    run("p.#.exr", "alone.#.exr", {"--frames", frame});
    EXPECT_NE(text_of("w." + frame + ".exr"), "");
    EXPECT_EQ(text_of("w." + frame + ".exr"), text_of("alone." + frame + ".exr"));
  }
}

TEST_F(GpuToolTest, PlanSaysWhatRunsWhere) {
  const auto plan = [&](const Words& more) {
    Words words{"plan", "plate.exr", "--scene", "scene.toml", "--look", "look.toml"};
    words.insert(words.end(), more.begin(), more.end());
    const Ran ran = limpid(words);
    EXPECT_EQ(ran.code, 0) << ran.err;
    return ran.out;
  };
  const std::string said = plan({"--runner", "gpu", "--set", "water.edges=mixed"});
  EXPECT_THAT(said, testing::ContainsRegex(
                        "on the GPU  shader [0-9a-f]+ of [0-9]+ numbers and "
                        "[0-9]+ textures; at most [0-9.]+ MB to the device and 0.0 MB back"));
  EXPECT_THAT(said, testing::ContainsRegex("on the CPU  .*mixed edges"));
  EXPECT_THAT(plan({}), testing::Not(HasSubstr("on the GPU")));
}

TEST_F(GpuToolTest, RefusesWhatItCannotDo) {
  const Words plate{"plate.exr", "--scene", "scene.toml"};
  const auto refused = [&](const Words& more, const std::string& sentence, int code) {
    Words words = plate;
    words.insert(words.end(), more.begin(), more.end());
    expect_no_composite(words, {sentence}, code);
  };
  refused({"--runner", "gpu", "--gpu", "no such"}, "no GPU has 'no such' in its name", 1);
  refused({"--gpu", "any"}, "--gpu any: expected --runner gpu beside it", 2);
  refused({"--runner", "gpu", "--max-error", "0.1"},
          "--max-error 0.1: the gpu runner leaves nothing out", 2);
}

}  // namespace
}  // namespace limpid::test
