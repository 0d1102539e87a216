// --motion-to: motion vectors by the camera of the next frame or the previous one.
#include <array>
#include <string>

#include <gmock/gmock.h>

#include "limpid/files/exr/exr_file.h"
#include "limpid/files/text/frame_range.h"

#include "core/toml_text.h"
#include "tool/made_plate.h"
#include "tool/tool.h"

namespace limpid::test {
namespace {

using ::testing::HasSubstr;

/// Two frames of a plate that stands still, in scenes whose cameras stand apart.
class MotionToTest : public ToolTest {
 protected:
  MotionToTest() {
    for (const int frame : {1, 2}) {
      write_plate(folder_ / name_of_frame("plate.%d.exr", frame), {});
      const double c = 0.9396926207859084, s = 0.3420201433256687;  // of 20 degrees downwards
      const auto row = [](double x, double y, double z, double w) {
        return "[" + toml_text(x) + ", " + toml_text(y) + ", " + toml_text(z) + ", " +
               toml_text(w) + "]";
      };
      write_text(name_of_frame("scene.%d.toml", frame),
                 "[camera]\nview = [" + row(1, 0, 0, -0.25 * frame) + ", " + row(0, c, -s, -2 * c) +
                     ", " + row(0, s, c, -2 * s) + ", " + row(0, 0, 0, 1) +
                     "]\nfov_y = 50\n[water]\nup = [0, 1, 0]\nheight = 0\n");
    }
  }
  Words words(const std::string& frames, const Words& more) const {
    Words all{"composite", "plate.%d.exr", "--scene",    "scene.%d.toml", "--look",
              "look.toml", "-o",           "wet.%d.exr", "--frames",      frames};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  /// Some pixel's horizontal vector, and the vertical one.
  std::array<float, 2> vector(const std::string& file, const std::string& layer) const {
    const ExrFile exr = ExrFile::open(folder_ / file);
    Plane u(exr.parts().front().data), v(exr.parts().front().data);
    exr.read(
        std::array{ExrRequest{0, layer + ".u", u.view()}, ExrRequest{0, layer + ".v", v.view()}});
    return {u.view().at(50, 30), v.view().at(50, 30)};
  }
};

TEST_F(MotionToTest, LeadsThereAndBack) {
  const std::string calm = "wave_normals.strength=0";
  const Ran next = limpid(
      words("1", {"--aov", "motion,motion_reflected", "--motion-to", "next", "--set", calm}));
  const Ran previous =
      limpid(words("2", {"--aov", "motion", "--motion-to", "previous", "--set", calm}));
  ASSERT_EQ(next.code, 0) << next.err;
  ASSERT_EQ(previous.code, 0) << previous.err;
  const auto forward = vector("wet.1.exr", "motion_forward");
  const auto mirrored = vector("wet.1.exr", "motion_reflected_forward");
  const auto backward = vector("wet.2.exr", "motion_backward");
  EXPECT_LT(forward[0], -1) << "the camera moves to the right";
  EXPECT_GT(backward[0], 1);
  EXPECT_NEAR(forward[1], 0, 0.1);
  EXPECT_LE(mirrored[0], 0);
}

TEST_F(MotionToTest, IsRefusedBeforeTheFirstFrameIfTheLastHasNoNeighbor) {
  for (const int frame : {1, 2}) {
    write_plate(folder_ / name_of_frame("with_camera.%d.exr", frame), {.camera = true});
  }
  write_text("water.toml", "[water]\nup = [0, 1, 0]\nheight = 0\n");
  const auto words = [](const std::string& frames) {
    return Words{"composite",   "with_camera.%d.exr",
                 "--scene",     "water.toml",
                 "--look",      "look.toml",
                 "-o",          "wet.%d.exr",
                 "--aov",       "motion",
                 "--frames",    frames,
                 "--motion-to", "next"};
  };
  expect_refused(limpid(words("1-2")),
                 {"frame 2: the next frame, for motion vectors: ", "with_camera.3.exr"});
  EXPECT_FALSE(std::filesystem::exists(folder_ / "wet.1.exr"));
  // Its neighbor is there, and is not one of the frames.
  const Ran ran = limpid(words("1"));
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "wet.1.exr"));
}

TEST_F(MotionToTest, NeedsNoPlateWhereTheSceneHasCameraAndWater) {
  std::filesystem::remove(folder_ / "plate.2.exr");
  const Ran next = limpid(words("1", {"--aov", "motion", "--motion-to", "next"}));
  ASSERT_EQ(next.code, 0) << next.err;
  EXPECT_LT(vector("wet.1.exr", "motion_forward")[0], -1);
}

TEST_F(MotionToTest, WantsAFrameToLeadTo) {
  const Words aov{"--aov", "motion"}, to{"--aov", "motion", "--motion-to", "next"};
  expect_refused(limpid(words("1", aov)), {"no motion vectors found"});
  expect_refused(limpid(words("2", to)), {"the next frame, for motion vectors: ", "scene.3.toml"});
  expect_refused(limpid(words("1", {"--motion-to", "next"})),
                 {"--motion-to next: expected --aov motion or motion_reflected"}, 2);
  expect_refused(
      limpid(words("1", {"--aov", "motion", "--motion-to", "next", "--missing", "hold"})),
      {"--motion-to next: expected --missing error"}, 2);
  write_plate(folder_ / "plate.exr", {});
  expect_refused(composite("wet.exr", to), {"--motion-to next: expected --frames"}, 2);
}

}  // namespace
}  // namespace limpid::test
