#include <gmock/gmock.h>

#include "tool/made_plate.h"
#include "tool/tool.h"

/// The first bytes of a file decide that the file is an EXR, not its name.

namespace limpid::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class MagicTest : public ToolTest {
 protected:
  void copy(const std::string& from, const std::string& to) const {
    fs::copy_file(folder_ / from, folder_ / to);
  }
  void expect_same_as_wet(const Words& more) const {
    Words words{"composite", "-o", "other.exr", "-q"};
    words.insert(words.end(), more.begin(), more.end());
    const Ran ran = limpid(words);
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_TRUE(same("other.exr", "wet.exr"));
  }
};

TEST_F(MagicTest, PlatesAndLayersMayHaveAnyName) {
  composed("wet.exr");
  const Words rest{"--scene", "scene.toml", "--look", "look.toml"};
  for (const std::string name : {"plate.tmp", "plate", "plate.png", "plate.exr.0001"}) {
    copy("plate.exr", name);
    Words words = rest;
    words.push_back(name);
    expect_same_as_wet(words);
    Words layer = rest;
    layer.insert(layer.end(), {"plate.exr", "--layer", "depth=" + name + ":depth.Z"});
    expect_same_as_wet(layer);
    const Ran ran = limpid({"inspect", name});
    EXPECT_THAT(ran.out, HasSubstr(name + "\n  part 0: 64x36, piz, scan lines\n"));
  }
}

TEST_F(MagicTest, TexturesMayHaveAnyName) {
  composed("wet.exr");
  copy("waves.exr", "waves.jpg");
  expect_same_as_wet({"plate.exr", "--scene", "scene.toml", "--look", "look.toml", "--set",
                      "wave_normals.map=waves.jpg"});
  const Ran sky = oiiotool({"--pattern", "fill:top=0.2,0.4,0.9:bottom=4,3,2", "16x8", "3", "-d",
                            "half", "-o", "sky.exr"});
  ASSERT_EQ(sky.code, 0) << sky.err;
  copy("sky.exr", "sky.hdr");
  for (const std::string name : {"sky.exr", "sky.hdr"}) {
    write_text(name + ".toml", "[plates]\nenvironment = \"" + name + "\"\n" + scene_toml());
    const Ran ran =
        limpid({"composite", "plate.exr", "--scene", name + ".toml", "--look", "physical", "--set",
                "fresnel_reflection.source=environment", "-o", name + ".wet.exr", "-q"});
    EXPECT_EQ(ran.code, 0) << ran.err;
  }
  EXPECT_TRUE(same("sky.exr.wet.exr", "sky.hdr.wet.exr"));
}

/// The colors are scene-linear, as in any EXR.
TEST_F(MagicTest, ComparedPicturesToo) {
  composed("a.exr");
  composed("b.exr", {"--set", "depth_fog.density=0.1"});
  copy("a.exr", "a.png");
  const auto compared = [&](const std::string& a) {
    return limpid({"compare", a, "b.exr", "--metrics", "ssim,flip,hdrflip"});
  };
  const Ran by_name = compared("a.exr"), by_magic = compared("a.png");
  EXPECT_EQ(by_magic.err, "");
  EXPECT_EQ(by_magic.code, 1);
  EXPECT_EQ(by_magic.out, by_name.out);
}

TEST_F(MagicTest, WhatIsNamedLikeOneButIsNoneStaysRefused) {
  write_text("text.tmp", "v/1 and other words");
  expect_no_composite({"text.tmp", "--scene", "scene.toml"}, {"text.tmp: "});
  write_text("text.exr", "these are words");
  expect_no_composite({"text.exr", "--scene", "scene.toml"}, {"text.exr: is not an OpenEXR file"});
}

}  // namespace
}  // namespace limpid::test
