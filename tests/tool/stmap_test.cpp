#include <iterator>
#include <sstream>

#include <gmock/gmock.h>

#include "tool/tool.h"

/// The ST maps of the refraction, applied by another program, give the same picture.

namespace limpid::test {
namespace {

class StmapTest : public ToolTest {
 protected:
  /// A dry picture without detail, which every filter reads the same, under clear water.
  StmapTest() {
    EXPECT_EQ(oiiotool({"--pattern",
                        "fill:topleft=0.1,0.2,0.9:topright=0.8,0.4,0.5:"
                        "bottomleft=0.3,0.9,0.2:bottomright=1.2,0.6,0.1",
                        "64x36", "3", "-d", "float", "-o", "dry.exr"})
                  .code,
              0);
    write_text(
        "clear.toml",
        "[wave_normals]\nmap = \"waves.exr\"\ntile_size = 3.0\n\n"
        "[prism_split]\ngain = 5.0\n\n[caustics]\nstrength = 0.0\nsunlight = \"straight\"\n\n"
        "[depth_fog]\nwater_type = \"custom\"\nabsorption = [0, 0, 0]\n"
        "scattering = [0, 0, 0]\ncrossing = \"none\"\n\n"
        "[fresnel_reflection]\nsource = \"constant\"\n");
  }

  /// Whether a dry channel, warped by the map and times 1 - F, equals the light that passes the
  /// surface, where the lookup succeeded and lies inside the picture's border.
  bool warps(const std::string& channel, const std::string& map, const std::string& tolerance) {
    const std::string warped = "dry.exr --ch " + channel + " wet.exr --ch " + map + ".U," + map +
                               ".V --st_warp:filter=triangle:flip_t=1 --chnames Y ";
    const std::string through = "wet.exr --ch fresnel.Y --mulc -1 --addc 1 --mul ";
    const std::string off = "wet.exr --ch Y=transmitted." + channel + " --sub ";
    const std::string real =
        "wet.exr --ch Y=confidence.Y --subc 0.999 --mulc 1e6 --clamp:min=0:max=1 --mul ";
    const std::string nought = "--cut 58x30+3+3 --dup --mulc 0 --diff";
    std::istringstream text("--fail " + tolerance + " --warn " + tolerance + " " + warped +
                            through + off + real + nought);
    const Words words{std::istream_iterator<std::string>(text), {}};
    const Ran ran = oiiotool(words);
    EXPECT_EQ(ran.err, "");
    EXPECT_EQ(ran.code == 0, ran.out.find("PASS") != std::string::npos) << ran.out;
    return ran.code == 0;
  }
};

TEST_F(StmapTest, WarpsTheDryPictureAsTheWaterDoes) {
  const Ran ran =
      limpid({"composite", "plate.exr", "--layer", "color=dry.exr", "--scene", "scene.toml",
              "--look", "clear.toml", "-o", "wet.exr", "--float", "--aov", "all", "-q"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_TRUE(warps("R", "stmap.r", "1e-4"));
  EXPECT_TRUE(warps("G", "stmap.g", "1e-4"));
  EXPECT_TRUE(warps("B", "stmap.b", "1e-4"));
  EXPECT_FALSE(warps("R", "stmap.b", "1e-3")) << "each color has a map of its own";
  // Enough pixels were compared.
  const Ran stats = oiiotool({"wet.exr", "--ch", "confidence.Y", "--cut", "48x20+16+16", "--subc",
                              "0.999", "--mulc", "1e6", "--clamp:min=0:max=1", "--addc", "-0.5",
                              "--clamp:min=0", "--printstats"});
  EXPECT_THAT(stats.out, ::testing::ContainsRegex("Stats Avg: 0\\.[34]")) << stats.out;
}

}  // namespace
}  // namespace limpid::test
