#include <gmock/gmock.h>

#include "limpid/files/exr/exr_file.h"

#include "files/exr/part_files.h"
#include "tool/made_plate.h"
#include "tool/tool.h"

/// The same picture in plates of several parts and views.

namespace limpid::test {
namespace {

using exr_test::write_parts;
using exr_test::WrittenPart;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

/// A channel of the plate, renamed.
struct Renamed {
  std::string channel, from;
};

class PartsTest : public ToolTest {
 protected:
  /// A part that holds these channels of a plate.
  WrittenPart part(const std::string& name, const std::vector<Renamed>& channels,
                   const std::string& plate = "plate.exr", const std::string& view = "") const {
    const ExrFile file = ExrFile::open(folder_ / plate);
    WrittenPart part{name, view, file.parts()[0].data, {}};
    for (const auto& [channel, from] : channels) {
      Plane plane(part.data);
      file.read(std::array{ExrRequest{0, from, plane.view()}});
      std::vector<float>& values = part.channels[channel];
      for (int y = part.data.y0; y < part.data.y1; ++y) {
        const float* row = plane.view().row(y);
        values.insert(values.end(), row, row + part.data.width());
      }
    }
    return part;
  }
  void write(const std::string& file, const std::vector<WrittenPart>& parts) const {
    write_parts(folder_ / file, kPicture, parts);
  }
  Ran wet(const std::string& plate, const std::string& output, const Words& more = {}) const {
    Words words = {"composite", plate, "--scene", "scene.toml", "--look",
                   "look.toml", "-o",  output,    "-q"};
    words.insert(words.end(), more.begin(), more.end());
    return limpid(words);
  }
  /// Expects the same picture as from another composite.
  void expect_as(const std::string& expected, const std::string& plate,
                 const Words& more = {}) const {
    const Ran ran = wet(plate, "of_parts.exr", more);
    EXPECT_EQ(ran.code, 0) << plate << ": " << ran.err;
    EXPECT_TRUE(same(expected, "of_parts.exr")) << plate;
  }
};

const std::vector<Renamed> kRgba = {{"R", "R"}, {"G", "G"}, {"B", "B"}, {"A", "A"}};
const std::vector<Renamed> kRgbaz = {
    {"R", "R"}, {"G", "G"}, {"B", "B"}, {"A", "A"}, {"Z", "depth.Z"}};
const std::vector<Renamed> kMirror = {
    {"R", "reflection.R"}, {"G", "reflection.G"}, {"B", "reflection.B"}};

TEST_F(PartsTest, AnyPartsGiveThePictureOfOne) {
  composed("wet.exr");
  const WrittenPart shadow = part("shadow", {{"Y", "shadow.Y"}});
  const WrittenPart mirror = part("reflection", kMirror);
  std::vector<WrittenPart> parts = {part("rgba", kRgba), part("depth", {{"Z", "depth.Z"}}), shadow,
                                    mirror};
  write("four.exr", parts);
  expect_as("wet.exr", "four.exr");
  parts[0].tile = 16;
  parts[1].compression = Imf::PIZ_COMPRESSION;
  parts[2].compression = Imf::RLE_COMPRESSION;
  std::swap(parts[0], parts[3]);
  write("mixed.exr", parts);
  expect_as("wet.exr", "mixed.exr");
  write("main.exr", {part("main", kRgbaz), shadow, mirror});
  expect_as("wet.exr", "main.exr");
  for (const char* channel : {"Z", "Y", "depth"}) {
    write("z.exr", {part("rgba", kRgba), part("Z", {{channel, "depth.Z"}}), shadow, mirror});
    expect_as("wet.exr", "z.exr");
  }
  write("odd.exr", {part("one", kRgba), part("two", {{"far", "depth.Z"}}), shadow, mirror});
  expect_as("wet.exr", "odd.exr", {"--layer", "depth=two.far"});
}

TEST_F(PartsTest, AViewPicksAllRoles) {
  write_plate(folder_ / "right.exr", {.depth_code = [](double z, double) { return 0.9 * z; }});
  composed("wet_left.exr");
  ASSERT_EQ(wet("right.exr", "wet_right.exr").code, 0);
  ASSERT_FALSE(same("wet_left.exr", "wet_right.exr"));
  std::vector<WrittenPart> parts;
  for (const std::string view : {"left", "right"}) {
    const std::string plate = view == "left" ? "plate.exr" : "right.exr";
    parts.push_back(part("rgba_" + view, kRgba, plate, view));
    parts.push_back(part("depth_" + view, {{"Z", "depth.Z"}}, plate, view));
  }
  parts.push_back(part("shadow", {{"Y", "shadow.Y"}}));
  parts.push_back(part("reflection", kMirror));
  write("stereo.exr", parts);
  expect_as("wet_left.exr", "stereo.exr");
  expect_as("wet_left.exr", "stereo.exr", {"--view", "left"});
  expect_as("wet_right.exr", "stereo.exr", {"--view", "right"});
  expect_as("wet_right.exr", "stereo.exr", {"--layer", "color=rgba_right"});
  EXPECT_THAT(limpid({"inspect", "stereo.exr", "--view", "right"}).out,
              ContainsRegex("\nviews\n  left, right \\(used\\)\nfound\n"
                            "  color +R G B A +\\(stereo.exr, part 2\\)  - part 'rgba_right'"));
  expect_refused(wet("stereo.exr", "wrong.exr", {"--view", "middle"}),
                 {"view 'middle': expected one of left, right"});
  expect_refused(wet("plate.exr", "wrong.exr", {"--view", "left"}), {"no plate has views"});
}

TEST_F(PartsTest, OnePartOfSeveralViews) {
  write_plate(folder_ / "right.exr", {.depth_code = [](double z, double) { return 0.9 * z; }});
  WrittenPart one = part("", kRgbaz);
  for (auto& [name, values] : part("", kRgbaz, "right.exr").channels) {
    one.channels["right." + name] = values;
  }
  one.multi_view = {"left", "right"};
  write("stereo.exr", {one});
  const Words alone = {"--layer", "shadow=none", "--layer", "reflection=none"};
  ASSERT_EQ(wet("plate.exr", "wet_left.exr", alone).code, 0);
  ASSERT_EQ(wet("right.exr", "wet_right.exr", alone).code, 0);
  expect_as("wet_left.exr", "stereo.exr");
  expect_as("wet_right.exr", "stereo.exr", {"--view", "right"});
}

TEST_F(PartsTest, TheOutputTellsOfItselfAlone) {
  WrittenPart plate = part("", kRgbaz);
  plate.channels["CryptoObject00.r"] = plate.channels["R"];
  plate.texts = {{"cryptomatte/f834d0a/name", "CryptoObject"},
                 {"cryptomatte/f834d0a/manifest", "{\"rock\":\"3f800000\"}"},
                 {"BlenderMultiChannel", "Blender V2.55.1 and newer"},
                 {"shot/take", "12b"}};
  plate.multi_view = {"left", "right"};
  write("noted.exr", {plate});
  ASSERT_EQ(wet("noted.exr", "wet.exr", {"--deep", "deep.exr"}).code, 0);
  for (const char* name : {"wet.exr", "deep.exr"}) {
    const auto attributes = ExrFile::open(folder_ / name).attributes(0);
    EXPECT_TRUE(attributes.contains("shot/take")) << name;
    for (const auto& [key, attribute] : attributes) {
      EXPECT_FALSE(key.starts_with("cryptomatte/") || key == "multiView" ||
                   key == "BlenderMultiChannel")
          << name << ": " << key;
    }
  }
}

}  // namespace
}  // namespace limpid::test
