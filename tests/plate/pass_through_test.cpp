#include <gmock/gmock.h>

#include "limpid/core/error.h"
#include "limpid/plate/plate.h"

#include "files/exr/part_files.h"

/// Which layers of a plate are pass-through.

namespace limpid {
namespace {

namespace fs = std::filesystem;
using exr_test::part_of;
using exr_test::write_parts;
using exr_test::WrittenPart;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Names = std::vector<std::string>;

const Rect kSize{0, 0, 8, 6};

class PassThroughTest : public ::testing::Test {
 protected:
  PassThroughTest()
      : here_(fs::path(testing::TempDir()) /
              (std::string("pass_through_") +
               testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(here_);
    fs::create_directories(here_);
  }

  void write(const std::string& file, const std::vector<WrittenPart>& parts) const {
    write_parts(here_ / file, kSize, parts);
  }
  Plate open(const Names& files, const std::string& view = "") const {
    PlateRequest request;
    for (const std::string& file : files) request.files.push_back(here_ / file);
    request.view = view;
    return Plate::open(request);
  }
  static std::string error_of(const Plate& plate, const Names& names) {
    try {
      plate.passed(names);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  fs::path here_;
};

WrittenPart blender_part() {
  WrittenPart part =
      part_of("", kSize,
              {"ViewLayer.Combined.R", "ViewLayer.Combined.G", "ViewLayer.Combined.B",
               "ViewLayer.Combined.A", "ViewLayer.Depth.Z", "ViewLayer.Normal.X",
               "ViewLayer.Normal.Y", "ViewLayer.Normal.Z", "ViewLayer.CryptoObject00.r",
               "ViewLayer.CryptoObject01.r", "ViewLayer.CryptoAsset00.r"});
  part.texts = {{"cryptomatte/1111111/name", "ViewLayer.CryptoObject"},
                {"cryptomatte/1111111/manifest", "{\"rock\":\"3f800000\"}"},
                {"cryptomatte/2222222/name", "ViewLayer.CryptoAsset"},
                {"cryptomatte/2222222/manifest", "{\"all\":\"3f000000\"}"}};
  return part;
}

TEST_F(PassThroughTest, AllIsAllButTheColor) {
  write("plate.exr", {blender_part()});
  const Plate plate = open({"plate.exr"});
  EXPECT_THAT(plate.passed({}), IsEmpty());
  const std::vector<PassedPart> passed = plate.passed({"all"});
  ASSERT_EQ(passed.size(), 1U);
  EXPECT_TRUE(passed[0].of_color);
  EXPECT_THAT(passed[0].channels,
              ElementsAre("ViewLayer.CryptoAsset00.r", "ViewLayer.CryptoObject00.r",
                          "ViewLayer.CryptoObject01.r", "ViewLayer.Depth.Z", "ViewLayer.Normal.X",
                          "ViewLayer.Normal.Y", "ViewLayer.Normal.Z"));
  EXPECT_EQ(passed[0].attributes.size(), 4U);
  EXPECT_THAT(plate.other_layers(),
              ElementsAre("ViewLayer.CryptoAsset00", "ViewLayer.CryptoObject00",
                          "ViewLayer.CryptoObject01", "ViewLayer.Normal"));
}

TEST_F(PassThroughTest, NamesMeanWhatTheyMeanElsewhere) {
  write("plate.exr", {blender_part()});
  const Plate plate = open({"plate.exr"});
  const auto channels = [&](const Names& names) { return plate.passed(names).at(0).channels; };
  const Names normal = {"ViewLayer.Normal.X", "ViewLayer.Normal.Y", "ViewLayer.Normal.Z"};
  for (const char* name : {"ViewLayer.Normal", "viewlayer.normal", "Normal", "ViewLayer.N*"}) {
    EXPECT_EQ(channels({name}), normal) << name;
  }
  EXPECT_THAT(channels({"Normal.Y", "depth"}),
              ElementsAre("ViewLayer.Depth.Z", "ViewLayer.Normal.Y"));
  EXPECT_THAT(channels({"ViewLayer.Combined"}).size(), 4U);
  EXPECT_THAT(error_of(plate, {"Norml"}), HasSubstr("no layer or channel 'Norml'"));
  EXPECT_THAT(error_of(plate, {"x*"}), HasSubstr("no layer or channel 'x*'"));
}

TEST_F(PassThroughTest, ACryptomatteIsAllItsRanksWithItsManifest) {
  write("plate.exr", {blender_part()});
  const Plate plate = open({"plate.exr"});
  for (const char* name : {"ViewLayer.CryptoObject", "CryptoObject"}) {
    const PassedPart passed = plate.passed({name}).at(0);
    EXPECT_THAT(passed.channels,
                ElementsAre("ViewLayer.CryptoObject00.r", "ViewLayer.CryptoObject01.r"));
    EXPECT_TRUE(passed.attributes.contains("cryptomatte/1111111/manifest"));
    EXPECT_FALSE(passed.attributes.contains("cryptomatte/2222222/manifest"));
  }
  EXPECT_THAT(plate.passed({"Normal"}).at(0).attributes, IsEmpty());
}

TEST_F(PassThroughTest, PartsAndFilesKeepTheirNames) {
  const WrittenPart depth = part_of("depth", kSize, {"Z"});
  WrittenPart crypto = part_of("crypto00", kSize, {"R", "G"});
  WrittenPart rgba = part_of("rgba", kSize, {"R", "G", "B"});
  // Renderers note manifests in the first part.
  rgba.texts = {{"cryptomatte/1/name", "crypto"}, {"cryptomatte/1/manifest", "{}"}};
  crypto.texts = {{"mine", "yes"}, {"limpid/look", "no"}};
  write("plate.exr", {rgba, depth, crypto, part_of("ids", kSize, {"Y"})});
  write("normals.0012.exr", {part_of("", kSize, {"X", "Y", "Z"})});
  write("more.exr", {part_of("ids", kSize, {"V"})});
  const Plate plate = open({"plate.exr", "normals.0012.exr", "more.exr"});
  const std::vector<PassedPart> passed = plate.passed({"crypto", "normals", "ids", "depth"});
  ASSERT_EQ(passed.size(), 5U);
  EXPECT_EQ(passed[0].name, "depth");
  EXPECT_EQ(passed[1].name, "crypto00");
  EXPECT_TRUE(passed[1].attributes.contains("cryptomatte/1/manifest"));
  EXPECT_TRUE(passed[1].attributes.contains("mine"));
  EXPECT_FALSE(passed[1].attributes.contains("limpid/look"));
  EXPECT_EQ(passed[2].name, "ids");
  EXPECT_EQ(passed[3].name, "normals");
  EXPECT_THAT(passed[3].channels, ElementsAre("X", "Y", "Z"));
  EXPECT_EQ(passed[4].name, "more.ids");
  for (const PassedPart& part : passed) EXPECT_FALSE(part.of_color);
}

TEST_F(PassThroughTest, LayersOfOtherViewsStay) {
  WrittenPart part =
      part_of("", kSize,
              {"R", "G", "B", "Z", "N.X", "right.R", "right.G", "right.B", "right.Z", "N.right.X"});
  part.multi_view = {"left", "right"};
  write("stereo.exr", {part});
  EXPECT_THAT(open({"stereo.exr"}).passed({"all"}).at(0).channels, ElementsAre("N.X", "Z"));
  EXPECT_THAT(open({"stereo.exr"}, "right").passed({"all"}).at(0).channels,
              ElementsAre("N.right.X", "right.Z"));
}

TEST_F(PassThroughTest, DeepSamplesAreRefused) {
  WrittenPart deep = part_of("ids", kSize, {"Z", "id"});
  deep.deep = true;
  write("plate.exr",
        {part_of("rgba", kSize, {"R", "G", "B"}), part_of("depth", kSize, {"Z"}), deep});
  const Plate plate = open({"plate.exr"});
  EXPECT_THAT(error_of(plate, {"all"}), HasSubstr("holds deep samples, which are not passed"));
  EXPECT_THAT(error_of(plate, {"ids"}), HasSubstr("plate.exr, part 2"));
  EXPECT_EQ(plate.passed({"depth"}).size(), 1U);
}

}  // namespace
}  // namespace limpid
