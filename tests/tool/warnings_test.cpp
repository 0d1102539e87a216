#include <algorithm>

#include <gmock/gmock.h>

#include "paths.h"
#include "tool/made_plate.h"
#include "tool/tool.h"

/// Each option or parameter that has no effect is named on stderr, once, in a line of its own.

namespace limpid::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class WarningsTest : public ToolTest {
 protected:
  WarningsTest() {
    write_plate(folder_ / "plate.exr");
    write_waves(folder_ / "waves.exr");
    write_text("scene.toml", scene_toml());
    write_text("look.toml", look_toml());
  }
  /// The scene with the water at this height.
  void raise_water(const std::string& height) const {
    std::string text = scene_toml();
    const std::string old = "height = 0.0";
    text.replace(text.find(old), old.size(), "height = " + height);
    write_text("scene.toml", text);
  }
  /// Every ray hits a surface.
  void close_plate(const std::string& file) const {
    PlateOptions closed;
    closed.depth_code = [](double z, double) { return z < 1e9 ? z : 60; };
    write_plate(folder_ / file, closed);
  }
  static long lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }
};

TEST_F(WarningsTest, AUsualPictureHasNone) {
  const Ran ran = composite("wet.exr");
  EXPECT_EQ(ran.code, 0);
  EXPECT_EQ(ran.err, "");
}

TEST_F(WarningsTest, ASettingThatAnotherSwitchesOff) {
  const Words setting = {"--set", "prism_split.gain=2"};
  const Ran ran = composite("wet.exr", setting);
  EXPECT_EQ(ran.code, 0);
  EXPECT_EQ(ran.err,
            "limpid: warning: prism_split.gain = 2 changes nothing: model is axis, expected model "
            "= dispersion\n");
  const Ran plan = limpid({"plan", "plate.exr", "--scene", "scene.toml", "--look", "look.toml",
                           setting[0], setting[1]});
  EXPECT_EQ(plan.err, ran.err);
  EXPECT_EQ(composite("wet.exr", {setting[0], setting[1], "-q"}).err, "");
}

TEST_F(WarningsTest, AnAbsorptionWinsOverTheTypeOfTheLook) {
  write_text("named.toml", "[depth_fog]\nwater_type = \"9C\"\n");
  // The plate's reflection has no depth, which a look with reflection lookups along the ray warns
  // of, and no overscan.
  const Words plain = {"composite", "plate.exr",
                       "--scene",   "scene.toml",
                       "--set",     "fresnel_reflection.lookup=offset",
                       "--set",     "refraction.model=normal_offset",
                       "--float",   "-o"};
  const auto with = [&](const std::string& output, const Words& more) {
    Words words = plain;
    words.push_back(output);
    words.insert(words.end(), more.begin(), more.end());
    const Ran ran = limpid(words);
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(ran.err, "");
  };
  with("a.exr", {"--look", "named.toml", "--set", "depth_fog.absorption=2,1,0.5"});
  with("b.exr", {"--look", "named.toml", "--set", "depth_fog.water_type=custom", "--set",
                 "depth_fog.absorption=2,1,0.5"});
  with("c.exr", {"--look", "named.toml"});
  EXPECT_TRUE(same("a.exr", "b.exr"));
  EXPECT_FALSE(same("a.exr", "c.exr"));
}

TEST_F(WarningsTest, ALayerThatNothingReads) {
  const Words named = {"--layer", "shadow=shadow.Y"};
  EXPECT_EQ(composite("wet.exr", named).err, "");
  const Ran ran = composite("wet.exr", {named[0], named[1], "--set", "water_shadow.strength=0",
                                        "--set", "sun_highlight.strength=0"});
  EXPECT_EQ(ran.err,
            "limpid: warning: the layer shadow is named, and no running operator of the look look "
            "reads it\n");
  // A buffer that was found by its name, not by --layer, causes no warning.
  EXPECT_EQ(composite("wet.exr",
                      {"--set", "water_shadow.strength=0", "--set", "sun_highlight.strength=0"})
                .err,
            "");
}

TEST_F(WarningsTest, ASkyThatLightsNothing) {
  write_text("scene.toml", scene_toml() + "[sky]\nradiance = [0.3, 0.3, 0.4]\n");
  const std::string model = "depth_fog.model=";
  EXPECT_EQ(composite("wet.exr", {"--set", model + "radiative_transfer"}).err, "");
  EXPECT_EQ(composite("wet.exr", {"--set", model + "beer_lambert"}).err,
            "limpid: warning: [sky] is named, and no running operator of the look look reads it\n");
}

