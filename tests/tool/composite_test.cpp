#include <gmock/gmock.h>

#include "limpid/files/picture/image_file.h"
#include "limpid/run/fused.h"

#include "tool/made_plate.h"
#include "tool/tool.h"

namespace limpid::test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

using CompositeTest = ToolTest;

TEST_F(CompositeTest, WritesHalfPizAndSaysSo) {
  const Ran ran = composite("wet.exr");
  EXPECT_EQ(ran.code, 0);
  EXPECT_EQ(ran.err, "");
  EXPECT_THAT(ran.out, ContainsRegex("^wet\\.exr: 64x36, look look, read [0-9]+ ms, run [0-9]+ ms, "
                                     "write [0-9]+ ms\n$"));
  const std::string info = iinfo("wet.exr");
  EXPECT_THAT(info, HasSubstr("64 x   36, 4 channel, half openexr"));
  EXPECT_THAT(info, HasSubstr("channel list: R, G, B, A\n"));
  EXPECT_THAT(info, HasSubstr("compression: \"piz\""));
  EXPECT_EQ(files(), (Words{"look.toml", "plate.exr", "scene.toml", "waves.exr", "wet.exr"}));
}

TEST_F(CompositeTest, PutsWaterWhereThereIsWaterAndNowhereElse) {
  composed("wet.exr");
  const std::string shore = "16x31+0+5", sky = "64x3+0+0", pond = "48x20+16+16";
  for (const std::string& dry : {shore, sky}) {
    const Ran ran = oiiotool({"--fail", "0", "plate.exr", "--ch", "R,G,B,A", "--cut", dry,
                              "wet.exr", "--cut", dry, "--diff"});
    EXPECT_EQ(ran.code, 0) << ran.out;
  }
  const Ran wet = oiiotool({"--fail", "0.01", "--failpercent", "50", "plate.exr", "--ch", "R,G,B",
                            "--cut", pond, "wet.exr", "--ch", "R,G,B", "--cut", pond, "--diff"});
  EXPECT_EQ(wet.code, 1) << wet.out;
}

TEST_F(CompositeTest, FloatIsMorePrecise) {
  composed("half.exr");
  composed("float.exr", {"--float"});
  EXPECT_THAT(iinfo("float.exr"), HasSubstr("4 channel, float openexr"));
  EXPECT_TRUE(same("half.exr", "float.exr", 2e-3));
  EXPECT_FALSE(same("half.exr", "float.exr", 0));
}

/// The values of all attributes of that name, as iinfo prints them, without quotes.
Words values_of(const std::string& name, const std::string& info) {
  Words values;
  const std::string before = "    " + name + ": \"";
  for (std::size_t at = info.find(before); at != std::string::npos; at = info.find(before, at)) {
    at += before.size();
    values.push_back(info.substr(at, info.find('"', at) - at));
  }
  return values;
}

TEST_F(CompositeTest, EveryCompressionHoldsThePicture) {
  const auto expect_alike = [&](const std::string& name, const std::string& tolerance) {
    composed(name + ".exr", {"--compression", name});
    const Ran ran = limpid({"compare", name + ".exr", "piz.exr", "--tolerance", tolerance});
    EXPECT_EQ(ran.code, 0) << name << ":\n" << ran.out << ran.err;
  };
  Words written;
  for (const std::string name : {"piz", "none", "rle", "zips", "zip", "zip:9"}) {
    expect_alike(name, "0");
    written.push_back(name + ".exr");
  }
  for (const std::string name : {"pxr24", "b44", "b44a", "dwaa", "dwab", "dwaa:20"}) {
    expect_alike(name, "0.1");
    written.push_back(name + ".exr");
  }
  EXPECT_EQ(values_of("compression", iinfo(written)),
            (Words{"piz", "none", "rle", "zips", "zip", "zip", "pxr24", "b44", "b44a", "dwaa",
                   "dwab", "dwaa"}));
}

