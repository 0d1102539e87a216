#include <numbers>

#include <gmock/gmock.h>

#include "job/shared_textures.h"
#include "paths.h"
#include "tool/made_plate.h"
#include "tool/tool.h"

/// The environment that a scene names must exist, and is loaded if the plan has lookups of it.

namespace limpid::test {
namespace {

class EnvironmentTest : public ToolTest {
 protected:
  void write_scene(const std::string& environment) const {
    write_text("sky.toml", "[plates]\nenvironment = \"" + environment + "\"\n" + scene_toml());
  }
};

TEST_F(EnvironmentTest, ThatIsNotThereIsRefusedByEveryVerb) {
  write_scene("absent_sky.exr");
  const Words parts = {"plates.environment: ", "absent_sky.exr: no such file"};
  expect_no_composite({"plate.exr", "--scene", "sky.toml"}, parts);
  expect_refused(limpid({"plan", "plate.exr", "--scene", "sky.toml"}), parts);
  write_text("pool.toml", "[plates]\nenvironment = \"absent_sky.exr\"\n[geometry]\ngltf = \"" +
                              std::string(LIMPID_DATA) + "/scenes/pool.gltf\"\n[water]\n");
  expect_refused(limpid({"water", "pool.toml", "-n"}), parts);
  expect_refused(limpid({"water", "pool.toml", "-o", "wet.exr"}), parts);
  std::filesystem::create_directory(folder_ / "absent_sky.exr");
  expect_refused(limpid({"plan", "plate.exr", "--scene", "sky.toml"}), parts);
}

TEST_F(EnvironmentTest, ThatNothingReadsChangesNothing) {
  composed("wet.exr");
  write_scene("waves.exr");  // no lat-long map, and not read
  const Ran ran =
      limpid({"composite", "plate.exr", "--scene", "sky.toml", "--look", "look.toml", "--set",
              "fresnel_reflection.reflectance=schlick", "-o", "sky_wet.exr", "-q"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_TRUE(same("sky_wet.exr", "wet.exr"));
}

TEST_F(EnvironmentTest, IsToldOfWhereNothingReadsItNorAReflection) {
  write_scene("waves.exr");
  const auto warned = [&](const Words& more) {
    Words words = {
        "composite", "plate.exr", "--scene", "sky.toml", "--look",
        "look.toml", "-o",        "wet.exr", "--set",    "fresnel_reflection.lookup=offset"};
    words.insert(words.end(), more.begin(), more.end());
    return limpid(words).err;
  };
  EXPECT_EQ(warned({}), "") << "a reflection is better";
  EXPECT_EQ(
      warned({"--set", "fresnel_reflection.source=constant"}),
      "limpid: warning: fresnel_reflection.lookup = offset changes nothing: source is constant, "
      "expected source = planar or auto\n"
      "limpid: warning: the environment is named, and no running operator of the look look reads "
      "it\n");
}

TEST_F(EnvironmentTest, IsLoadedAndTurnedForAPlanThatReadsIt) {
  ASSERT_EQ(oiiotool({"--pattern", "constant:color=0,0,0", "8x4", "3", "--point:color=5,6,7", "3,1",
                      "-o", "sky.exr"})
                .code,
            0);
  SceneFile scene;
  EXPECT_FALSE(has_environment(scene));
  scene.environment = folder_ / "sky.exr";
  scene.environment_rotation = 0.25 * 2 * std::numbers::pi;
  EXPECT_TRUE(has_environment(scene));
  SharedTextures textures;
  Plan plan;
  EXPECT_FALSE(textures.load(textures_read(plan, scene)).environment);
  plan.reads_environment = true;
  EXPECT_THROW(textures.load(textures_read(plan, scene), {.max_pixels = 31}), Error);
  const auto held = textures.load(textures_read(plan, scene)).environment;
  const Texture sky = texture_of(held);
  EXPECT_EQ(sky.channels[0].window, (Rect{0, 0, 8, 4}));
  EXPECT_EQ(sky.channels[2].at(6, 1), 7);  // mirrored from 3 to 4, turned by two
  EXPECT_EQ(sky.channels[2].at(4, 1), 0);
}

/// The matrix between Rec.709 and ACEScg is published with ACES: red of Rec.709 is (.6131, .0702,
/// .0206) in ACEScg.
TEST_F(EnvironmentTest, IsMadeOfThePlansPrimariesWhereItsFileTellsItsOwn) {
  const auto sky_of = [&](const char* chromaticities, const char* space) {
    const Ran made =
        oiiotool({"--pattern", "constant:color=1,0,0", "8x4", "3", "--attrib:type=float[8]",
                  "chromaticities", chromaticities, "-d", "float", "-o", "sky.exr"});
    EXPECT_EQ(made.code, 0) << made.err;
    SceneFile scene;
    scene.environment = folder_ / "sky.exr";
    Plan plan;
    plan.reads_environment = true;
    plan.primaries = *find_color_space(space);
    SharedTextures textures;
    const auto held = textures.load(textures_read(plan, scene)).environment;
    const Texture sky = texture_of(held);
    return std::array{sky.channels[0].at(3, 2), sky.channels[1].at(3, 2), sky.channels[2].at(3, 2)};
  };
  const char* const bt709 = "0.64,0.33,0.3,0.6,0.15,0.06,0.3127,0.329";
  const auto converted = sky_of(bt709, "ACEScg"), same = sky_of(bt709, "Rec.709");
  EXPECT_NEAR(converted[0], .6131, 1e-3);
  EXPECT_NEAR(converted[1], .0702, 1e-3);
  EXPECT_NEAR(converted[2], .0206, 1e-3);
  EXPECT_EQ(same, (std::array{1.f, 0.f, 0.f}));
}

TEST_F(EnvironmentTest, OfManyFramesIsLoadedOnce) {
  ASSERT_EQ(oiiotool({"--create", "8x4", "3", "-o", "sky.exr"}).code, 0);
  std::filesystem::copy(folder_ / "sky.exr", folder_ / "other.exr");
  SceneFile scene;
  scene.environment = folder_ / "sky.exr";
  Plan plan;
  plan.reads_environment = plan.reads_wave_map = true;
  plan.look.of<WaveNormals>().map = folder_ / "waves.exr";
  SharedTextures textures;
  const auto [map, sky] = textures.load(textures_read(plan, scene));
  std::filesystem::remove(folder_ / "sky.exr");
  std::filesystem::remove(folder_ / "waves.exr");
  EXPECT_EQ(textures.load(textures_read(plan, scene)).environment, sky);
  EXPECT_EQ(textures.load(textures_read(plan, scene)).wave_map, map);
  // Another file, or the same file with another rotation, is another texture.
  scene.environment = folder_ / "other.exr";
  EXPECT_NE(textures.load(textures_read(plan, scene)).environment, sky);
  std::filesystem::remove(folder_ / "other.exr");
  scene.environment_rotation = 1;
  EXPECT_THROW(textures.load(textures_read(plan, scene)), Error);
}

}  // namespace
}  // namespace limpid::test
