#include "limpid/run/aov_names.h"

#include <gmock/gmock.h>

#include "limpid/files/exr/exr_file.h"

#include "tool/tool.h"

/// The channels of a picture have the names that other programs expect.

namespace limpid::test {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::MatchesRegex;
using ::testing::Not;

class AovNamesTest : public ToolTest {
 protected:
  Words names(const std::string& file) const {
    Words list;
    const ExrFile exr = ExrFile::open(folder_ / file);
    for (const ExrChannel& channel : exr.parts()[0].channels) list.push_back(channel.name);
    return list;
  }
  void made(const std::string& file, const std::string& host) const {
    composed(file, {"--aov", "all", "--aov-names", host, "--float"});
  }
};

TEST_F(AovNamesTest, OfEachHost) {
  made("limpid.exr", "limpid");
  made("nuke.exr", "nuke");
  made("blender.exr", "blender");
  made("arnold.exr", "arnold");
  EXPECT_THAT(names("limpid.exr"), IsSupersetOf({"R", "A", "transmitted.R", "fresnel.Y", "path.Z",
                                                 "normal.X", "stmap.g.U", "stmap.g.V"}));
  EXPECT_THAT(names("nuke.exr"),
              IsSupersetOf({"R", "A", "transmitted.red", "transmitted.blue", "fresnel.red",
                            "path.Z", "normal.X", "stmap_g.u", "stmap_g.v"}));
  EXPECT_THAT(
      names("blender.exr"),
      IsSupersetOf({"ViewLayer.Combined.R", "ViewLayer.Combined.A", "ViewLayer.transmitted.R",
                    "ViewLayer.fresnel.X", "ViewLayer.path.Z", "ViewLayer.normal.Y",
                    "ViewLayer.stmap_g.U", "ViewLayer.stmap_g.V", "ViewLayer.stmap_g.A"}));
  EXPECT_THAT(names("arnold.exr"), IsSupersetOf({"R", "A", "transmitted.R", "fresnel", "path",
                                                 "normal.Z", "stmap_g.X", "stmap_g.Y"}));
  // Blender splits a channel's name into view layer, pass and one letter.
  EXPECT_THAT(names("blender.exr"), Each(MatchesRegex("ViewLayer\\.[A-Za-z_]+\\.[RGBAXYZUV]")));
  EXPECT_THAT(names("nuke.exr"), Each(MatchesRegex("[RGBA]|[a-z_]+\\.[A-Za-z]+")));
}

TEST_F(AovNamesTest, ChangeNothingElse) {
  made("limpid.exr", "limpid");
  made("nuke.exr", "nuke");
  made("blender.exr", "blender");
  made("arnold.exr", "arnold");
  const std::string hosts[] = {
      "R,transmitted.G=transmitted.green,fresnel=fresnel,path,stmap.g.U=stmap_g.u",
      "R=ViewLayer.Combined.R,transmitted=ViewLayer.transmitted,fresnel=ViewLayer.fresnel,"
      "stmap.g.V=ViewLayer.stmap_g.V",
      "R,transmitted,fresnel.Y=fresnel,path.Z=path,stmap.b.U=stmap_b.X"};
  const std::string files[] = {"nuke.exr", "blender.exr", "arnold.exr"};
  for (std::size_t i = 0; i < 3; ++i) {
    const Ran ran =
        limpid({"compare", "limpid.exr", files[i], "--channels", hosts[i], "--tolerance", "0"});
    EXPECT_EQ(ran.code, 0) << files[i] << ran.out << ran.err;
  }
  // The third channel of an ST map is 1.
  const Ran stats = oiiotool({"blender.exr", "--ch", "ViewLayer.stmap_r.A", "--printstats"});
  EXPECT_THAT(stats.out, HasSubstr("Stats Min: 1.0"));
  EXPECT_THAT(stats.out, HasSubstr("Stats Max: 1.0"));
}

TEST_F(AovNamesTest, AreRecorded) {
  const auto options = [&](const std::string& file) {
    return ExrFile::open(folder_ / file).text_attribute(0, "limpid/options").value();
  };
  composed("own.exr", {"--aov", "path"});
  composed("nuke.exr", {"--aov", "path", "--aov-names", "nuke"});
  EXPECT_THAT(options("own.exr"), Not(HasSubstr("aov_names")));
  EXPECT_THAT(options("nuke.exr"), HasSubstr("\naov_names = \"nuke\"\n"));
  expect_no_composite({"plate.exr", "--scene", "scene.toml", "--aov-names", "nuk"},
                      {"'nuk' has no names of AOVs: expected one of limpid, nuke, blender, arnold",
                       "did you mean 'nuke'?"},
                      2);
}

}  // namespace
}  // namespace limpid::test