TEST_F(CompositeTest, AllAovsAreThereInTheirTypes) {
  composed("aovs.exr", {"--aov", "all"});
  EXPECT_THAT(
      iinfo("aovs.exr"),
      HasSubstr(
          "channel list: R (half), G (half), B (half), A (half), confidence.Y (half), "
          "fresnel.Y (half), highlight.R (half), highlight.G (half), highlight.B (half), "
          "in_scatter.R (half), in_scatter.G (half), in_scatter.B (half), "
          "mirror_sources.R (half), mirror_sources.G (half), mirror_sources.B (half), normal.X "
          "(half), "
          "normal.Y (half), normal.Z (half), path.Z (float), reflected.R (half), "
          "reflected.G (half), reflected.B (half), reflection_depth.Z (float), reflection_valid.Y "
          "(half), sky.R (half), sky.G (half), sky.B (half), stmap.b.U (float), stmap.b.V (float), "
          "stmap.g.U (float), stmap.g.V (float), stmap.r.U (float), stmap.r.V (float), "
          "surface_depth.Z (float), surface_shadow.Y (half), transmittance.R (half), "
          "transmittance.G (half), "
          "transmittance.B (half), transmitted.R (half), transmitted.G (half), transmitted.B "
          "(half)\n"));
  composed("two.exr", {"--aov", "path,fresnel"});
  EXPECT_THAT(iinfo("two.exr"), HasSubstr("channel list: R (half), G (half), B (half), A (half), "
                                          "fresnel.Y (half), path.Z (float)\n"));
  composed("again.exr", {"--aov", "path,fresnel,path"});
  EXPECT_TRUE(same("two.exr", "again.exr"));
  composed("plain.exr");
  EXPECT_EQ(oiiotool({"--fail", "0", "aovs.exr", "--ch", "R,G,B,A", "plain.exr", "--diff"}).code,
            0);
}

/// Adds the four terms of the file up and compares them with its picture.
Words sum_against_picture(const std::string& file, const std::string& tolerance) {
  Words words{"--fail", tolerance, "--warn", tolerance};
  for (const std::string term : {"transmitted", "in_scatter", "reflected", "highlight"}) {
    words.insert(words.end(), {file, "--ch", "R=" + term + ".R,G=" + term + ".G,B=" + term + ".B"});
    if (term != "transmitted") words.push_back("--add");
  }
  words.insert(words.end(), {file, "--ch", "R,G,B", "--diff"});
  return words;
}

TEST_F(CompositeTest, AovsSumToThePicture) {
  composed("half.exr", {"--aov", "all"});
  composed("float.exr", {"--aov", "all", "--float"});
  EXPECT_EQ(oiiotool(sum_against_picture("half.exr", "2e-3")).code, 0);
  EXPECT_EQ(oiiotool(sum_against_picture("float.exr", "0")).code, 0);
  for (const std::string term : {"in_scatter", "reflected", "highlight"}) {  // none is zero
    const Ran ran = oiiotool({"float.exr", "--ch", term + ".G", "--printstats"});
    EXPECT_THAT(ran.out, Not(HasSubstr("Stats Max: 0.000000"))) << term;
  }
}

