#include <string>

#include <gmock/gmock.h>

#include "paths.h"
#include "tool/made_plate.h"
#include "tool/tool.h"

/// Plates in working spaces other than Rec.709.

namespace limpid::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kAp1 = "0.713,0.293,0.165,0.83,0.128,0.044,0.32168,0.33767";
constexpr const char* kBt709 = "0.64,0.33,0.3,0.6,0.15,0.06,0.3127,0.329";

/// A named water type without any color set by hand: no scattering, no disc of the sun.
const char* const kClear = R"([wave_normals]
strength = 0.0
[depth_fog]
model = "beer_lambert"
water_type = "1C"
scattering = [0.0, 0.0, 0.0]
ambient = [0.0, 0.0, 0.0]
[sun_highlight]
strength = 0.0
)";

class ColorsTest : public ToolTest {
 protected:
  ColorsTest() {
    write_text("clear.toml", kClear);
    tell("told709.exr", kBt709);
    tell("toldap1.exr", kAp1);
  }
  /// plate.exr with other colors, other chromaticities, or both.
  void tell(const std::string& file, const char* chromaticities, const Words& change = {}) {
    Words words = {"plate.exr"};
    words.insert(words.end(), change.begin(), change.end());
    words.insert(words.end(), {"--attrib:type=float[8]", "chromaticities", chromaticities, "-d",
                               "float", "-o", file});
    const Ran made = oiiotool(words);
    ASSERT_EQ(made.code, 0) << made.err;
  }
  Ran wet(const std::string& plate, const std::string& output, const Words& more = {}) {
    Words words = {"composite",  plate,     "--scene", scene_, "--look",
                   "clear.toml", "--float", "-o",      output};
    words.insert(words.end(), more.begin(), more.end());
    return limpid(words);
  }
  void wetted(const std::string& plate, const std::string& output, Words more = {}) {
    more.push_back("-q");  // the plate causes other warnings
    const Ran ran = wet(plate, output, more);
    EXPECT_EQ(ran.code, 0) << ran.err;
  }
  std::string scene_ = "scene.toml";
  std::string space_of(const std::string& file) { return limpid({"inspect", file}).out; }
};

TEST_F(ColorsTest, PlatesOfRec709AreWhatTheyWere) {
  wetted("plate.exr", "silent.exr");
  wetted("told709.exr", "told.exr");
  wetted("plate.exr", "named.exr", {"--colorspace", "Rec.709"});
  EXPECT_TRUE(same("silent.exr", "told.exr"));
  EXPECT_TRUE(same("silent.exr", "named.exr"));
  EXPECT_THAT(iinfo("silent.exr"), Not(HasSubstr("colorspace")));
  EXPECT_EQ(text_of("silent.exr"), text_of("named.exr")) << "to the byte";
}

TEST_F(ColorsTest, OtherPrimariesAreToldByThePlateTheSceneOrTheCommandLine) {
  wetted("toldap1.exr", "told.exr");
  wetted("plate.exr", "named.exr", {"--colorspace", "ACEScg"});
  write_text("ap1.toml", "[scene]\ncolorspace = \"ACEScg\"\n" + scene_toml());
  scene_ = "ap1.toml";
  wetted("plate.exr", "scene.exr");
  scene_ = "scene.toml";
  EXPECT_TRUE(same("told.exr", "named.exr"));
  EXPECT_TRUE(same("told.exr", "scene.exr"));
  wetted("plate.exr", "silent.exr");
  EXPECT_FALSE(same("silent.exr", "told.exr", .01)) << "the water is another";
  // The pictures and their provenance record the color space, too.
  for (const char* file : {"told.exr", "named.exr", "scene.exr"}) {
    EXPECT_THAT(space_of(file), HasSubstr(std::string(file) + ": ACEScg\n"));
    EXPECT_THAT(space_of(file), HasSubstr("colorspace = \"ACEScg\"\n"));
  }
}

TEST_F(ColorsTest, TheCommandLineWinsAndSaysSo) {
  const Ran ran = wet("toldap1.exr", "wet.exr", {"--colorspace", "rec2020"});
  EXPECT_EQ(ran.code, 0);
  EXPECT_THAT(ran.err, HasSubstr("limpid: warning: the color space is given as Rec.2020, and the "
                                 "plate names ACEScg\n"));
  EXPECT_THAT(space_of("wet.exr"), HasSubstr("wet.exr: Rec.2020\n"));
}

TEST_F(ColorsTest, RefusesUnknownNames) {
  expect_refused(wet("plate.exr", "wet.exr", {"--colorspace", "ACESgc"}),
                 {"color space 'ACESgc'", "expected one of Rec.709, Rec.2020, ACEScg",
                  "did you mean 'ACEScg'"},
                 2);
  write_text("bad.toml", "[scene]\ncolorspace = \"sRGB\"\n" + scene_toml());
  scene_ = "bad.toml";
  expect_refused(wet("plate.exr", "wet.exr"), {"bad.toml:2:", "color space 'sRGB'"}, 1);
  scene_ = "scene.toml";
  tell("none.exr", "0,0,0,0,0,0,0,0");
  expect_refused(
      wet("none.exr", "wet.exr"),
      {"none.exr: chromaticities 0.0 0.0", "expected x and y", "or another [scene] colorspace"}, 1);
  EXPECT_EQ(wet("none.exr", "wet.exr", {"--colorspace", "ACEScg"}).code, 0);
}