TEST_F(WarningsTest, AGuessedSky) {
  const Words mirrors = {"--layer", "reflection=none", "--set", "fresnel_reflection.source=auto"};
  const auto said = [&](const std::string& more) {
    Words words = mirrors;
    if (!more.empty()) words.insert(words.end(), {"--set", more});
    return composite("wet.exr", words).err;
  };
  const auto guessed = HasSubstr("the picture shows no sky: the water mirrors a sky guessed from");
  EXPECT_THAT(said(""), Not(guessed));
  close_plate("plate.exr");
  EXPECT_THAT(said(""), guessed);
  EXPECT_THAT(said("fresnel_reflection.color=0.2,0.3,0.4"), Not(guessed));
  write_text("scene.toml", scene_toml() + "[sky]\nradiance = [0.3, 0.3, 0.4]\n");
  EXPECT_THAT(said(""), Not(guessed));
  EXPECT_THAT(said("depth_fog.model=beer_lambert"), Not(HasSubstr("[sky]")));
}

TEST_F(WarningsTest, AnAmbientLightThatASkyReplaces) {
  const auto said = [&](const std::string& more) {
    return composite("wet.exr", {"--set", "depth_fog.model=radiative_transfer", "--set", more}).err;
  };
  const std::string nothing = "limpid: warning: depth_fog.ambient changes nothing: ";
  EXPECT_EQ(said("depth_fog.ambient=1,0,0"), nothing + "the picture's sky lights the water\n");
  EXPECT_EQ(said("depth_fog.ambient=.1,.1,.1"), "");
  write_text("scene.toml", scene_toml() + "[sky]\nradiance = [0.3, 0.3, 0.4]\n");
  EXPECT_EQ(said("depth_fog.ambient=1,0,0"), nothing + "the scene's sky lights the water\n");
  close_plate("plate.exr");
  write_text("scene.toml", scene_toml());
  EXPECT_THAT(said("depth_fog.ambient=1,0,0"), Not(HasSubstr("changes nothing")));
}

TEST_F(WarningsTest, LampsThatWavesMirror) {
  const auto told = HasSubstr("of the picture's light is in");
  PlateOptions lit;
  lit.lamp = 90;  // nearly a quarter of the light
  write_plate(folder_ / "plate.exr", lit);
  EXPECT_THAT(composite("wet.exr").err, Not(told));
  lit.lamp = 400;
  write_plate(folder_ / "plate.exr", lit);
  EXPECT_THAT(composite("wet.exr").err,
              HasSubstr("58 % of the picture's light is in 0.17 % of its pixels, like that of "
                        "lamps or the sun: waves mirror them as hard dashes; expected 16 samples"));
  EXPECT_THAT(composite("wet.exr", {"--samples", "2"}).err, Not(told));
  for (const std::string setting : {"reflectance=none", "source=constant"}) {
    EXPECT_THAT(composite("wet.exr", {"--set", "fresnel_reflection." + setting}).err, Not(told));
  }
}

TEST_F(WarningsTest, APictureWithoutAWetPixelOrADryOne) {
  close_plate("plate.exr");
  raise_water("-500");
  const Ran dry = composite("dry.exr");
  EXPECT_EQ(dry.code, 0);
  EXPECT_THAT(dry.err, HasSubstr("limpid: warning: no pixel is wet"));
  EXPECT_EQ(lines(dry.err), 1);
  const Ran plan = limpid({"plan", "plate.exr", "--scene", "scene.toml", "--look", "look.toml"});
  EXPECT_EQ(plan.err, dry.err);

  // Straight down on the bottom and the shore, both under water.
  write_text("scene.toml",
             "[camera]\nview = [[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, -2], [0, 0, 0, 1]]\n"
             "fov_y = 20\n[water]\nheight = 1.9\n");
  const Ran wet = composite("wet.exr");
  EXPECT_EQ(wet.code, 0) << wet.err;
  EXPECT_THAT(wet.err, HasSubstr("limpid: warning: every pixel is wet"));
}