TEST_F(CompositeTest, ThePreviewIsAPicture) {
  const Ran ran = composite("wet.exr", {"--preview", "wet.png"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, ::testing::EndsWith("\nwet.png\n"));
  EXPECT_THAT(iinfo("wet.png"), HasSubstr("64 x   36, 3 channel, uint8 png"));
  // The preview is the picture in sRGB, to half a step of 8 bits.
  const Ran alike = oiiotool({"--fail", "0.005", "wet.exr", "--ch", "R,G,B", "--clamp:min=0:max=1",
                              "--colorconvert", "linear", "sRGB", "wet.png", "--diff"});
  EXPECT_EQ(alike.code, 0) << alike.out << alike.err;
}

TEST_F(CompositeTest, KeepsTheAttributesAndAddsItsOwn) {
  composed("wet.exr", {"--set", "water_shadow.strength=0"});
  const std::string info = iinfo("wet.exr");
  EXPECT_THAT(info, HasSubstr("pond/studio: \"shallow end\""));
  EXPECT_THAT(info, HasSubstr("shot/take: \"12b\""));
  EXPECT_THAT(info, ContainsRegex("limpid/version: \"[0-9]+\\.[0-9]+\\.[0-9]+\""));
  EXPECT_THAT(info, ContainsRegex("limpid/plan: \"wave_normals +kept"));
  EXPECT_THAT(info, ContainsRegex("water_shadow +skipped: neutral"));
  EXPECT_THAT(info, HasSubstr("limpid/look: \""));
  EXPECT_THAT(info, HasSubstr("[refraction]"));
}

TEST_F(CompositeTest, ItsOwnOutputIsAPlate) {
  composed("wet.exr", {"--layer", "depth=plate.exr"});
  const Ran ran = limpid({"composite", "wet.exr", "--layer", "depth=plate.exr", "--scene",
                          "scene.toml", "--look", "look.toml", "-o", "wetter.exr", "-q"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_FALSE(same("wetter.exr", "wet.exr", 0.01));
}

TEST_F(CompositeTest, SettingsWinOverTheLook) {
  composed("wet.exr");
  composed("same.exr", {"--set", "depth_fog.density=0.15"});
  composed("clear.exr", {"--set", "depth_fog.density=0"});
  composed("red.exr", {"--set", "depth_fog.density=1", "--set", "depth_fog.color=[1, 0, 0]"});
  EXPECT_TRUE(same("wet.exr", "same.exr"));
  EXPECT_FALSE(same("wet.exr", "clear.exr", 0.01));
  EXPECT_FALSE(same("wet.exr", "red.exr", 0.1));
  EXPECT_THAT(iinfo("red.exr"), HasSubstr("color = [1.0, 0.0, 0.0]"));
}

TEST_F(CompositeTest, AnErrorIsKeptWithinAndRecorded) {
  composed("wet.exr", {"--float"});
  composed("zero.exr", {"--float", "--max-error", "0"});
  composed("near.exr", {"--float", "--max-error", "0.03"});
  EXPECT_EQ(text_of("wet.exr"), text_of("zero.exr"));
  EXPECT_TRUE(same("wet.exr", "near.exr", 0.03001));
  EXPECT_THAT(iinfo("near.exr"), ContainsRegex("max_error +0.03"));
}

TEST_F(CompositeTest, PlanTellsTheKindsOfCells) {
  const std::vector<std::string> before = files();
  const Ran exact = limpid({"plan", "plate.exr", "--scene", "scene.toml", "--look", "look.toml"});
  EXPECT_EQ(exact.code, 0) << exact.err;
  EXPECT_THAT(exact.out, ContainsRegex("\n  all +3 +100.0 %"));
  EXPECT_THAT(exact.out, ContainsRegex("\n  opaque +0 "));
  EXPECT_THAT(exact.out, ContainsRegex("\n  refraction +100.0 % .* ms"));
  EXPECT_THAT(exact.out, Not(HasSubstr("max_error")));
  const Ran lost = limpid(
      {"plan", "plate.exr", "--scene", "scene.toml", "--look", "look.toml", "--max-error", "1e6"});
  EXPECT_THAT(lost.out, ContainsRegex("depth_fog +skipped: invisible, no channel of a pixel "
                                      "changes by more than .* \\[skip_invisible\\]"));
  EXPECT_THAT(lost.out, HasSubstr("max_error 1e+06: no pixel has an error above "));
  EXPECT_EQ(files(), before) << "nothing is written";
}

TEST_F(CompositeTest, PlanMeasuresWhatItPredicts) {
  const std::vector<std::string> before = files();
  const auto plan = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"plan",       "plate.exr", "--scene",
                                   "scene.toml", "--look",    "look.toml"};
    words.insert(words.end(), more.begin(), more.end());
    return limpid(words);
  };
  EXPECT_THAT(plan({}).out, Not(HasSubstr("measured")));
  const Ran ran = plan({"--measure"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, ContainsRegex("\ntime .* predicted +measured\n"));
  EXPECT_THAT(ran.out, ContainsRegex("\n  refraction +100.0 % +[0-9.]+ ms +[0-9.]+ ms\n"));
  EXPECT_THAT(ran.out, ContainsRegex("\n  sum +[0-9.]+ ms +[0-9.]+ ms\n"));
  EXPECT_EQ(files(), before) << "nothing is written";
}

TEST_F(CompositeTest, PlansTheCausticsOfAWaveMap) {
  const auto cells = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"plan",   "plate.exr", "--scene", "scene.toml",
                                   "--look", "physical",  "-q"};
    words.insert(words.end(), more.begin(), more.end());
    const std::string text = limpid(words).out;
    return text.substr(0, text.find("\ntime"));
  };
  EXPECT_THAT(cells({}), ContainsRegex("\ncaustics +kept"));
  EXPECT_EQ(cells({}), cells({"--measure"})) << "what is planned is what runs";
}

