#include <gmock/gmock.h>

#include "paths.h"
#include "tool/made_plate.h"
#include "tool/tool.h"

/// The verbs render and water, on the scenes of data/scenes.

namespace limpid::test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

using WaterTest = ToolTest;

std::string scene(const std::string& name) { return std::string(LIMPID_DATA) + "/scenes/" + name; }

TEST_F(WaterTest, EveryBundledSceneGivesAPicture) {
  for (const std::string name :
       {"half_submerged", "horizon", "lagoon_shore", "pool", "river", "shading_row"}) {
    const Ran ran = limpid({"water", scene(name + ".toml"), "--size", "96x54", "-o", name + ".exr",
                            "--aov", "all", "--preview", name + ".png", "-q"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(ran.out + ran.err, "");
    const std::string info = iinfo(name + ".exr");
    EXPECT_THAT(info, HasSubstr("96 x   54"));
    EXPECT_THAT(info, HasSubstr("transmitted.R"));
    EXPECT_THAT(info, HasSubstr("limpid/scene"));
    EXPECT_THAT(iinfo(name + ".png"), HasSubstr("96 x   54, 3 channel"));
  }
}

TEST_F(WaterTest, RenderThenCompositeIsWaterToTheBit) {
  const Words size = {"--size", "160x90", "--overscan", "6", "--time", "0.7", "--float"};
  const auto with = [&](Words words) {
    words.insert(words.end(), size.begin(), size.end());
    return limpid(words);
  };
  for (const std::string name : {"pool", "river"}) {
    EXPECT_EQ(with({"render", scene(name + ".toml"), "-o", "rendered.exr"}).code, 0);
    const Ran over = limpid({"composite", "rendered.exr", "-o", "two_steps.exr", "--float"});
    EXPECT_EQ(over.code, 0) << over.err;
    EXPECT_EQ(with({"water", scene(name + ".toml"), "-o", "one_step.exr"}).code, 0);
    EXPECT_TRUE(same("two_steps.exr", "one_step.exr")) << name;
  }
}

TEST_F(WaterTest, RenderedPlatesExplainThemselves) {
  ASSERT_EQ(limpid({"render", scene("pool.toml"), "--size", "64x36", "-o", "rendered.exr"}).code,
            0);
  const Ran ran = limpid({"inspect", "rendered.exr"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  for (const char* line :
       {"color +color.R G B A", "depth +depth.Z", "shadow +shadow.Y",
        "reflection +reflection.R G B", "surface_depth +surface.Z",
        "surface_normal +surface.NX NY NZ", "reflection_valid +reflection.A",
        "reflection_depth +reflection.Z", "below_color +below.R G B", "below_depth +below.Z",
        "surface_shadow +surface_shadow.Y", "sun_color +sun_color.R G B"}) {
    EXPECT_THAT(ran.out, ContainsRegex(line));
  }
  EXPECT_THAT(iinfo("rendered.exr"), HasSubstr("worldToCamera"));
}

TEST_F(WaterTest, TheCameraMayBeInTheWater) {
  write_text("deep.toml",
             "[geometry]\ngltf = \"" + scene("pool.gltf") + "\"\n[water]\nheight = 100\n");
  const Words size = {"--size", "64x36", "-o"};
  const auto with = [&](Words words, const std::string& output) {
    words.insert(words.end(), size.begin(), size.end());
    words.push_back(output);
    return limpid(words);
  };
  const Ran rendered = with({"render", "deep.toml"}, "rendered.exr");
  EXPECT_EQ(rendered.code, 0) << rendered.err;
  const std::string info = iinfo("rendered.exr");
  EXPECT_THAT(info, HasSubstr("surface.Z"));
  EXPECT_THAT(info, HasSubstr("reflection.R"));  // the reflection at the water's underside
  const Ran wet = with({"water", "deep.toml", "--look", "realistic"}, "wet.exr");
  EXPECT_EQ(wet.code, 0) << wet.err;
  EXPECT_THAT(wet.out, ::testing::Not(HasSubstr("does not run")));
  EXPECT_THAT(oiiotool({"wet.exr", "--printstats"}).out, HasSubstr("Stats NanCount: 0 0 0 0"));
}

TEST_F(WaterTest, OnlyWhatTheLookNeedsIsRendered) {
  const Ran ran = limpid({"water", scene("pool.toml"), "-n", "--look", "realistic", "--set",
                          "refraction.strength=0", "--set", "prism_split.strength=0"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, ContainsRegex("refraction +skipped: neutral"));
}

TEST_F(WaterTest, SequencesNumberTheirFiles) {
  const Ran ran = limpid(
      {"water", scene("pool.toml"), "--size", "48x27", "--frames", "1-5x2", "-o", "wet.%04d.exr"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_FALSE(same("wet.0001.exr", "wet.0003.exr"));
  EXPECT_THAT(iinfo("wet.0005.exr"), HasSubstr("48 x   27"));
  expect_refused(limpid({"water", scene("pool.toml"), "--frames", "1-5", "-o", "wet.exr"}),
                 {"wet.exr", "%04d"}, 2);
}

TEST_F(WaterTest, SamplesAreFilteredAfterTheWaterIsIn) {
  const Words base = {"water", scene("pool.toml"), "--size", "64x36", "--float", "-o"};
  const auto with = [&](const std::string& output, const Words& more) {
    Words words = base;
    words.push_back(output);
    words.insert(words.end(), more.begin(), more.end());
    return limpid(words).code;
  };
  ASSERT_EQ(with("four.exr", {"--samples", "2"}), 0);
  ASSERT_EQ(
      limpid({"water", scene("pool.toml"), "--size", "128x72", "--float", "-o", "large.exr"}).code,
      0);
  // Averaging the large picture by hand gives the same pixels.
  ASSERT_EQ(oiiotool({"large.exr", "--resize:filter=box", "64x36", "-o", "small.exr"}).code, 0);
  EXPECT_TRUE(same("four.exr", "small.exr", 1e-5));
  expect_refused(limpid({"water", scene("pool.toml"), "--samples", "0", "-o", "x.exr"}),
                 {"--samples 0", "1 ... 16"}, 2);
}

TEST_F(WaterTest, RefusesScenesThatCannotBeRendered) {
  const auto refused = [&](const Words& words, const Words& parts, int code = 1) {
    Words all = {"water"};
    all.insert(all.end(), words.begin(), words.end());
    all.insert(all.end(), {"-o", "x.exr"});
    expect_refused(limpid(all), parts, code);
  };
  write_text("no_geometry.toml", "[water]\nheight = 0\n");
  refused({"no_geometry.toml"}, {"no_geometry.toml", "[geometry]"});
  write_text("absent.toml", "[geometry]\ngltf = \"absent.gltf\"\n[water]\nheight = 0\n");
  refused({"absent.toml"}, {"absent.gltf"});
  write_text("broken.gltf", "{");
  write_text("broken.toml", "[geometry]\ngltf = \"broken.gltf\"\n[water]\nheight = 0\n");
  refused({"broken.toml"}, {"broken.gltf"});
  write_text("dry.toml", "[geometry]\ngltf = \"" + scene("pool.gltf") + "\"\n");
  refused({"dry.toml"}, {"no water plane"});
  refused({scene("pool.toml"), "--size", "0x9"}, {"--size 0x9", "1 ... 32000"}, 2);
  refused({scene("pool.toml"), "--size", "big"}, {"--size big", "1920x1080"}, 2);
}

}  // namespace
}  // namespace limpid::test
