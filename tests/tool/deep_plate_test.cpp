#include <gmock/gmock.h>

#include "files/exr/deep_files.h"
#include "tool/made_plate.h"
#include "tool/tool.h"

/// A deep plate from the file to the picture: a red post stands before green ground under water.

namespace limpid::test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kPostBegins = 30, kPostEnds = 34, kHorizon = 8;
constexpr float kPostDepth = 1.5f;

exr_test::DeepValues opaque(double z, float red, float green) {
  return {{"Z", static_cast<float>(z)}, {"R", red}, {"G", green}, {"B", 0}, {"A", 1}};
}

class DeepPlateTest : public ToolTest {
 protected:
  DeepPlateTest() {
    exr_test::DeepPicture deep = exr_test::rgbaz();
    deep.data = kPicture;
    const Rays rays = rays_of(plate_camera(), {kPicture.width(), kPicture.height()});
    for (int y = kHorizon; y < kPicture.height(); ++y) {
      for (int x = 0; x < kPicture.width(); ++x) {
        auto& samples = deep.samples[{x, y}];
        const bool post = x >= kPostBegins && x < kPostEnds;
        if (post) samples.push_back(opaque(kPostDepth, 1, 0));
        samples.push_back(opaque(-3 / rays.ray_at(x + 0.5, y + 0.5).y, 0, 0.5f));
      }
    }
    exr_test::write_deep_picture((folder_ / "deep.exr").string(), deep);
  }

  /// Water that bends the view and does nothing else.
  Ran wet(const std::string& output, const Words& more = {}) const {
    Words words = {"composite", "deep.exr", "--scene", "scene.toml", "--look",
                   "look.toml", "--float",  "-q",      "-o",         output};
    for (const char* setting :
         {"refraction.rejection=\"none\"", "refraction.strength=0.1", "depth_fog.alpha=0",
          "sun_highlight.strength=0", "fresnel_reflection.strength=0"}) {
      words.insert(words.end(), {"--set", setting});
    }
    words.insert(words.end(), more.begin(), more.end());
    return limpid(words);
  }
  /// The statistics that oiiotool gives of a channel of the water beside the post.
  std::string beside_the_post(const std::string& file, const std::string& channel) const {
    return oiiotool({file, "--cut", "10x24+20+12", "--ch", channel, "--printstats"}).out;
  }
};

TEST_F(DeepPlateTest, TheBottomIsSeenBesideThePostAndNoPostInTheWater) {
  const Ran ran = wet("wet.exr");
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(beside_the_post("wet.exr", "R"), HasSubstr("Stats Max: 0.000000"));
  EXPECT_THAT(beside_the_post("wet.exr", "G"), HasSubstr("Stats Min: 0.500000"));
  // The post itself stays.
  EXPECT_THAT(oiiotool({"wet.exr", "--cut", "4x24+30+12", "--ch", "R", "--printstats"}).out,
              HasSubstr("Stats Min: 1.000000"));
  // Without the samples behind the post, the post's color bleeds into the water.
  const Ran flat = wet("flat.exr", {"--layer", "below_color=none", "--layer", "below_depth=none"});
  ASSERT_EQ(flat.code, 0) << flat.err;
  EXPECT_THAT(beside_the_post("flat.exr", "R"), Not(HasSubstr("Stats Max: 0.000000")));
}

TEST_F(DeepPlateTest, InspectAndPlanSayWhatTheSamplesGive) {
  const Ran seen = limpid({"inspect", "deep.exr"});
  EXPECT_EQ(seen.code, 0) << seen.err;
  EXPECT_THAT(seen.out, HasSubstr(", deep\n"));
  EXPECT_THAT(seen.out, ContainsRegex("below_color +R G B +.deep.exr. +- deep samples behind"));
  const Ran plan = limpid({"plan", "deep.exr", "--scene", "scene.toml", "--look", "look.toml"});
  EXPECT_THAT(plan.out, HasSubstr("reads color, depth, below_color, below_depth\n"));
}

TEST_F(DeepPlateTest, WithoutWhatIsBelowItIsTheFlattenedPlate) {
  const Words layers = {"--layer", "below_color=none", "--layer", "below_depth=none"};
  ASSERT_EQ(wet("from_deep.exr", layers).code, 0);
  ASSERT_EQ(oiiotool({"deep.exr", "--flatten", "-d", "float", "-o", "deep.exr"}).code, 0);
  ASSERT_THAT(limpid({"inspect", "deep.exr"}).out, Not(HasSubstr(", deep\n")));
  ASSERT_EQ(wet("from_flat.exr", layers).code, 0);
  EXPECT_TRUE(same("from_deep.exr", "from_flat.exr", 1e-5));
}

TEST_F(DeepPlateTest, DeepInDeepOut) {
  const Ran ran = wet("wet.exr", {"--deep", "water.exr"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const std::string info = iinfo("wet.exr");
  EXPECT_THAT(info, Not(HasSubstr("deep")));
  EXPECT_THAT(iinfo("water.exr"), HasSubstr("deep"));
}

}  // namespace
}  // namespace limpid::test