TEST_F(WarningsTest, AreToldOnceOfASequence) {
  for (int frame = 1; frame <= 3; ++frame) {
    close_plate("plate.000" + std::to_string(frame) + ".exr");
  }
  raise_water("-500");
  const Ran ran = limpid({"composite", "plate.#.exr", "--scene", "scene.toml", "--look",
                          "look.toml", "-o", "wet.#.exr", "--frames", "1-3"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(lines(ran.err), 1) << ran.err;
}

TEST_F(WarningsTest, RaysThatLeaveThePicture) {
  const Words refracts{"--set", "refraction.model=snell"};
  const Ran ran = composite("wet.exr", refracts);
  EXPECT_EQ(ran.code, 0);
  EXPECT_EQ(lines(ran.err), 1) << ran.err;
  EXPECT_THAT(ran.err,
              ::testing::ContainsRegex(
                  "limpid: warning: the refracted rays of [0-9.]+ % of the wet pixels leave "
                  "the picture; overscan of color and depth by [0-9]+ pixels? (on|at) the "));
  const Ran plan = limpid({"plan", "plate.exr", "--scene", "scene.toml", "--look", "look.toml",
                           "--set", "refraction.model=snell"});
  EXPECT_EQ(plan.err, ran.err);
  const std::string sentence = ran.err.substr(std::string("limpid: warning: ").size());
  EXPECT_THAT(plan.out, HasSubstr(sentence)) << "on a line of its own";

  PlateOptions wide;
  wide.data = {-40, -40, 104, 76};
  write_plate(folder_ / "plate.exr", wide);
  EXPECT_EQ(composite("wet.exr", refracts).err, "");
  EXPECT_THAT(limpid({"plan", "plate.exr", "--scene", "scene.toml", "--look", "look.toml"}).out,
              HasSubstr("no refracted ray leaves the picture\n"));
}

/// The numbers differ between frames, the sentence does not.
TEST_F(WarningsTest, RaysThatLeaveThePictureAreReportedOnceForASequence) {
  for (int frame = 1; frame <= 3; ++frame) {
    PlateOptions wide;
    wide.data = {0, 0, 64, 35 + frame};
    write_plate(folder_ / ("plate.000" + std::to_string(frame) + ".exr"), wide);
  }
  const Ran ran =
      limpid({"composite", "plate.#.exr", "--scene", "scene.toml", "--look", "look.toml", "--set",
              "refraction.model=snell", "-o", "wet.#.exr", "--frames", "1-3"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(lines(ran.err), 1) << ran.err;
}

TEST_F(WarningsTest, AReflectionWithoutADepth) {
  const Ran ran = composite("wet.exr", {"--set", "fresnel_reflection.lookup=ray"});
  EXPECT_EQ(ran.code, 0);
  EXPECT_THAT(ran.err, HasSubstr("limpid: warning: the reflection has no depth"));
  EXPECT_EQ(lines(ran.err), 1);
  EXPECT_EQ(composite("wet.exr", {"--set", "fresnel_reflection.lookup=ray", "--set",
                                  "fresnel_reflection.source=auto"})
                .err,
            "");
}

TEST_F(WarningsTest, ADepthThatIsNone) {
  PlateOptions mist;
  mist.depth_code = [](double z, double) { return z < 1e9 ? 0.5 : 0.9; };
  write_plate(folder_ / "plate.exr", mist);
  write_text("scene.toml",
             "[camera]\nview = [[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, -2], [0, 0, 0, 1]]\n"
             "fov_y = 20\n[water]\nheight = 1.3\n");
  const Ran ran = composite("wet.exr");
  EXPECT_EQ(ran.code, 0);
  EXPECT_THAT(ran.err, HasSubstr("like a mist pass"));
}

TEST_F(WarningsTest, TilesSmallerThanAPixelAndWiderThanAllWater) {
  EXPECT_THAT(composite("wet.exr", {"--set", "wave_normals.tile_size=0.001"}).err,
              HasSubstr("wave_normals.tile_size = 0.001: a pixel of the nearest water is"));
  EXPECT_THAT(composite("wet.exr", {"--set", "wave_normals.tile_size=1e6"}).err,
              HasSubstr("wave_normals.tile_size = 1e+06: the nearest water in the picture is"));
}

TEST_F(WarningsTest, AreErrorsIfStrict) {
  const Words setting = {"--set", "prism_split.gain=2", "--strict"};
  const Ran ran = composite("strict.exr", setting);
  EXPECT_EQ(ran.code, 1);
  EXPECT_THAT(ran.err, HasSubstr("limpid ERROR: prism_split.gain = 2 changes nothing"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "strict.exr"));
  const Ran plan = limpid({"plan", "plate.exr", "--scene", "scene.toml", "--look", "look.toml",
                           setting[0], setting[1], setting[2]});
  EXPECT_EQ(plan.code, 1);
  EXPECT_EQ(composite("strict.exr", {"--strict"}).code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "strict.exr"));
}

TEST_F(WarningsTest, ShippedLooksHaveNone) {
  for (const std::string look : {"physical", "fast", "realistic", "monogame", "rito"}) {
    const Ran ran = limpid({"water", std::string(LIMPID_DATA) + "/scenes/pool.toml", "--look", look,
                            "--size", "64x36", "-o", "pool.exr"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(ran.err, "") << look;
  }
}

TEST_F(WarningsTest, TheTruthTellsOfItsLookToo) {
  const Ran ran = limpid({"truth", std::string(LIMPID_DATA) + "/scenes/pool.toml", "--size", "16x9",
                          "-o", "truth.exr", "--set", "sun_highlight.power=7"});
  EXPECT_EQ(ran.code, 0);
  EXPECT_EQ(ran.err,
            "limpid: warning: sun_highlight.power = 7 changes nothing: model is slopes, expected "
            "model = phong or blinn_phong\n");
}

TEST_F(WarningsTest, TheTimeOfASceneCountsWhereNoneIsGiven) {
  write_text("scene.toml", scene_toml() + "[scene]\ntime = 2.5\n");
  composed("scene_time.exr");
  composed("given.exr", {"--time", "2.5"});
  composed("other.exr", {"--time", "0"});
  EXPECT_TRUE(same("scene_time.exr", "given.exr"));
  EXPECT_FALSE(same("scene_time.exr", "other.exr"));
  // The frames of a sequence begin at this time.
  write_plate(folder_ / "plate.0024.exr");
  const Ran ran = limpid({"composite", "plate.#.exr", "--scene", "scene.toml", "--look",
                          "look.toml", "-o", "wet.#.exr", "--frames", "24", "-q"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  composed("later.exr", {"--time", "3.5"});
  EXPECT_TRUE(same("wet.0024.exr", "later.exr"));
}

TEST_F(WarningsTest, TheTimeOfARenderedSceneCountsToo) {
  const std::string pool = std::string(LIMPID_DATA) + "/scenes/pool";
  write_text("timed.toml",
             "[geometry]\ngltf = \"" + pool +
                 ".gltf\"\n[water]\nwaves = [[0.05, 1, 2, 0]]\n[scene]\ntime = 1.5\n");
  const auto with = [&](const std::string& verb, const std::string& output, const Words& more) {
    Words words = {verb, "timed.toml", "--size", "48x27", "-q", "-o", output};
    words.insert(words.end(), more.begin(), more.end());
    const Ran ran = limpid(words);
    EXPECT_EQ(ran.code, 0) << ran.err;
  };
  for (const std::string verb : {"water", "render", "truth"}) {
    with(verb, "own.exr", {});
    with(verb, "given.exr", {"--time", "1.5"});
    with(verb, "other.exr", {"--time", "0"});
    EXPECT_TRUE(same("own.exr", "given.exr")) << verb;
    EXPECT_FALSE(same("own.exr", "other.exr")) << verb;
  }
}

TEST_F(WarningsTest, ADepthOfZeroIsNothingWhereThatIsSaid) {
  PlateOptions zeros;
  zeros.depth_code = [](double z, double) { return z < 1e9 ? z : 0; };
  write_plate(folder_ / "zeros.exr", zeros);
  const Words plain = {"composite", "zeros.exr", "--scene", "scene.toml",
                       "--look",    "look.toml", "-q",      "-o"};
  const auto with = [&](const std::string& output, const Words& more) {
    Words words = plain;
    words.push_back(output);
    words.insert(words.end(), more.begin(), more.end());
    return limpid(words);
  };
  composed("infinite.exr");
  EXPECT_EQ(with("asked.exr", {"--depth-nothing", "0"}).code, 0);
  EXPECT_TRUE(same("asked.exr", "infinite.exr"));
  EXPECT_EQ(with("unasked.exr", {}).code, 0);
  EXPECT_FALSE(same("unasked.exr", "infinite.exr")) << "alpha is 1 there";
  write_text("scene.toml", scene_toml("depth_nothing = 0\n"));
  EXPECT_EQ(with("scene.exr", {}).code, 0);
  EXPECT_TRUE(same("scene.exr", "infinite.exr"));
  expect_refused(with("none.exr", {"--depth-nothing", "inf"}), {"--depth-nothing inf", "finite"},
                 2);
}

}  // namespace
}  // namespace limpid::test
