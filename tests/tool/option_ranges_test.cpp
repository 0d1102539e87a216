#include <gmock/gmock.h>

#include "paths.h"
#include "tool/tool.h"

/// Every option that takes a number refuses a value out of its range as wrong usage, in a sentence
/// that names option, value and range, before any file is read.

namespace limpid::test {
namespace {

using ::testing::HasSubstr;

struct RangedOption {
  std::string option;
  std::string range;  ///< in the words of the message
  Words good, bad;
};

const Words kNoNumbers = {"nan", "-nan", "inf", "-inf"};

/// Options of a verb, and the other arguments that the verb needs.
class OptionRangesTest : public ToolTest {
 protected:
  void expect_ranges(const Words& command, const std::vector<RangedOption>& options) const {
    for (const RangedOption& ranged : options) {
      Words bad = ranged.bad;
      bad.insert(bad.end(), kNoNumbers.begin(), kNoNumbers.end());
      for (const std::string& value : bad) {
        Words words = command;
        words.push_back(ranged.option + "=" + value);
        SCOPED_TRACE(command[0] + " " + ranged.option + " " + value);
        expect_refused(limpid(words), {ranged.option + " " + value + ": expected " + ranged.range},
                       2);
      }
      for (const std::string& value : ranged.good) {
        Words words = command;
        words.push_back(ranged.option + "=" + value);
        // The values are accepted: the next error is the missing file.
        EXPECT_EQ(limpid(words).code, 1) << ranged.option << " " << value;
      }
      Words none = command;
      none.push_back(ranged.option + "=much");
      EXPECT_EQ(limpid(none).code, 2) << ranged.option;
    }
  }
};

const RangedOption kThreads{
    "--threads", "a whole number, 0 ... 1024", {"0", "2"}, {"-1", "1025", "1.5", "99999999999"}};
const RangedOption kTime{
    "--time", "-1e+12 ... 1e+12 (s)", {"-3.5", "1e12"}, {"1.1e12", "-1e300", "1e999"}};
const RangedOption kFps{"--fps", "1e-06 ... 1e+06", {"0.001", "1e6"}, {"0", "-24", "1e-7", "1e9"}};
const RangedOption kInFlight{
    "--frames-in-flight", "a whole number, 1 ... 64", {"1", "64"}, {"0", "65", "-1", "2.5"}};
const RangedOption kMaxError{
    "--max-error", "a finite number from 0 up (white = 1)", {"0", "1e9"}, {"-0.001", "1e999"}};
const RangedOption kSamples{
    "--samples", "a whole number, 1 ... 16", {"1", "16"}, {"0", "-1", "17", "1e3", "99999999999"}};

const RangedOption kOverscan{
    "--overscan", "a whole number, 0 ... 16000", {"0", "16000"}, {"-1", "16001", "0.5"}};

TEST_F(OptionRangesTest, OfComposite) {
  expect_ranges({"composite", "absent.exr", "-o", "wet.####.exr", "--frames", "1"},
                {kThreads, kTime, kFps, kInFlight, kMaxError, kOverscan});
  expect_ranges({"plan", "absent.exr", "--frames", "1"}, {kTime, kFps, kInFlight, kMaxError});
}

TEST_F(OptionRangesTest, OfRenderedPictures) {
  const RangedOption shadows{
      "--shadow-map", "a whole number, 1 ... 16384", {"1", "16384"}, {"0", "-2048", "16385"}};
  const std::string size = "WxH, as in 1920x1080, with 1 ... 32000 pixels a side";
  const RangedOption sizes{"--size",
                           size,
                           {},
                           {"0x0", "0x9", "-16x9", "32001x1", "99999999999x9", "16", "16x", "x9",
                            "16x9x4", "1e3x9", "nanxnan"}};
  const Words frames{"absent.toml", "-o", "wet.####.exr", "--frames", "1"};
  const auto of = [&](const std::string& verb) {
    Words words{verb};
    words.insert(words.end(), frames.begin(), frames.end());
    return words;
  };
  expect_ranges(of("render"), {kThreads, kTime, kFps, kInFlight, kOverscan, shadows});
  expect_ranges(of("water"), {kTime, kFps, kInFlight, kMaxError, kOverscan, shadows, kSamples});
  const RangedOption seed{"--seed",
                          "a whole number, 0 ... 18446744073709551615",
                          {"0", "18446744073709551615"},
                          {"-1", "18446744073709551616", "1.5"}};
  const RangedOption paths{
      "--paths", "a whole number, 1 ... 65536", {"1", "65536"}, {"0", "65537", "-1", "1.5"}};
  const RangedOption photons{
      "--photons", "a whole number, 0 ... 50000000", {"0", "50000000"}, {"-1", "50000001", "1e3"}};
  expect_ranges(of("truth"), {kTime, kFps, kSamples, paths, photons, seed});
  // A size is checked after the scene is read.
  for (const std::string verb : {"render", "water", "truth"}) {
    for (const std::string& bad : sizes.bad) {
      expect_refused(
          limpid({verb, LIMPID_DATA "/scenes/pool.toml", "-o", "wet.exr", "--size", bad}),
          {"--size " + bad + ": expected " + size}, 2);
    }
  }
}

/// Each value is in its range, but the combination is not.
TEST_F(OptionRangesTest, OfSizesThatAreTooMuchTogether) {
  const auto refused = [&](const Words& more, const Words& parts) {
    Words words{"water", LIMPID_DATA "/scenes/pool.toml", "-o", "wet.exr"};
    words.insert(words.end(), more.begin(), more.end());
    expect_refused(limpid(words), parts, 2);
  };
  refused({"--size", "20000x10", "--samples", "2"},
          {"size 20000x10", "samples 2", "expected at most 16000"});
  refused({"--size", "20000x10", "--overscan", "9000"}, {"overscan 9000: expected 0 ... 6000"});
  refused({"--size", "30000x30000"}, {"900000000 pixels", "expected at most 134217728"});
}

TEST_F(OptionRangesTest, OfCompare) {
  const std::string up = "a finite number from 0 up";
  expect_ranges({"compare", "absent.exr", "b.exr", "--metrics", "flip"},
                {{"--tolerance", up, {"0", "1e30"}, {"-1", "1e999"}},
                 {"--allowed-percent", "0 ... 100 (%)", {"0", "100"}, {"-1", "100.5", "1e9"}},
                 {"--hard-limit", up, {"0", "7"}, {"-1e-9"}},
                 {"--epsilon", "a finite number above 0", {"1e-9"}, {"0", "-1"}},
                 {"--clip", "a finite number", {"-1", "4"}, {"1e999"}},
                 {"--ppd", "1 ... 1000", {"1", "1000"}, {"0", "0.5", "1001", "-67"}}});
}

TEST_F(OptionRangesTest, OfReport) {
  for (const std::string bad : {"0", "-1", "1001", "nan", "2.5"}) {
    expect_refused(limpid({"report", "-o", "report", "--rounds=" + bad}),
                   {"--rounds " + bad + ": expected a whole number, 1 ... 1000"}, 2);
  }
  for (const std::string bad : {"15x16", "8193x16", "0x0", "nan"}) {
    expect_refused(limpid({"report", "-o", "report", "--size", bad}),
                   {"--size " + bad + ": expected WxH", "16 ... 8192 pixels a side"}, 2);
  }
}

TEST_F(OptionRangesTest, OfMemoryAndFrames) {
  for (const std::string bad : {"0", "-1G", "15M", "nan", "inf", "1e30", "9999999999T", "12X"}) {
    expect_refused(limpid({"inspect", "absent.exr", "--max-memory=" + bad}),
                   {"--max-memory " + bad + ": expected bytes, ", "from 16M up to 4194304T"}, 2);
  }
  expect_refused(limpid({"composite", "absent.exr", "-o", "wet.#.exr", "--frames", "1-2000000"}),
                 {"frames '1-2000000' are 2000000: expected at most 1000000"}, 2);
}

/// An empty argument is not the same as an omitted option.
TEST_F(OptionRangesTest, EmptyWordsAreRefused) {
  for (const std::string option :
       {"--scene", "--layer", "--depth-kind", "--frames", "--look", "--set", "--aov", "-o",
        "--compression", "--simd", "--preview", "--deep", "--runner", "--missing"}) {
    const Ran ran = limpid({"composite", "plate.exr", option, ""});
    expect_refused(ran, {option + " '': expected "}, 2);
  }
  expect_refused(limpid({"composite", "plate.exr", "-o", "wet.exr", "--preview", ""}),
                 {"--preview '': expected OUT.png"}, 2);
  expect_refused(limpid({"compare", "", "b.exr"}), {"a '': expected A"}, 2);
  for (const std::string option : {"--diff", "--flip-map", "--metrics", "--channels", "--frames"}) {
    expect_refused(limpid({"compare", "a.exr", "b.exr", option, ""}), {option + " '': expected "},
                   2);
  }
}

TEST_F(OptionRangesTest, OfLayers) {
  for (const std::string bad :
       {"color=", "=x", "color", "=", "color=:", "color=:R", "depth=plate.exr:"}) {
    for (const std::string verb : {"composite", "inspect"}) {
      Words words{verb, "plate.exr", "--layer", bad};
      if (verb == "composite") words.insert(words.end(), {"-o", "wet.exr"});
      expect_refused(limpid(words), {"--layer " + bad + ": expected ROLE=LAYER, as in "}, 2);
    }
  }
  EXPECT_EQ(limpid({"inspect", "plate.exr", "--layer", "depth=none"}).code, 0);
}

}  // namespace
}  // namespace limpid::test
