#include <gmock/gmock.h>

#include "paths.h"
#include "tool/tool.h"

/// The verb truth, on the scenes of data/scenes.

namespace limpid::test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

using TruthTest = ToolTest;

std::string scene(const std::string& name) { return std::string(LIMPID_DATA) + "/scenes/" + name; }

TEST_F(TruthTest, EveryBundledSceneGivesAPicture) {
  for (const std::string name :
       {"half_submerged", "horizon", "lagoon_shore", "pool", "river", "shading_row"}) {
    const Ran ran = limpid({"truth", scene(name + ".toml"), "--size", "64x36", "-o", name + ".exr",
                            "--preview", name + ".png", "--aov", "all"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_THAT(ran.out,
                ContainsRegex(
                    name +
                    ".exr: 64x36, 1 sample per pixel of 16 paths, noise [0-9.]+ %, look physical, "
                    "trace [0-9.]+ s, write [0-9]+ ms\n" +
                    name + ".png\n"));
    EXPECT_THAT(oiiotool({name + ".exr", "--printstats"}).out,
                HasSubstr("Stats NanCount: 0 0 0 0"));
    EXPECT_THAT(iinfo(name + ".png"), HasSubstr("64 x   36, 3 channel"));
  }
  const std::string info = iinfo("pool.exr");
  for (const char* part : {"transmitted.R", "stmap.b.V", "visible.R", "visible_below.B",
                           "limpid/noise", "light = \\\"paths\\\"", "paths = 16", "limpid/look",
                           "limpid/scene", "limpid/inputs", "worldToCamera"}) {
    EXPECT_THAT(info, HasSubstr(part));
  }
  EXPECT_THAT(info, testing::Not(HasSubstr("confidence")));
}

TEST_F(TruthTest, TheSameJobGivesTheSameBytes) {
  const auto with = [&](const std::string& output, const Words& more) {
    Words words = {"truth", scene("river.toml"), "--size", "48x27", "--samples", "2", "-o", output};
    words.insert(words.end(), more.begin(), more.end());
    return limpid(words).code;
  };
  ASSERT_EQ(with("one.exr", {"--threads", "1"}), 0);
  ASSERT_EQ(with("two.exr", {"--threads", "2"}), 0);
  ASSERT_EQ(with("other.exr", {"--seed", "7"}), 0);
  EXPECT_EQ(text_of("one.exr"), text_of("two.exr"));
  EXPECT_FALSE(same("one.exr", "other.exr"));
}

TEST_F(TruthTest, LightIsScatteredAnyNumberOfTimesOrOnce) {
  const auto with = [&](const std::string& output, const Words& more) {
    Words words = {"truth", scene("river.toml"), "--size", "48x27", "-o", output};
    words.insert(words.end(), more.begin(), more.end());
    return limpid(words);
  };
  const Ran once = with("once.exr", {"--light", "once"});
  ASSERT_EQ(once.code, 0) << once.err;
  EXPECT_THAT(once.out, HasSubstr("1 sample per pixel, look"));
  EXPECT_THAT(iinfo("once.exr"), HasSubstr("light = \\\"once\\\""));
  EXPECT_THAT(iinfo("once.exr"), testing::Not(HasSubstr("limpid/noise")));
  const Ran few = with("few.exr", {"--paths", "4"});
  EXPECT_THAT(few.out, HasSubstr("of 4 paths, noise "));
  ASSERT_EQ(with("paths.exr", {"--light", "paths", "--paths", "4"}).code, 0);
  EXPECT_EQ(text_of("paths.exr"), text_of("few.exr"));
  EXPECT_FALSE(same("once.exr", "few.exr"));
  ASSERT_EQ(with("focused.exr", {"--paths", "4", "--photons", "20000"}).code, 0);
  EXPECT_THAT(iinfo("focused.exr"), HasSubstr("photons = 20000"));
  EXPECT_FALSE(same("focused.exr", "few.exr"));
}

TEST_F(TruthTest, TakesTheLookAndTheTimeAndNumbersFrames) {
  const Words base = {"truth", scene("pool.toml"), "--size", "32x18", "--aov", "in_scatter"};
  const auto with = [&](const Words& more) {
    Words words = base;
    words.insert(words.end(), more.begin(), more.end());
    return limpid(words);
  };
  ASSERT_EQ(with({"--frames", "1-3x2", "--fps", "1", "-o", "truth.%02d.exr"}).code, 0);
  ASSERT_EQ(with({"--time", "3", "-o", "three.exr"}).code, 0);
  EXPECT_EQ(text_of("truth.03.exr"), text_of("three.exr"));
  EXPECT_FALSE(same("truth.01.exr", "truth.03.exr"));
  ASSERT_EQ(with({"--time", "3", "--aov", "in_scatter,in_scatter", "-o", "once.exr"}).code, 0);
  EXPECT_EQ(text_of("once.exr"), text_of("three.exr"));
  ASSERT_EQ(with({"--set", "depth_fog.scattering=[0, 0, 0]", "-o", "clear.exr"}).code, 0);
  EXPECT_THAT(oiiotool({"clear.exr", "--ch", "in_scatter.R", "--printstats"}).out,
              HasSubstr("Stats Max: 0.0"));
}

TEST_F(TruthTest, RefusesInOneSentence) {
  const auto refused = [&](const Words& more, const Words& parts, int code) {
    Words words = {"truth", scene("pool.toml"), "--size", "16x9", "-o", "x.exr"};
    words.insert(words.end(), more.begin(), more.end());
    expect_refused(limpid(words), parts, code);
  };
  refused({"--aov", "confidence"}, {"confidence", "visible"}, 2);
  refused({"--aov", "visibl"}, {"'visibl' is not an AOV"}, 2);
  refused({"--aov", "all,visibl"}, {"'visibl' is not an AOV", "did you mean 'visible'?"}, 2);
  refused({"--aov", "all,confidence"}, {"'confidence' is not an AOV"}, 2);
  refused({"--aov", "mirror_sources"}, {"'mirror_sources' is not an AOV", "visible"}, 2);
  refused({"--samples", "17"}, {"--samples 17", "1 ... 16"}, 2);
  refused({"--paths", "0"}, {"--paths 0", "1 ... 65536"}, 2);
  refused({"--light", "twice"}, {"--light twice", "paths or once"}, 2);
  refused({"--light", "once", "--paths", "9"}, {"--paths 9", "single scattering"}, 2);
  refused({"--light", "once", "--photons", "9"}, {"photons = 9", "light = paths"}, 2);
  refused({"--set", "depth_fog.sunlight=straight", "--photons", "9"},
          {"photons = 9", "depth_fog.sunlight = refracted"}, 2);
  refused({"--overscan", "4"}, {"has no option '--overscan'"}, 2);
  refused({"--preview", "no/such/folder/x.png"}, {"no/such/folder"}, 1);
  expect_refused(limpid({"truth", scene("pool.toml"), "--size", "32000x32000", "-o", "x.exr"}),
                 {"1024000000 pixels", "expected at most 134217728"}, 2);
  expect_refused(limpid({"truth", scene("pool.toml")}), {"-o OUT.exr"}, 2);
  expect_refused(limpid({"truth", scene("none.toml"), "-o", "x.exr"}), {"none.toml"}, 1);
}

}  // namespace
}  // namespace limpid::test
