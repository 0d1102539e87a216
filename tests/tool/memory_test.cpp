#include <gmock/gmock.h>

#include "paths.h"
#include "sanitized.h"
#include "tool/tool.h"

/// --max-memory: a job that fits runs, a larger one is refused in a sentence, no job takes more.

namespace limpid::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr long long kMost = 64LL << 20;

std::string scene(const std::string& name) { return std::string(LIMPID_DATA) + "/scenes/" + name; }

class MemoryTest : public ToolTest {
 protected:
  void SetUp() override {
    ToolTest::SetUp();
    if (kSanitized) {
      GTEST_SKIP() << "a sanitizer's own memory meets the limit of the process first; the release "
                      "build checks this";
    }
  }

  /// Runs with --max-memory 64M; the memory beyond that of an idle run is at most a tenth over the
  /// limit.
  Ran limited(Words arguments) const {
    arguments.insert(arguments.end(), {"--max-memory", "64M"});
    Ran ran = limpid(arguments);
    const long long nothing = limpid({"--version"}).memory;
    EXPECT_LT(ran.memory - nothing, kMost + kMost / 10) << arguments[0];
    return ran;
  }

  void write_picture(const std::string& file, const std::string& size, int channels) const {
    const std::string names[] = {"", "Z", "", "R,G,B"};
    const Ran made =
        oiiotool({"--pattern", "constant:color=0.5,0.5,0.5", size, std::to_string(channels),
                  "--chnames", names[channels], "-d", "half", "--compression", "rle", "-o", file});
    ASSERT_EQ(made.code, 0) << made.err;
  }
};

TEST_F(MemoryTest, WhatFitsRuns) {
  const Ran ran = limited({"composite", "plate.exr", "--scene", "scene.toml", "--look", "look.toml",
                           "-o", "wet.exr", "-q"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(limited({"inspect", "plate.exr"}).code, 0);
  EXPECT_EQ(limited({"water", scene("pool.toml"), "--size", "64x36", "-o", "pool.exr"}).code, 0);
}

TEST_F(MemoryTest, PlatesAndPicturesThatDoNotFitAreRefused) {
  write_picture("big.exr", "2500x2400", 3);
  write_picture("deep.exr", "2500x2400", 1);
  expect_refused(limited({"compare", "big.exr", "big.exr"}),
                 {"needs more memory than --max-memory 64M"});
  write_text("big.toml", text_of("scene.toml"));
  expect_refused(limited({"composite", "big.exr", "deep.exr", "--scene", "big.toml", "--look",
                          "look.toml", "-o", "wet.exr"}),
                 {"more memory than the limit of 67108864 bytes"});
  EXPECT_EQ(limited({"inspect", "big.exr"}).code, 0);
}

TEST_F(MemoryTest, RenderedPicturesThatDoNotFitAreRefused) {
  for (const std::string verb : {"render", "water"}) {
    expect_refused(limited({verb, scene("pool.toml"), "--size", "2500x2400", "-o", "big.exr"}),
                   {"needs more memory than --max-memory 64M"});
  }
}

TEST_F(MemoryTest, TexturesAndModelsThatDoNotFitAreRefused) {
  write_picture("sky.exr", "3600x1800", 3);
  std::string text = text_of("scene.toml");
  const std::string plates = "[plates]\nenvironment = \"sky.exr\"\n";
  write_text("sky.toml", plates + text);
  expect_refused(limited({"composite", "plate.exr", "--scene", "sky.toml", "--look", "look.toml",
                          "--set", "fresnel_reflection.source=environment", "-o", "wet.exr"}),
                 {"needs more memory than --max-memory 64M"});
  write_text(
      "bomb.gltf", R"({"asset": {"version": "2.0"}, "extras": [1)" + [] {
        std::string ones;
        for (int i = 0; i < 300000; ++i) ones += ",1";
        return ones;
      }() + "]}");
  write_text("bomb.toml", "[geometry]\ngltf = \"bomb.gltf\"\n" + text);
  expect_refused(limited({"render", "bomb.toml", "-o", "big.exr"}),
                 {"bomb.gltf: its JSON may need ", "expected at most 67108864"});
}

TEST_F(MemoryTest, SizesAreBytesOrHaveAUnit) {
  const auto ran = [&](const std::string& size) {
    return limpid({"inspect", "plate.exr", "--max-memory", size});
  };
  for (const std::string size : {"67108864", "64M", "0.5G", "1T", "16M"}) {
    EXPECT_EQ(ran(size).code, 0) << size;
  }
  for (const std::string size : {"15M", "16777215", "64m", "64MB", "G", "-1G", "1e9", "nan", "inf",
                                 "1G ", "9999999999T", ""}) {
    const Ran refused = ran(size);
    EXPECT_EQ(refused.code, 2) << size;
    EXPECT_THAT(refused.err, AllOf(HasSubstr("--max-memory"), HasSubstr("16M"))) << size;
  }
}

}  // namespace
}  // namespace limpid::test
