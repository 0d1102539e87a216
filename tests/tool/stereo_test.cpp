#include <array>

#include <gmock/gmock.h>

#include "limpid/files/exr/exr_camera.h"
#include "limpid/files/exr/exr_file.h"

#include "files/exr/part_files.h"
#include "tool/made_plate.h"
#include "tool/tool.h"

/// All views of a plate in one run.

namespace limpid::test {
namespace {

using ::testing::HasSubstr;

class StereoTest : public ToolTest {
 protected:
  /// Two plates with separate cameras, and a scene file for each.
  StereoTest() {
    write_plate(folder_ / "left.exr");
    write_plate(folder_ / "right.exr", {.depth_code = [](double z, double) { return 0.9 * z; }});
    const std::string scene = scene_toml();
    write_text("left.toml", scene);
    write_text("right.toml", moved(scene));
  }
  /// The first row of the view matrix moves the world a little to the left.
  static std::string moved(std::string scene) {
    const std::size_t row = scene.find("view = [[") + 9;
    const std::size_t end = scene.find(']', row);
    const std::size_t last = scene.rfind(',', end);
    return scene.replace(last + 1, end - last - 1, " -0.3");
  }
  /// One file with both plates; channels of the right plate have the prefix `right`.
  void write_stereo() const {
    exr_test::WrittenPart part{"", "", kPicture, {}};
    for (const std::string view : {"left", "right"}) {
      const ExrFile from = ExrFile::open(folder_ / (view + ".exr"));
      for (const ExrChannel& channel : from.parts()[0].channels) {
        const std::size_t dot = channel.name.rfind('.') + 1;
        std::string name = channel.name;
        if (view == "right") name.insert(dot, "right.");
        Plane plane(kPicture);
        from.read(std::array{ExrRequest{0, channel.name, plane.view()}});
        for (int y = 0; y < kPicture.y1; ++y) {
          const float* row = plane.view().row(y);
          part.channels[name].insert(part.channels[name].end(), row, row + kPicture.x1);
        }
      }
    }
    part.multi_view = {"left", "right"};
    exr_test::write_parts(folder_ / "stereo.exr", kPicture, {part});
  }
  Ran wet(const std::string& plate, const std::string& scene, const std::string& output,
          const Words& more = {}) const {
    Words words = {"composite", plate, "--scene", scene, "--look", "look.toml", "-o", output};
    words.insert(words.end(), more.begin(), more.end());
    return limpid(words);
  }
  void wetted(const std::string& plate, const std::string& scene, const std::string& output,
              const Words& more = {}) const {
    const Ran ran = wet(plate, scene, output, more);
    ASSERT_EQ(ran.code, 0) << ran.err;
  }
};

TEST_F(StereoTest, EachViewIsWhatItIsAlone) {
  wetted("left.exr", "left.toml", "wet_left.exr", {"--aov", "path"});
  wetted("right.exr", "right.toml", "wet_right.exr", {"--aov", "path"});
  ASSERT_FALSE(same("wet_left.exr", "wet_right.exr"));
  wetted("%V.exr", "%V.toml", "both.exr", {"--view", "left,right", "--aov", "path"});

  const ExrFile file = ExrFile::open(folder_ / "both.exr");
  ASSERT_EQ(file.parts().size(), 2U);
  EXPECT_EQ(file.parts()[0].name, "left");
  EXPECT_EQ(file.parts()[0].view, "left");
  EXPECT_EQ(file.parts()[1].name, "right");
  EXPECT_EQ(file.parts()[1].view, "right");
  EXPECT_NE(camera_of(file, 0)->view, camera_of(file, 1)->view);
  EXPECT_EQ(oiiotool({"wet_left.exr", "both.exr", "--subimage", "0", "--diff"}).code, 0);
  EXPECT_EQ(oiiotool({"wet_right.exr", "both.exr", "--subimage", "1", "--diff"}).code, 0);
  EXPECT_EQ(limpid({"compare", "wet_right.exr", "both.exr", "--channels",
                    "R=right.R,path=right.path", "--tolerance", "0"})
                .code,
            0);
  // Each part records its provenance, and the first part that of all.
  const ExrFile alone = ExrFile::open(folder_ / "wet_right.exr");
  for (const char* name : {"limpid/scene", "limpid/inputs", "limpid/look"}) {
    const auto text = alone.text_attribute(0, name);
    ASSERT_TRUE(text);
    EXPECT_EQ(file.text_attribute(1, name), text) << name;
    EXPECT_EQ(file.text_attribute(0, "limpid/view/right/" + std::string(name).substr(7)), text);
  }
}

TEST_F(StereoTest, ReadsBackAsStereo) {
  wetted("%V.exr", "%V.toml", "both.exr", {"--view", "left,right"});
  const Ran seen = limpid({"inspect", "both.exr"});
  EXPECT_THAT(seen.out, HasSubstr("views\n  left (used), right\n"));
}

TEST_F(StereoTest, AllIsEveryViewOfOneFile) {
  write_stereo();
  wetted("left.exr", "left.toml", "wet_left.exr");
  wetted("right.exr", "right.toml", "wet_right.exr");
  wetted("stereo.exr", "%V.toml", "both.exr", {"--view", "all"});
  EXPECT_EQ(oiiotool({"wet_left.exr", "both.exr", "--subimage", "0", "--diff"}).code, 0);
  EXPECT_EQ(oiiotool({"wet_right.exr", "both.exr", "--subimage", "1", "--diff"}).code, 0);
  expect_refused(wet("stereo.exr", "left.toml", "wrong.exr", {"--view", "all"}),
                 {"views left and right have the same camera", "a scene for each"});
}

TEST_F(StereoTest, SequencesAndTheirRest) {
  for (const std::string frame : {"1", "2"}) {
    for (const std::string view : {"left", "right"}) {
      std::filesystem::copy(folder_ / (view + ".exr"), folder_ / (view + "." + frame + ".exr"));
    }
  }
  const Words frames = {"--view", "left,right", "--frames", "1-2", "--resume"};
  wetted("%V.%d.exr", "%V.toml", "both.%d.exr", frames);
  EXPECT_THAT(wet("%V.%d.exr", "%V.toml", "both.%d.exr", frames).err,
              HasSubstr("2 of 2 frames are kept"));
  // Another camera for the right eye gives another picture.
  write_plate(folder_ / "right.2.exr");
  EXPECT_THAT(
      wet("%V.%d.exr", "%V.toml", "both.%d.exr", frames).err,
      HasSubstr("both.2.exr was made differently (view/right/inputs, view/right/scene_hash)"));
  std::filesystem::remove(folder_ / "right.1.exr");
  expect_refused(
      wet("%V.%d.exr", "%V.toml", "new.%d.exr", {"--view", "left,right", "--frames", "1"}),
      {"right.1.exr: cannot be opened"});
}

TEST_F(StereoTest, WhatCannotBeIsRefused) {
  const auto refused = [&](const std::string& plate, const std::string& scene, const Words& more,
                           const Words& parts, int code) {
    expect_refused(wet(plate, scene, "wrong.exr", more), parts, code);
  };
  refused("%V.exr", "%V.toml", {}, {"%V.toml: expected --view with the names", "that replace %V"},
          2);
  refused("%V.exr", "left.toml", {"--view", "left,left"},
          {"views left and left: expected each once"}, 2);
  refused("%V.exr", "%V.toml", {"--view", "left,right", "--deep", "deep.exr"},
          {"deep.exr: a deep file holds one view, and --view names 2"}, 2);
  refused("left.exr", "left.toml", {"--view", "all"}, {"no plate has any"}, 2);
  refused("%V.exr", "%V.toml", {"--view", "left,"}, {"--view left,: expected names"}, 2);
  refused("%V.exr", "%V.toml", {"--view", "left,right", "-n"}, {"--view: expected one view"}, 2);
  expect_refused(limpid({"composite", "%V.exr", "--scene", "%V.toml", "--view", "left,right", "-o",
                         "wet_%V.exr"}),
                 {"-o wet_%V.exr: expected a name without %V"}, 2);
}

}  // namespace
}  // namespace limpid::test