TEST_F(CompositeTest, LooksComeByNameAndByFile) {
  const auto with_look = [&](const std::string& look, const std::string& output) {
    return limpid(
        {"composite", "plate.exr", "--scene", "scene.toml", "--look", look, "-o", output});
  };
  const Ran named = with_look("realistic", "realistic.exr");
  EXPECT_EQ(named.code, 0) << named.err;
  EXPECT_THAT(named.out, HasSubstr(", look realistic,"));
  write_text("calm.toml", "[wave_normals]\nstrength = 0.0\n");
  const Ran file = with_look("calm.toml", "calm.exr");
  EXPECT_EQ(file.code, 0) << file.err;
  EXPECT_THAT(file.out, HasSubstr(", look calm,"));
  EXPECT_FALSE(same("realistic.exr", "calm.exr", 0.01));
}

TEST_F(CompositeTest, TimeMovesTheWaves) {
  composed("now.exr");
  composed("zero.exr", {"--time", "0"});
  composed("later.exr", {"--time", "1.5"});
  EXPECT_TRUE(same("now.exr", "zero.exr"));
  EXPECT_FALSE(same("now.exr", "later.exr", 0.001));
}

TEST_F(CompositeTest, ThreadsDoNotChangeAByte) {
  composed("one.exr", {"--threads", "1"});
  composed("two.exr", {"--threads", "2", "--aov", "path"});
  composed("two_again.exr", {"--threads", "2"});
  EXPECT_EQ(text_of("one.exr"), text_of("two_again.exr"));
  EXPECT_NE(text_of("one.exr"), text_of("two.exr"));
}

TEST_F(CompositeTest, EveryInstructionSetGivesThePicture) {
  composed("reference.exr", {"--runner", "reference", "--float"});
  for (const std::string& name : simd_targets()) {
    composed("simd.exr", {"--simd", name, "--float"});
    EXPECT_TRUE(same("simd.exr", "reference.exr", 3e-4)) << name;
  }
  expect_no_composite({"plate.exr", "--scene", "scene.toml", "--simd", "nonsense"},
                      {"--simd nonsense: expected one of ", "scalar", " on this machine"}, 2);
  expect_no_composite(
      {"plate.exr", "--scene", "scene.toml", "--runner", "reference", "--simd", "scalar"},
      {"--simd scalar: the reference runner has no instruction sets"}, 2);
}

