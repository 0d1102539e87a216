#include <fstream>

#include <gmock/gmock.h>

#include "limpid/files/exr/exr_file.h"

#include "files/exr/part_files.h"
#include "tool/made_plate.h"
#include "tool/tool.h"

/// Other layers of a plate are copied beside the picture, unchanged.

namespace limpid::test {
namespace {

using exr_test::write_parts;
using exr_test::WrittenPart;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class PassThroughTest : public ToolTest {
 protected:
  /// A part with the plate's channels, and further layers: a cryptomatte, object ids, normals with
  /// arbitrary bits, and vectors.
  WrittenPart plate(const Rect& data = kPicture) const {
    WrittenPart part{"", "", data, {}};
    add(part, "plate.exr", {"R", "G", "B", "A", "depth.Z"});
    part.texts = {{"cryptomatte/f834d0a/name", "CryptoObject"},
                  {"cryptomatte/f834d0a/hash", "MurmurHash3_32"},
                  {"cryptomatte/f834d0a/manifest", "{\"rock\":\"3f800000\"}"},
                  {"shot/take", "12b"}};
    for (int y = data.y0; y < data.y1; ++y) {
      for (int x = data.x0; x < data.x1; ++x) {
        const auto n = static_cast<std::uint32_t>(1 + x + 1000 * y);
        part.channels["CryptoObject00.r"].push_back(1e30f * static_cast<float>(n));
        part.uints["IndexOB.X"].push_back(n * 2654435761U);
        part.halves["Normal.X"].push_back(static_cast<std::uint16_t>(n * 40503U));
        part.channels["Vector.X"].push_back(0.1f * static_cast<float>(x));
      }
    }
    return part;
  }
  void add(WrittenPart& part, const std::string& file, const Words& channels) const {
    const ExrFile from = ExrFile::open(folder_ / file);
    for (const std::string& channel : channels) {
      Plane plane(part.data);
      from.read(std::array{ExrRequest{0, channel, plane.view(), 1}});
      for (int y = part.data.y0; y < part.data.y1; ++y) {
        const float* row = plane.view().row(y);
        auto& values = part.channels[channel];
        values.insert(values.end(), row, row + part.data.width());
      }
    }
  }
  void write(const std::string& file, const std::vector<WrittenPart>& parts) const {
    write_parts(folder_ / file, kPicture, parts);
  }
  Ran wet(const Words& plates, const Words& more = {}) const {
    Words words = {"composite", "--scene", "scene.toml", "--look", "look.toml", "-o", "wet.exr"};
    words.insert(words.begin() + 1, plates.begin(), plates.end());
    words.insert(words.end(), more.begin(), more.end());
    return limpid(words);
  }
  void wetted(const Words& plates, const Words& more = {}) const {
    const Ran ran = wet(plates, more);
    ASSERT_EQ(ran.code, 0) << ran.err;
  }
  static Words channels(const ExrPart& part) {
    Words names;
    for (const ExrChannel& channel : part.channels) names.push_back(channel.name);
    return names;
  }
  /// The bits of a channel in the rows of a window.
  std::vector<char> bits(const std::string& file, int part, const std::string& channel) const {
    const ExrFile exr = ExrFile::open(folder_ / file);
    const Rect data = exr.parts()[static_cast<std::size_t>(part)].data;
    std::vector<char> bytes(static_cast<std::size_t>(data.area()) * 4);
    char* const into[] = {bytes.data()};
    exr.read_stored(part, std::array{channel}, data.y0, data.y1, into);
    return bytes;
  }
};

TEST_F(PassThroughTest, WhatIsNamedIsBesideThePictureBitByBit) {
  write("full.exr", {plate()});
  wetted({"full.exr"}, {"-q"});
  std::filesystem::copy(folder_ / "wet.exr", folder_ / "bare.exr");
  const Words all = {"CryptoObject00.r", "IndexOB.X", "Normal.X", "Vector.X"};
  wetted({"full.exr"}, {"--pass-through", "all", "-q"});
  const ExrFile file = ExrFile::open(folder_ / "wet.exr");
  ASSERT_EQ(file.parts().size(), 1U);
  EXPECT_THAT(channels(file.parts()[0]), ElementsAre("A", "B", "CryptoObject00.r", "G", "IndexOB.X",
                                                     "Normal.X", "R", "Vector.X", "depth.Z"));
  for (const std::string& channel : all) {
    EXPECT_EQ(bits("wet.exr", 0, channel), bits("full.exr", 0, channel)) << channel;
  }
  for (const char* channel : {"R", "G", "B", "A"}) {
    EXPECT_EQ(bits("wet.exr", 0, channel), bits("bare.exr", 0, channel)) << channel;
  }
  EXPECT_EQ(file.text_attribute(0, "cryptomatte/f834d0a/manifest"), "{\"rock\":\"3f800000\"}");
  EXPECT_EQ(file.text_attribute(0, "shot/take"), "12b");
  // Another program finds the layers, too.
  EXPECT_THAT(iinfo("wet.exr"), HasSubstr("CryptoObject00.r"));
  EXPECT_EQ(oiiotool({"full.exr", "--ch", "IndexOB.X,Vector.X", "wet.exr", "--ch",
                      "IndexOB.X,Vector.X", "--diff"})
                .code,
            0);

  wetted({"full.exr"}, {"--pass-through", "Norm*", "-q"});
  const ExrFile one = ExrFile::open(folder_ / "wet.exr");
  EXPECT_THAT(channels(one.parts()[0]), ElementsAre("A", "B", "G", "Normal.X", "R"));
  EXPECT_FALSE(one.text_attribute(0, "cryptomatte/f834d0a/manifest"));
}

TEST_F(PassThroughTest, WithoutItOneIsToldWhatStays) {
  write("full.exr", {plate()});
  const Ran ran = wet({"full.exr"});
  EXPECT_THAT(ran.out,
              HasSubstr("\nnot passed through: CryptoObject00, IndexOB, Normal, Vector ("));
  EXPECT_THAT(wet({"full.exr"}, {"--pass-through", "depth"}).out, Not(HasSubstr("not passed")));
  EXPECT_THAT(wet({"plate.exr"}).out, Not(HasSubstr("not passed")));
}

TEST_F(PassThroughTest, WindowsFollowThePicture) {
  write("wide.exr", {plate({-6, -4, 70, 40})});
  const Words pass = {"--pass-through", "IndexOB,Normal", "-q"};
  for (const std::string overscan : {"0", "3"}) {
    Words more = pass;
    more.insert(more.end(), {"--overscan", overscan});
    wetted({"wide.exr"}, more);
    const int beyond = overscan == "0" ? 0 : 3;
    const Rect data{-beyond, -beyond, 64 + beyond, 36 + beyond};
    EXPECT_EQ(ExrFile::open(folder_ / "wet.exr").parts()[0].data, data);
    // The plate, cut to the same window.
    EXPECT_EQ(oiiotool({"wide.exr", "--ch", "IndexOB.X", "--crop",
                        std::to_string(data.width()) + "x" + std::to_string(data.height()) +
                            (beyond > 0 ? "-3-3" : "+0+0"),
                        "wet.exr", "--ch", "IndexOB.X", "--diff"})
                  .code,
              0);
  }
}

TEST_F(PassThroughTest, PartsStayPartsAndFilesBecomeSome) {
  WrittenPart rgba{"rgba", "", kPicture, {}};
  add(rgba, "plate.exr", {"R", "G", "B", "A"});
  WrittenPart depth{"depth", "", kPicture, {}};
  add(depth, "plate.exr", {"depth.Z"});
  WrittenPart ids = exr_test::part_of("ids", {5, 6, 40, 30}, {"Y"});
  ids.tile = 8;
  ids.texts = {{"renderer", "somebody's"}};
  write("parts.exr", {rgba, depth, ids});
  write("vectors.0007.exr", {exr_test::part_of("", kPicture, {"X", "Y"})});
  wetted({"parts.exr", "vectors.0007.exr"},
         {"--pass-through", "ids,vectors", "--aov", "path", "-q"});
  const ExrFile file = ExrFile::open(folder_ / "wet.exr");
  ASSERT_EQ(file.parts().size(), 3U);
  EXPECT_EQ(file.parts()[0].name, "rgba");
  EXPECT_THAT(channels(file.parts()[0]), ElementsAre("A", "B", "G", "R", "path.Z"));
  EXPECT_EQ(file.parts()[1].name, "ids");
  EXPECT_EQ(file.parts()[1].data, (Rect{5, 6, 40, 30}));
  EXPECT_EQ(file.text_attribute(1, "renderer"), "somebody's");
  EXPECT_EQ(bits("wet.exr", 1, "Y"), bits("parts.exr", 2, "Y"));
  EXPECT_EQ(file.parts()[2].name, "vectors");
  EXPECT_EQ(bits("wet.exr", 2, "X"), bits("vectors.0007.exr", 0, "X"));
  // The picture is still the first layer that a program finds, and the layer that limpid compares.
  EXPECT_EQ(limpid({"compare", "wet.exr", "wet.exr", "--channels", "R,vectors"}).code, 0);
  EXPECT_EQ(limpid({"compare", "wet.exr", "wet.exr", "--channels", "ids.Y"}).code, 0);
  EXPECT_THAT(iinfo("wet.exr"), HasSubstr("3 subimages"));
}

TEST_F(PassThroughTest, SequencesResumeByIt) {
  write("full.1.exr", {plate()});
  const auto resumed = [&](const std::string& pass) {
    const Ran ran =
        limpid({"composite", "full.%d.exr", "--scene", "scene.toml", "--look", "look.toml", "-o",
                "wet.%d.exr", "--frames", "1", "--resume", "--verify", "--pass-through", pass});
    EXPECT_EQ(ran.code, 0) << ran.err;
    return ran.err;
  };
  EXPECT_THAT(resumed("Normal"), HasSubstr("0 of 1 frame"));
  EXPECT_THAT(resumed("Normal"), HasSubstr("1 of 1 frame"));
  EXPECT_THAT(resumed("Normal,Vector"), HasSubstr("was made differently (options)"));
  EXPECT_THAT(resumed("Normal,Vector"), HasSubstr("1 of 1 frame"));
  // Layers of several parts are copied like layers of one part.
  WrittenPart main = plate();
  main.name = "main";
  write("full.1.exr", {main, exr_test::part_of("ids", kPicture, {"Y"})});
  EXPECT_THAT(resumed("ids"), HasSubstr("was made differently"));
  EXPECT_THAT(resumed("ids"), HasSubstr("1 of 1 frame"));
  std::fstream file(folder_ / "wet.1.exr", std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(-3, std::ios::end);
  file.put('\x55');
  file.close();
  EXPECT_THAT(resumed("ids"), HasSubstr("has changed since it was written"));
}

TEST_F(PassThroughTest, WhatCannotBeIsRefused) {
  WrittenPart clash = plate();
  clash.channels["normal.X"] = clash.channels["Vector.X"];
  write("full.exr", {clash});
  const auto refused = [&](const Words& more, const Words& parts, int code = 2) {
    Words words = {"full.exr", "--scene", "scene.toml"};
    words.insert(words.end(), more.begin(), more.end());
    expect_no_composite(words, parts, code);
  };
  refused({"--pass-through", "normal", "--aov", "normal"},
          {"full.exr: its channel 'normal.X'", "that of the AOV normal have the same name"});
  refused({"--pass-through", "R", "--layer", "color=R,G,B"},
          {"its channel 'R'", "that of the picture have the same name"});
  refused({"--pass-through", "Speed"}, {"no layer or channel 'Speed' to pass through"});
  refused({"--pass-through", "none,all"}, {"--pass-through none,all: expected none alone"});
  refused({"--pass-through", "all", "--compression", "dwaa"},
          {"compression 'dwaa': expected none, rle, zips, zip or piz"});
}

TEST_F(PassThroughTest, ManifestsInFilesAreWarnedOf) {
  WrittenPart part = plate();
  part.texts.erase("cryptomatte/f834d0a/manifest");
  part.texts["cryptomatte/f834d0a/manif_file"] = "crypto.json";
  write("full.exr", {part});
  EXPECT_EQ(wet({"full.exr"}, {"--pass-through", "CryptoObject"}).err, "");
  std::filesystem::create_directories(folder_ / "out");
  const Ran ran = limpid({"composite", "full.exr", "--scene", "scene.toml", "--look", "look.toml",
                          "-o", "out/wet.exr", "--pass-through", "CryptoObject"});
  EXPECT_EQ(ran.code, 0);
  EXPECT_THAT(ran.err, HasSubstr("the manifest crypto.json of a passed-through cryptomatte"));
}

}  // namespace
}  // namespace limpid::test
