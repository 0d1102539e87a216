#include <gmock/gmock.h>

#include "paths.h"
#include "tool/made_plate.h"
#include "tool/tool.h"

namespace limpid::test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

class CompareMetricsTest : public ToolTest {
 protected:
  Ran compare(const std::string& a, const std::string& b, const Words& more) const {
    Words words{"compare", a, b};
    words.insert(words.end(), more.begin(), more.end());
    return limpid(words);
  }
  /// The picture of `file` with replaced channels, each `NAME` or `NAME=NUMBER`.
  void rechannel(const std::string& file, const std::string& channels,
                 const std::string& output) const {
    const Ran ran = oiiotool({file, "--ch", channels, "-d", "float", "-o", output});
    ASSERT_EQ(ran.code, 0) << ran.err;
  }
  /// The number in a line `NAME = NUMBER, ...`.
  static double number_of(const Ran& ran, const std::string& name) {
    const std::size_t at = ran.out.find("  " + name + " = ");
    EXPECT_NE(at, std::string::npos) << ran.out;
    return at == std::string::npos ? -1 : std::stod(ran.out.substr(at + name.size() + 5));
  }
};

const Words kColor = {"--channels", "R,G,B"};

Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST_F(CompareMetricsTest, APictureIsLikeItself) {
  composed("wet.exr");
  const Ran ran = compare("wet.exr", "wet.exr", {"--metrics", "all"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("\n  SSIM = 1, min 1\n"));
  EXPECT_THAT(ran.out, HasSubstr("\n  FLIP = 0, weighted median 0, 99% 0, max 0 (67.0206 pixels"));
  EXPECT_THAT(ran.out, ContainsRegex("\n  HDR-FLIP = 0, .* exposures "));
  EXPECT_THAT(ran.out,
              HasSubstr("\n  Offset not measured: wet.exr has no channel 'surface_depth.Z': expe"));
  EXPECT_THAT(ran.out, HasSubstr("\nPASS\n"));
}

TEST_F(CompareMetricsTest, ToleranceStaysWhatDecides) {
  composed("wet.exr");
  composed("clear.exr", {"--set", "depth_fog.density=0"});
  const Words metrics = {"--metrics", "ssim,flip", "--flip-map", "map.png"};
  const Ran ran = compare("wet.exr", "clear.exr", metrics);
  EXPECT_EQ(ran.code, 1);
  EXPECT_EQ(ran.err, "");
  EXPECT_LT(number_of(ran, "SSIM"), 0.999);
  EXPECT_GT(number_of(ran, "FLIP"), 0.001);
  EXPECT_THAT(ran.out, Not(HasSubstr("HDR-FLIP")));
  EXPECT_THAT(ran.out, HasSubstr("\nFAILURE\nmap.png\n"));
  EXPECT_THAT(iinfo("map.png"), HasSubstr("64 x   36, 3 channel, uint8 png"));
  const Ran lax = compare("wet.exr", "clear.exr", with(metrics, {"--tolerance", "1000"}));
  EXPECT_EQ(lax.code, 0);
  EXPECT_EQ(number_of(lax, "FLIP"), number_of(ran, "FLIP"));
}

TEST_F(CompareMetricsTest, TheMapIsOfFlipUnlessOnlyHdrFlipIsThere) {
  composed("wet.exr");
  composed("clear.exr", {"--set", "depth_fog.density=0"});
  compare("wet.exr", "clear.exr", {"--flip-map", "flip.png"});
  compare("wet.exr", "clear.exr", {"--metrics", "all", "--flip-map", "all.png"});
  compare("wet.exr", "clear.exr", {"--metrics", "hdrflip", "--flip-map", "hdr.png"});
  EXPECT_TRUE(same("flip.png", "all.png"));
  EXPECT_FALSE(same("flip.png", "hdr.png"));
}

TEST_F(CompareMetricsTest, FromNearMoreIsSeen) {
  composed("wet.exr");
  composed("other.exr", {"--time", "3"});
  const auto flip = [&](const std::string& ppd) {
    return number_of(compare("wet.exr", "other.exr", {"--metrics", "flip", "--ppd", ppd}), "FLIP");
  };
  EXPECT_GT(flip("10"), 1.2 * flip("100"));
}

TEST_F(CompareMetricsTest, OtherFormatsAreDecodedFirst) {
  composed("wet.exr", {"--preview", "wet.png"});
  composed("clear.exr", {"--set", "depth_fog.density=0", "--preview", "clear.png"});
  const Words metrics = with(kColor, {"--metrics", "ssim,flip"});
  const Ran exr = compare("wet.exr", "clear.exr", metrics);
  const Ran png = compare("wet.png", "clear.png", metrics);
  EXPECT_NEAR(number_of(png, "FLIP"), number_of(exr, "FLIP"), 0.05 * number_of(exr, "FLIP"));
  EXPECT_NEAR(number_of(png, "SSIM"), number_of(exr, "SSIM"), 0.01);
}

TEST_F(CompareMetricsTest, OffsetsOfTheLookups) {
  composed("wet.exr", {"--float", "--aov", "all"});
  const std::string maps = "stmap.r.U,stmap.r.V,stmap.g.U,stmap.g.V,stmap.b.U,stmap.b.V";
  // A truth with the same lookups, in which blue is not visible.
  rechannel("wet.exr", "R,G,B," + maps + ",visible.R=1,visible.G=1,visible.B=0", "truth.exr");
  const Words offset = with(kColor, {"--metrics", "offset"});
  const Ran ran = compare("wet.exr", "truth.exr", offset);
  EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
  EXPECT_THAT(ran.out, ContainsRegex("\n  Offset = median 0, 95% 0, max 0 pixels, of [1-9]"));
  EXPECT_THAT(ran.out, ContainsRegex("\n    G  median 0, .* wrongly accepted 0% of [1-9]"));
  EXPECT_THAT(ran.out, ContainsRegex("\n    B  median 0, .* of 0 lookups; wrongly rejected 0%, "
                                     "wrongly accepted [1-9]"));
  // A truth whose red lookups end at the right edge.
  rechannel("wet.exr",
            "R,G,B,stmap.r.U=1,stmap.r.V,stmap.g.U,stmap.g.V,stmap.b.U,stmap.b.V,visible.R=1,"
            "visible.G=1,visible.B=1",
            "other.exr");
  const Ran other = compare("wet.exr", "other.exr", offset);
  EXPECT_THAT(other.out, ContainsRegex("\n    R  median [1-9]"));
  EXPECT_THAT(other.out, ContainsRegex("\n    B  median 0, 95% 0,"));
  EXPECT_EQ(other.code, 0);
  // Lookups that are NaN never pass.
  rechannel("wet.exr",
            "R,G,B,stmap.r.U=nan,stmap.r.V,stmap.g.U,stmap.g.V,stmap.b.U,stmap.b.V,visible.R=1,"
            "visible.G=1,visible.B=1",
            "broken.exr");
  const Ran broken = compare("wet.exr", "broken.exr", offset);
  EXPECT_EQ(broken.code, 1);
  EXPECT_THAT(broken.out, HasSubstr(" max inf pixels"));
  EXPECT_THAT(broken.out, HasSubstr("lookups are NaN or inf where they count\nFAILURE\n"));
}

/// A model is also drawn without the objects above the water, and lookups read that layer: an
/// object that hides the bottom from the dry camera does not count then.
TEST_F(CompareMetricsTest, OffsetsAreJudgedByThePictureThatWasLookedUp) {
  composed("plate_wet.exr", {"--float", "--aov", "all"});
  const std::string pool = std::string(LIMPID_DATA) + "/scenes/pool.toml";
  ASSERT_EQ(
      limpid({"water", pool, "--size", "64x36", "--float", "--aov", "all", "-o", "wet.exr"}).code,
      0);
  const std::string both =
      "R,G,B,stmap.r.U,stmap.r.V,stmap.g.U,stmap.g.V,stmap.b.U,stmap.b.V,visible.R=0,visible.G=0,"
      "visible.B=0";
  const std::string below = ",visible_below.R=1,visible_below.G=1,visible_below.B=1";
  const Words offset = with(kColor, {"--metrics", "offset"});
  const char* const none_measured = "\n  Offset = .* of 0 lookups;";
  const char* const measured = "\n  Offset = .* of [1-9][0-9]* lookups; .* wrongly accepted 0% of";

  rechannel("wet.exr", both + below, "truth.exr");
  const Ran of_model = compare("wet.exr", "truth.exr", offset);
  EXPECT_THAT(of_model.out, ContainsRegex(measured));
  EXPECT_THAT(of_model.out, HasSubstr("judged by visible_below of the truth\n"));

  rechannel("wet.exr", both, "truth.exr");
  const Ran without = compare("wet.exr", "truth.exr", offset);
  EXPECT_THAT(without.out, ContainsRegex(none_measured));
  EXPECT_THAT(without.out, HasSubstr("judged by visible of the truth\n"));

  rechannel("plate_wet.exr", both + below, "truth.exr");
  const Ran of_plate = compare("plate_wet.exr", "truth.exr", offset);
  EXPECT_THAT(of_plate.out, ContainsRegex(none_measured));
  EXPECT_THAT(of_plate.out, Not(HasSubstr("judged by")));
}

TEST_F(CompareMetricsTest, NanNeverPasses) {
  composed("wet.exr");
  rechannel("wet.exr", "R,G=nan,B", "nan.exr");
  for (const Words& pair : {Words{"wet.exr", "nan.exr"}, Words{"nan.exr", "wet.exr"}}) {
    const Ran ran = compare(
        pair[0], pair[1],
        with(kColor, {"--metrics", "ssim,flip,hdrflip", "--tolerance", "1e30", "--clip", "1"}));
    EXPECT_EQ(ran.code, 1);
    EXPECT_THAT(ran.out, HasSubstr("\n  SSIM = -inf, min -inf\n"));
    EXPECT_THAT(ran.out, HasSubstr("\n  FLIP = inf, "));
    EXPECT_THAT(ran.out, HasSubstr("\n  HDR-FLIP = inf, "));
    EXPECT_THAT(ran.out, HasSubstr("\nFAILURE\n"));
  }
}

TEST_F(CompareMetricsTest, ClipGoesForMetricsToo) {
  composed("wet.exr");
  rechannel("wet.exr", "R=5,G=5,B=5", "five.exr");
  rechannel("wet.exr", "R=9,G=inf,B=1e30", "nine.exr");
  const Words metrics = {"--metrics", "ssim,flip,hdrflip", "--clip", "4"};
  const Ran ran = compare("five.exr", "nine.exr", metrics);
  EXPECT_EQ(ran.code, 0) << ran.out;
  EXPECT_EQ(number_of(ran, "HDR-FLIP"), 0);
}

TEST_F(CompareMetricsTest, AFrameALine) {
  for (const char* number : {"1", "2", "3"}) {
    const std::string name = std::string(".000") + number + ".exr";
    composed("a" + name, {"--time", number});
    composed("b" + name, {"--time", std::string(number) == "3" ? "1" : number});
  }
  const Words metrics = {"--metrics", "ssim,flip", "--flip-map", "map.##.png"};
  const Ran ran = compare("a.####.exr", "b.%04d.exr", with(metrics, {"--frames", "1-3"}));
  EXPECT_EQ(ran.code, 1) << ran.err;
  EXPECT_THAT(ran.out, ContainsRegex("^ +frame +mean +RMS +rel. MSE +max +flicker +99% +SSIM +FLIP"
                                     "\n +1 +0 +0 +0 +0 +- +- +1 +0  PASS"
                                     "\n +2 +0 +0 +0 +0 +0 +0 +1 +0  PASS"
                                     "\n +3 +0\\.[^\n]*  FAILURE"
                                     "\n  Flicker = 0\\.0[^\n]*\n  1 of 3 frames: 3\nFAILURE\n$"));
  for (const char* map : {"map.01.png", "map.02.png", "map.03.png"}) {
    EXPECT_TRUE(std::filesystem::exists(folder_ / map)) << map;
  }
  const Ran good = compare("a.####.exr", "b.####.exr", {"--frames", "1-2"});
  EXPECT_EQ(good.code, 0);
  EXPECT_THAT(good.out, HasSubstr("\n  Flicker = 0, max 0\nPASS\n"));
  // Frame 3 has the time of frame 1: over the range 1,3 the truth does not change and the picture
  // does.
  const Ran skipped = compare("a.####.exr", "b.####.exr", {"--frames", "1,3"});
  EXPECT_GT(number_of(skipped, "Flicker"), 0);
  expect_refused(compare("a.####.exr", "b.####.exr", {"--frames", "4"}), {"a.0004.exr"});
  expect_refused(compare("a.####.exr", "b.0001.exr", {"--frames", "1-2"}),
                 {"b.0001.exr: expected %04d or # for the numbers of --frames"}, 2);
  expect_refused(compare("a.#.exr", "b.#.exr", {"--frames", "1-2", "--diff", "d.png"}),
                 {"d.png: expected %04d or #"}, 2);
  expect_refused(compare("a.#.exr", "b.#.exr", {"--frames", "soon"}), {"soon"}, 2);
}

TEST_F(CompareMetricsTest, RefusesWhatCannotBeMeasured) {
  composed("wet.exr");
  composed("aovs.exr", {"--aov", "all"});
  expect_refused(compare("wet.exr", "wet.exr", {"--metrics", "offset"}),
                 {"wet.exr has no channel 'surface_depth.Z'", "with --aov all"});
  expect_refused(compare("aovs.exr", "wet.exr", with(kColor, {"--metrics", "offset"})),
                 {"wet.exr has no channel 'visible.R': expected a ray-traced truth"});
  expect_refused(compare("wet.exr", "wet.exr", {"--metrics", "flip", "--channels", "R"}),
                 {"wet.exr: metrics of color need the channels R, G and B", "channels are R"});
  expect_refused(compare("wet.exr", "wet.exr", {"--metrics", "flpi"}),
                 {"--metrics flpi: expected some of ssim, ", "did you mean 'flip'?"}, 2);
  expect_refused(compare("wet.exr", "wet.exr", {"--ppd", "50"}),
                 {"--ppd: expected --metrics flip or hdrflip beside it"}, 2);
  expect_refused(compare("wet.exr", "wet.exr", {"--ppd", "0", "--metrics", "flip"}),
                 {"--ppd 0: expected 1 ... 1000"}, 2);
}

}  // namespace
}  // namespace limpid::test