TEST_F(CompositeTest, VerboseTellsLayersAndPlan) {
  const Ran ran = composite("wet.exr", {"-v"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, StartsWith("plate.exr\n"));
  EXPECT_THAT(ran.out, ContainsRegex("refraction +kept"));
}

TEST_F(CompositeTest, PlanAndDryRunWriteNothing) {
  const std::vector<std::string> before = files();
  const Ran dry = composite("wet.exr", {"-n", "--preview", "wet.png"});
  const Ran plan = limpid({"plan", "plate.exr", "--scene", "scene.toml", "--look", "look.toml",
                           "--set", "water_shadow.strength=0", "--layer", "reflection=none"});
  EXPECT_EQ(files(), before);
  EXPECT_EQ(dry.code, 0) << dry.err;
  EXPECT_EQ(plan.code, 0) << plan.err;
  EXPECT_THAT(dry.out, ContainsRegex("fresnel_reflection +kept"));
  EXPECT_THAT(plan.out, ContainsRegex("fresnel_reflection +skipped: input absent, no reflection"));
  EXPECT_THAT(plan.out, ContainsRegex("water_shadow +skipped: neutral"));
}

TEST_F(CompositeTest, SaysWhatDoesNotRunForWantOfInput) {
  const Ran ran = composite("wet.exr", {"--layer", "shadow=none"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("\nwater_shadow does not run: no shadow\n"));
}

TEST_F(CompositeTest, TheBrightestSunMakesNoInfinity) {
  const auto scene_of = [](const std::string& color) {
    std::string scene = scene_toml();
    const std::string usual = "[3, 2.8, 2.5]";
    return scene.replace(scene.find(usual), usual.size(), color);
  };
  write_text("scene.toml", scene_of("[1e9, 1e9, 1e9]"));
  const Words strongest = {"--set", "sun_highlight.strength=1e6",
                           "--set", "depth_fog.model=beer_lambert",
                           "--set", "depth_fog.scattering=[100, 100, 100]"};
  for (const Words& glint :
       {Words{"--set", "sun_highlight.model=ggx", "--set", "sun_highlight.roughness=0.01"},
        Words{"--set", "sun_highlight.power=0"}}) {
    for (const Words& kind : {Words{}, Words{"--float"}, Words{"--runner", "reference"}}) {
      Words more = strongest;
      more.insert(more.end(), glint.begin(), glint.end());
      more.insert(more.end(), kind.begin(), kind.end());
      more.insert(more.end(), {"--aov", "in_scatter,highlight", "--deep", "deep.exr"});
      composed("wet.exr", more);
      const std::string stats =
          oiiotool({"wet.exr", "--ch", "R,G,B,A,highlight.R,in_scatter.R", "--printstats"}).out;
      EXPECT_THAT(stats, HasSubstr("Stats NanCount: 0 0 0 0 0 0"));
      EXPECT_THAT(stats, HasSubstr("Stats InfCount: 0 0 0 0 0 0"));
      EXPECT_THAT(stats, Not(ContainsRegex("Stats Max: [0-9]{1,4}\\."))) << "it is bright";
    }
  }
  write_text("scene.toml", scene_of("[1, 1.1e9, 1]"));
  expect_no_composite({"plate.exr", "--scene", "scene.toml"},
                      {"scene.toml", "color", "three numbers, each 0 ... 1e+09"});
}

TEST_F(CompositeTest, CountsWhatItReplaced) {
  write_plate(folder_ / "plate.exr", {.broken = true});
  const Ran ran = composite("wet.exr", {"--aov", "transmitted,path"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("; replaced: color 1 NaN 1 inf, depth 1 NaN, shadow 1 NaN\n"));
  const Ran stats = oiiotool({"wet.exr", "--ch", "R,G,B,A", "--printstats"});
  EXPECT_THAT(stats.out, HasSubstr("Stats NanCount: 0 0 0 0"));
  EXPECT_THAT(stats.out, HasSubstr("Stats InfCount: 0 0 0 0"));
}

}  // namespace
}  // namespace limpid::test