/// A picture and its conversion to ACEScg compare as equal, however the files name the space.
TEST_F(ColorsTest, MetricsOfColorSeePicturesAsTheirChromaticitiesSay) {
  const Words convert = {"--ccmatrix",
                         ".61309732,.07019422,.02061560,0,.33952285,.91635557,.10956983,0,"
                         ".04737928,.01345259,.86981512,0,0,0,0,1"};
  tell("ap1.exr", kAp1, {"--ch", "R,G,B,A", convert[0], convert[1]});
  tell("ap1_untold.exr", kBt709, {"--ch", "R,G,B,A", convert[0], convert[1]});
  const auto flip = [&](const std::string& a, const std::string& b, const Words& more = {}) {
    Words words = {"compare", a, b, "--channels", "R,G,B", "--metrics", "flip"};
    words.insert(words.end(), more.begin(), more.end());
    return limpid(words).out;
  };
  const auto mean = [](const std::string& out) {
    const std::size_t at = out.find("  FLIP = ");
    EXPECT_NE(at, std::string::npos) << out;
    return at == std::string::npos ? -1 : std::stod(out.substr(at + 9));
  };
  EXPECT_LT(mean(flip("ap1.exr", "told709.exr")), 1e-3);
  EXPECT_GT(mean(flip("ap1_untold.exr", "told709.exr")), .02);
  EXPECT_THAT(flip("ap1.exr", "told709.exr"),
              HasSubstr("  Metrics of color in Rec.709, made of ACEScg and Rec.709\n"));
  EXPECT_THAT(flip("told709.exr", "told709.exr"), Not(HasSubstr("Metrics of color in")));
  // A space given for both files acts as if each file named the space.
  EXPECT_EQ(mean(flip("ap1_untold.exr", "plate.exr", {"--colorspace", "ACEScg"})),
            mean(flip("ap1.exr", "toldap1.exr")));
  expect_refused(limpid({"compare", "ap1.exr", "ap1.exr", "--colorspace", "ACEScg"}),
                 {"--colorspace: expected --metrics ssim, flip or hdrflip beside it"}, 2);
  expect_refused(
      limpid({"compare", "ap1.exr", "ap1.exr", "--metrics", "flip", "--colorspace", "x"}),
      {"color space 'x': expected one of"}, 2);
  oiiotool({"plate.exr", "--ch", "R,G,B", "-o", "encoded.png"});
  expect_refused(
      limpid(
          {"compare", "encoded.png", "encoded.png", "--metrics", "flip", "--colorspace", "ACEScg"}),
      {"--colorspace is for linear pictures, and encoded.png and encoded.png are encoded as sRGB"},
      2);
}

/// The same plate in ACEScg and in Rec.709 under the same named water type: the two pictures,
/// compared in ACEScg, differ only by the error of describing a spectrum by three rates.
TEST_F(ColorsTest, TheSameWaterShowsTheSamePicture) {
  const Words convert = {"--ccmatrix",
                         ".61309732,.07019422,.02061560,0,.33952285,.91635557,.10956983,0,"
                         ".04737928,.01345259,.86981512,0,0,0,0,1"};
  const auto converted = [&](const std::string& from, const std::string& to) {
    Words words = {from, "--ch", "R,G,B,A"};
    words.insert(words.end(), convert.begin(), convert.end());
    words.insert(words.end(), {"-d", "float", "-o", to});
    const Ran ran = oiiotool(words);
    ASSERT_EQ(ran.code, 0) << ran.err;
  };
  const Words own = {"--layer", "depth=plate.exr:depth.Z", "--layer", "shadow=none",
                     "--layer", "reflection=none"};
  const auto with = [&](const Words& more) {
    Words words = own;
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  converted("plate.exr", "ap1.exr");
  wetted("plate.exr", "before.exr", own);
  converted("before.exr", "before_ap1.exr");
  wetted("ap1.exr", "after.exr", with({"--colorspace", "ACEScg"}));
  wetted("ap1.exr", "unfitted.exr", own);
  EXPECT_TRUE(same("after.exr", "before_ap1.exr", .03));
  EXPECT_FALSE(same("unfitted.exr", "before_ap1.exr", .06));
}

TEST_F(ColorsTest, AScenesModelIsOfRec709) {
  write_text("model.toml", "[scene]\ncolorspace = \"ACEScg\"\n[geometry]\ngltf = \"" +
                               std::string(LIMPID_DATA) + "/scenes/pool.gltf\"\n");
  const Ran ran = limpid({"water", "model.toml", "-o", "wet.exr", "--size", "16x9"});
  EXPECT_EQ(ran.code, 1);
  EXPECT_THAT(ran.err, HasSubstr("scene.colorspace = ACEScg: expected Rec.709"));
}

}  // namespace
}  // namespace limpid::test
