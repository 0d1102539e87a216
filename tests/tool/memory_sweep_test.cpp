#include <algorithm>
#include <cstdlib>

#include <gmock/gmock.h>

#include "files/exr/deep_files.h"
#include "paths.h"
#include "sanitized.h"
#include "tool/made_plate.h"
#include "tool/tool.h"

/// Limits of memory from far too little up to enough, in steps of 1 MiB: each run but the last
/// reports that the limit is too low, at whichever step memory runs out.

namespace limpid::test {
namespace {

constexpr int kMaxMebibytes = 2048;

/// The step: 1 MiB if the environment asks for the fine sweep, which takes minutes; else `coarse`.
int step_of(int coarse) { return std::getenv("LIMPID_EACH_MEBIBYTE") ? 1 : coarse; }

/// The mechanism that sets the limit.
struct Limit {
  const char* name;
  /// Runs the tool under a limit in MiB, for at most 10 s of processor time.
  const char* script;
  int least;  ///< MiB; for ulimit, the memory that the loader needs before the tool can print
};

void PrintTo(const Limit& limit, std::ostream* out) { *out << limit.name; }

constexpr Limit kLimits[] = {
    {"Option", R"(ulimit -t 10; size=$1; shift; exec "$@" --max-memory ${size}M)", 16},
    {"Ulimit", R"(ulimit -t 10; ulimit -v $(($1 * 1024)); shift; exec "$@")", 96},
};

class MemorySweepTest : public ToolTest, public ::testing::WithParamInterface<Limit> {
 protected:
  void SetUp() override {
    ToolTest::SetUp();
    if (kSanitized) GTEST_SKIP() << "a sanitizer's own memory meets the limit first";
  }

  Ran limited(int mebibytes, const Words& arguments) const {
    Words command = {"/bin/sh",  "-c", GetParam().script, "sh", std::to_string(mebibytes),
                     LIMPID_TOOL};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return run(folder_, command);
  }

  /// Runs the tool under one limit after the other, until a run succeeds.
  void sweep(const Words& arguments, int step = 1) const {
    const std::vector<std::string> before = files();
    int mebibytes = GetParam().least;
    Ran ran = limited(mebibytes, arguments);
    while (ran.code == 1 && mebibytes < kMaxMebibytes) {
      ASSERT_THAT(ran.err, ::testing::MatchesRegex("limpid ERROR: .*memory.*\n")) << mebibytes;
      ASSERT_THAT(ran.err, ::testing::Not(::testing::HasSubstr("damaged"))) << mebibytes;
      ASSERT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << mebibytes << ran.err;
      ASSERT_EQ(files(), before) << mebibytes;
      mebibytes += step;
      ran = limited(mebibytes, arguments);
    }
    EXPECT_EQ(ran.code, 0) << mebibytes << " MiB: " << ran.err;
    RecordProperty("needs", mebibytes);
  }

  void sweep_composite(const Words& plates, const Words& more = {}, int step = 1) const {
    Words words = {"composite", "--scene", "scene.toml", "--look",
                   "look.toml", "-o",      "wet.exr",    "-q"};
    words.insert(words.end(), plates.begin(), plates.end());
    words.insert(words.end(), more.begin(), more.end());
    sweep(words, step);
  }
};

TEST_P(MemorySweepTest, SmallPlate) { sweep_composite({"plate.exr"}); }

TEST_P(MemorySweepTest, Preview) { sweep_composite({"plate.exr"}, {"--preview", "wet.png"}); }

TEST_P(MemorySweepTest, PreviewByTheFormatModule) {
  sweep_composite({"plate.exr"}, {"--preview", "wet.tif"}, step_of(5));
}

TEST_P(MemorySweepTest, PlateOf4K) {
  const Rect window{0, 0, 3840, 2160};
  Plane gray(window), depth(window);
  for (int y = 0; y < window.y1; ++y) {
    std::fill_n(&gray.view().at(0, y), window.x1, 0.5f);
    std::fill_n(&depth.view().at(0, y), window.x1, 5.0f);
  }
  ExrOutput output;
  output.data = output.display = window;
  for (const char* name : {"R", "G", "B"}) output.channels.push_back({name, gray.view()});
  output.channels.push_back({"Z", depth.view(), false});
  write_exr(folder_ / "4k.exr", output);
  sweep_composite({"4k.exr"}, {"--threads", "16"}, step_of(17));
}

TEST_P(MemorySweepTest, DeepPlate) {
  exr_test::DeepPicture deep = exr_test::rgbaz();
  deep.data = {0, 0, 320, 180};
  for (int y = 0; y < deep.data.y1; ++y) {
    for (int x = 0; x < deep.data.x1; ++x) {
      for (int i = 0; i < 8; ++i) {
        const auto z = static_cast<float>(4 + i);
        deep.samples[{x, y}].push_back(exr_test::point(z, 0.25f, 0.25f));
      }
    }
  }
  exr_test::write_deep_picture((folder_ / "deep.exr").string(), deep);
  sweep_composite({"deep.exr"});
}

TEST_P(MemorySweepTest, Scene) {
  const std::string pool = std::string(LIMPID_DATA) + "/scenes/pool.toml";
  sweep({"render", pool, "--size", "320x180", "-o", "pool.exr", "-q"});
  sweep({"water", pool, "--size", "320x180", "-o", "pool.exr", "-q"});
}

INSTANTIATE_TEST_SUITE_P(, MemorySweepTest, ::testing::ValuesIn(kLimits),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace limpid::test
