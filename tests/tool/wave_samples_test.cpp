#include <gmock/gmock.h>

#include "tool/made_plate.h"
#include "tool/tool.h"

// composite --samples

namespace limpid::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

using WaveSamplesTest = ToolTest;

TEST_F(WaveSamplesTest, ChangeTheWaterAlone) {
  composed("one.exr", {"--float"});
  composed("also_one.exr", {"--float", "--samples", "1"});
  composed("three.exr", {"--float", "--samples", "3"});
  EXPECT_TRUE(same("one.exr", "also_one.exr"));
  EXPECT_FALSE(same("one.exr", "three.exr"));
  const std::string shore = "15x31+0+5";
  const Ran ran =
      oiiotool({"--fail", "0", "one.exr", "--cut", shore, "three.exr", "--cut", shore, "--diff"});
  EXPECT_EQ(ran.code, 0) << ran.out;
  EXPECT_THAT(iinfo("three.exr"), HasSubstr("wave_samples = 3"));
  EXPECT_THAT(iinfo("one.exr"), Not(HasSubstr("wave_samples")));
}

TEST_F(WaveSamplesTest, TermsStillSumToThePicture) {
  composed("terms.exr",
           {"--float", "--samples", "2", "--aov", "transmitted,in_scatter,reflected,highlight"});
  const auto term = [](const std::string& name) {
    return name + ".R," + name + ".G," + name + ".B";
  };
  const Ran ran = oiiotool({"--fail",
                            "1e-5",
                            "terms.exr",
                            "--ch",
                            term("transmitted"),
                            "terms.exr",
                            "--ch",
                            term("in_scatter"),
                            "--add",
                            "terms.exr",
                            "--ch",
                            term("reflected"),
                            "--add",
                            "terms.exr",
                            "--ch",
                            term("highlight"),
                            "--add",
                            "--chnames",
                            "R,G,B",
                            "terms.exr",
                            "--ch",
                            "R,G,B",
                            "--diff"});
  EXPECT_EQ(ran.code, 0) << ran.out;
}

TEST_F(WaveSamplesTest, ThreadsDoNotChangeAByte) {
  composed("a.exr", {"--samples", "2", "--threads", "1"});
  composed("b.exr", {"--samples", "2", "--threads", "4"});
  EXPECT_EQ(text_of("a.exr"), text_of("b.exr"));
}

TEST_F(WaveSamplesTest, WhatTheyCannotBeIsRefused) {
  expect_no_composite({"--samples", "0"}, {"--samples", "1 ... 64"}, 2);
  expect_no_composite({"--samples", "65"}, {"--samples", "1 ... 64"}, 2);
  expect_no_composite(
      {"plate.exr", "--scene", "scene.toml", "--deep", "deep.exr", "--samples", "2"},
      {"wave_samples = 2 and a deep file", "expected 1"}, 2);
}

TEST_F(WaveSamplesTest, NormalsOfThePlateAreNotSampled) {
  const Ran ran =
      composite("wet.exr", {"--samples", "2", "--layer", "surface_normal=plate.exr:reflection"});
  EXPECT_THAT(ran.err, HasSubstr("wave_samples = 2 (--samples) changes nothing"));
}

}  // namespace
}  // namespace limpid::test
