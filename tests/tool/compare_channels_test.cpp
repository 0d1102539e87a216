#include <gmock/gmock.h>

#include "tool/tool.h"

/// Which channels of two pictures `compare` compares.

namespace limpid::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class CompareChannelsTest : public ToolTest {
 protected:
  CompareChannelsTest() {
    composed("wet.exr", {"--aov", "path,reflected"});
    const Ran ran =
        oiiotool({"wet.exr", "--ch",
                  "View.Combined.R=R,View.Combined.G=G,View.Combined.B=B,View.Combined.A=A,"
                  "View.Depth.Z=path.Z,other.R=G,other.G=R",
                  "-d", "float", "-o", "layers.exr"});
    EXPECT_EQ(ran.code, 0) << ran.err;
  }
  Ran compare(const std::string& a, const std::string& b, const std::string& channels,
              const Words& more = {}) const {
    Words words{"compare", a, b, "--channels", channels};
    words.insert(words.end(), more.begin(), more.end());
    return limpid(words);
  }
};

TEST_F(CompareChannelsTest, PairsOfOneNameEach) {
  const Ran ran = compare("wet.exr", "layers.exr", "R=View.Combined.R,path.Z=View.Depth.Z");
  EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("R=View.Combined.R"));
  EXPECT_THAT(ran.out, HasSubstr("path.Z=View.Depth.Z"));
  EXPECT_EQ(compare("layers.exr", "wet.exr", "other.R=G").code, 0);
  EXPECT_EQ(compare("layers.exr", "wet.exr", "other.R=R").code, 1);
  EXPECT_EQ(compare("wet.exr", "wet.exr", "R=G").code, 1);
  EXPECT_EQ(compare("wet.exr", "wet.exr", "R=R,path.Z").code, 0);
}

TEST_F(CompareChannelsTest, ALayerIsAllItsChannels) {
  const Ran ran = compare("layers.exr", "layers.exr", "View.Combined");
  EXPECT_EQ(ran.code, 0) << ran.err;
  for (const char* name :
       {"View.Combined.R", "View.Combined.G", "View.Combined.B", "View.Combined.A"}) {
    EXPECT_THAT(ran.out, HasSubstr(name));
  }
  EXPECT_THAT(ran.out, Not(HasSubstr("View.Depth")));
}

TEST_F(CompareChannelsTest, LayersPairByTheirComponents) {
  ASSERT_EQ(oiiotool({"wet.exr", "--ch", "rgb.R=R,rgb.G=G,rgb.B=B", "-o", "rgb.exr"}).code, 0);
  EXPECT_EQ(compare("layers.exr", "wet.exr", "View.Depth=path").code, 0);
  const Ran ran = compare("wet.exr", "rgb.exr", "reflected=rgb", {"--tolerance", "100"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("reflected.R=rgb.R"));
  EXPECT_THAT(ran.out, HasSubstr("reflected.B=rgb.B"));
  expect_refused(compare("layers.exr", "rgb.exr", "View.Combined=rgb"),
                 {"--channels View.Combined=rgb: View.Combined.A, ",
                  "cannot be compared with rgb.B", "expected the same components"});
}

TEST_F(CompareChannelsTest, MetricsOfColorTakeTheColorsOfTheLayer) {
  const Ran ran =
      compare("wet.exr", "layers.exr", "R=View.Combined.R,G=View.Combined.G,B=View.Combined.B",
              {"--metrics", "ssim,flip"});
  EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("\n  SSIM = 1, min 1\n"));
}

TEST_F(CompareChannelsTest, ANameMayHoldAnEqualsSign) {
  for (const char* file : {"a.exr", "b.exr"}) {
    ASSERT_EQ(oiiotool({"wet.exr", "--ch", "R", "--chnames", "x=y", "-o", file}).code, 0);
  }
  EXPECT_EQ(compare("a.exr", "b.exr", "x=y").code, 0);
  EXPECT_EQ(compare("a.exr", "wet.exr", "x=y=R").code, 0);
  EXPECT_EQ(compare("wet.exr", "b.exr", "R=x=y").code, 0);
}

TEST_F(CompareChannelsTest, WrongNamesAreToldWithWhatThereIs) {
  expect_refused(
      compare("wet.exr", "layers.exr", "R=View.Combined.Q"),
      {"layers.exr has no channel or layer 'View.Combined.Q': there is View.Combined.A, ",
       "did you mean 'View.Combined."});
  expect_refused(compare("wet.exr", "layers.exr", "Q=View.Combined.R"),
                 {"wet.exr has no channel or layer 'Q': there is A, B, G, R, path.Z"});
  expect_refused(compare("wet.exr", "layers.exr", "View.Combined"),
                 {"wet.exr has no channel or layer 'View.Combined': there is A, B, G, R, path.Z"});
  expect_refused(compare("layers.exr", "layers.exr", "View"),
                 {"layers.exr has no channel or layer 'View'"});
  expect_refused(compare("wet.exr", "wet.exr", "=R"), {"wet.exr has no channel or layer ''"});
}

}  // namespace
}  // namespace limpid::test
