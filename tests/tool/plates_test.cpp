#include <cmath>

#include <gmock/gmock.h>

#include "tool/made_plate.h"
#include "tool/tool.h"

/// Plates with other windows, depth kinds, layer names and cameras give the same picture.

namespace limpid::test {
namespace {

using ::testing::HasSubstr;

class WindowsTest : public ToolTest {
 protected:
  /// The composite of a plate with these windows, as NAME.exr.
  void composed_of(const std::string& name, const PlateOptions& options) const {
    write_plate(folder_ / (name + "_plate.exr"), options);
    const Ran ran = limpid({"composite", name + "_plate.exr", "--scene", "scene.toml", "--look",
                            "look.toml", "-o", name + ".exr", "-q"});
    EXPECT_EQ(ran.code, 0) << ran.err;
  }
  /// Whether both files have the same pixels in `cut`, in oiiotool's form WxH+X+Y.
  bool same_in(const std::string& cut, const std::string& a, const std::string& b) const {
    return oiiotool({"--fail", "0", a, "--cut", cut, b, "--cut", cut, "--diff"}).code == 0;
  }
};

TEST_F(WindowsTest, OverscanIsReadAndThePictureWritten) {
  composed("wet.exr");
  composed_of("over", {.data = {-8, -4, 70, 41}});
  const std::string info = iinfo("over.exr");
  EXPECT_THAT(info, HasSubstr("64 x   36, 4 channel"));
  EXPECT_THAT(info, ::testing::Not(HasSubstr("pixel data origin")));
  EXPECT_TRUE(same_in("32x20+16+8", "over.exr", "wet.exr"));
  EXPECT_FALSE(same_in("64x36+0+0", "over.exr", "wet.exr"));  // edges look up the overscan
}

TEST_F(WindowsTest, OverscanIsWrittenWhereItIsAskedFor) {
  const PlateOptions options{.data = {-8, -4, 70, 41}};
  composed_of("over", options);
  const Ran ran =
      limpid({"composite", "over_plate.exr", "--scene", "scene.toml", "--look", "look.toml",
              "--overscan", "5", "-o", "wide.exr", "--preview", "wide.png", "-q"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const std::string info = iinfo("wide.exr");
  EXPECT_THAT(info, HasSubstr("74 x   45, 4 channel")) << "no row more is there above and below";
  EXPECT_THAT(info, HasSubstr("pixel data origin: x=-5, y=-4"));
  EXPECT_THAT(info, HasSubstr("full/display size: 64 x 36"));
  EXPECT_TRUE(same_in("64x36+0+0", "wide.exr", "over.exr"));
  EXPECT_THAT(iinfo("wide.png"), HasSubstr("64 x   36"));
  composed("plain.exr");
  composed("plain_wide.exr", {"--overscan", "5"});
  EXPECT_TRUE(same("plain.exr", "plain_wide.exr")) << "there is none to be written";
}

TEST_F(WindowsTest, OfACropThePartThatIsThereIsWritten) {
  composed("wet.exr");
  composed_of("crop", {.data = {10, 6, 50, 30}});
  const std::string info = iinfo("crop.exr");
  EXPECT_THAT(info, HasSubstr("40 x   24, 4 channel"));
  EXPECT_THAT(info, HasSubstr("pixel data origin: x=10, y=6"));
  EXPECT_THAT(info, HasSubstr("full/display size: 64 x 36"));
  EXPECT_TRUE(same_in("20x10+20+12", "crop.exr", "wet.exr"));
}

TEST_F(WindowsTest, AnOffsetDisplayWindowMovesThePictureOnly) {
  composed("wet.exr");
  composed_of("moved", {.data = {100, -50, 164, -14}, .display = {100, -50, 164, -14}});
  const std::string info = iinfo("moved.exr");
  EXPECT_THAT(info, HasSubstr("full/display origin: 100, -50"));
  const Ran ran =
      oiiotool({"moved.exr", "--origin", "+0+0", "--fullsize", "64x36+0+0", "-o", "back.exr"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_TRUE(same("back.exr", "wet.exr"));
}

class DepthKindTest : public ToolTest {
 protected:
  void expect_same_picture(const std::string& kind, const std::string& camera,
                           const DepthCode& code) const {
    composed("eye.exr", {"--float"});
    write_plate(folder_ / "coded.exr", {.depth_code = code});
    write_text("coded.toml", scene_toml(camera));
    const Ran from_flag =
        limpid({"composite", "coded.exr", "--scene", "coded.toml", "--look", "look.toml",
                "--depth-kind", kind, "--float", "-o", "flag.exr", "-q"});
    EXPECT_EQ(from_flag.code, 0) << from_flag.err;
    EXPECT_TRUE(same("flag.exr", "eye.exr", 1e-4));
    write_text("coded.toml", scene_toml(camera + "depth = \"" + kind + "\"\n"));
    const Ran from_scene = limpid({"composite", "coded.exr", "--scene", "coded.toml", "--look",
                                   "look.toml", "--float", "-o", "scene.exr", "-q"});
    EXPECT_EQ(from_scene.code, 0) << from_scene.err;
    EXPECT_TRUE(same("scene.exr", "flag.exr"));
  }
  static constexpr const char* kRange = "near = 0.1\nfar = 100.0\n";
};

TEST_F(DepthKindTest, Eye) {
  expect_same_picture("eye", "", [](double z, double) { return z; });
}

TEST_F(DepthKindTest, Ray) {
  expect_same_picture("ray", "", [](double z, double ray_length) { return z * ray_length; });
}

TEST_F(DepthKindTest, Inverse) {
  expect_same_picture("inverse", "", [](double z, double) { return 1 / z; });
}

TEST_F(DepthKindTest, Normalised) {
  expect_same_picture("normalised", kRange,
                      [](double z, double) { return std::isinf(z) ? 1 : (z - 0.1) / (100 - 0.1); });
}

TEST_F(DepthKindTest, Device) {
  const std::pair<const char*, ClipSpace> clips[] = {
      {"gl", ClipSpace::kGl}, {"d3d", ClipSpace::kD3d}, {"reversed", ClipSpace::kReversed}};
  for (const auto& [name, clip] : clips) {
    const Camera camera = plate_camera(clip);
    expect_same_picture(
        "device", kRange + ("clip = \"" + std::string(name) + "\"\n"), [&](double z, double) {
          return std::isinf(z) ? camera.far_device_depth() : camera.device_from_eye_depth(z);
        });
  }
}

TEST_F(DepthKindTest, DeviceDepthWantsARangeThatSomebodyKnows) {
  write_text("bare.toml", scene_toml(""));
  const Words sentence = {"depth of kind device: expected a projection, or near and far"};
  expect_no_composite({"plate.exr", "--scene", "bare.toml", "--depth-kind", "device"}, sentence);
  expect_no_composite({"plate.exr", "--scene", "bare.toml", "--depth-kind", "device", "-n"},
                      sentence);
  write_plate(folder_ / "seen.exr", {.camera = true});
  write_text("water.toml", "[camera]\ndepth = \"device\"\n[water]\nheight = 0.0\n");
  expect_no_composite({"seen.exr", "--scene", "water.toml"}, sentence);
  expect_no_composite({"plate.exr", "--scene", "bare.toml", "--depth-kind", "normalised"},
                      {"depth of kind normalised: expected near and a finite far"});
  expect_no_composite({"plate.exr", "--scene", "scene.toml", "--depth-kind", "devise"},
                      {"depth kind 'devise': expected one of eye, ray", "did you mean 'device'?"},
                      2);
}

using LayersTest = ToolTest;

TEST_F(LayersTest, OverridesNameWhatNoConventionFinds) {
  composed("wet.exr");
  const Ran renamed = oiiotool({"plate.exr", "--ch",
                                "R,G,B,A,far.away=depth.Z,m.q=shadow.Y,"
                                "mirror.R=reflection.R,mirror.G=reflection.G,mirror.B=reflection.B",
                                "-d", "half", "-d", "far.away=float", "-o", "odd.exr"});
  ASSERT_EQ(renamed.code, 0) << renamed.err;
  const Words rest = {"--scene", "scene.toml", "--look", "look.toml", "-o", "odd_wet.exr", "-q"};
  const auto composite_odd = [&](Words words) {
    words.insert(words.end(), rest.begin(), rest.end());
    return limpid(words);
  };
  const Ran blind = composite_odd({"composite", "odd.exr"});
  expect_refused(
      blind, {"no depth found; there is ", "far (away)", "mirror (R G B)", "--layer depth=LAYER"});
  const Ran ran = composite_odd({"composite", "odd.exr", "--layer", "depth=far.away", "--layer",
                                 "shadow=m.q", "--layer", "reflection=mirror"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_TRUE(same("odd_wet.exr", "wet.exr"));
  const Ran by_file =
      composite_odd({"composite", "odd.exr", "--layer", "depth=plate.exr", "--layer",
                     "shadow=plate.exr:shadow.Y", "--layer", "reflection=plate.exr:reflection"});
  EXPECT_EQ(by_file.code, 0) << by_file.err;
  EXPECT_TRUE(same("odd_wet.exr", "wet.exr"));
}

TEST_F(LayersTest, NoneLeavesARoleOut) {
  composed("wet.exr");
  composed("no_mirror.exr", {"--layer", "reflection=none", "--aov", "reflected"});
  const Ran stats = oiiotool({"no_mirror.exr", "--ch", "reflected.R", "--printstats"});
  EXPECT_THAT(stats.out, HasSubstr("Stats Max: 0.000000"));
}

TEST_F(LayersTest, ASceneNamesItsPlates) {
  composed("wet.exr");
  write_text("full.toml",
             "[plates]\ncolor = \"plate.exr:R,G,B,A\"\ndepth = \"plate.exr:depth.Z\"\n"
             "shadow = \"plate.exr:shadow.Y\"\nreflection = \"plate.exr:reflection\"\n\n" +
                 scene_toml());
  const Ran ran = limpid(
      {"composite", "--scene", "full.toml", "--look", "look.toml", "-o", "by_scene.exr", "-q"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_TRUE(same("by_scene.exr", "wet.exr"));
}

TEST_F(LayersTest, TheCameraMayComeFromThePlate) {
  composed("wet.exr", {"--float"});
  write_plate(folder_ / "seen.exr", {.camera = true});
  const std::string scene = scene_toml();
  write_text("water.toml", scene.substr(scene.find("[water]")));
  const Ran ran = limpid({"composite", "seen.exr", "--scene", "water.toml", "--look", "look.toml",
                          "--float", "-o", "seen_wet.exr", "-q"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_TRUE(same("seen_wet.exr", "wet.exr", 1e-3));
}

}  // namespace
}  // namespace limpid::test
