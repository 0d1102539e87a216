#include "plate/primaries.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <gmock/gmock.h>

#include "limpid/core/error.h"
#include "limpid/plate/plate.h"

#include "files/exr/written.h"

/// The working space that the headers of a plate declare.

namespace limpid {
namespace {

using ::testing::HasSubstr;

struct Told {
  const Imf::Chromaticities* numbers = nullptr;
  std::map<std::string, std::string> names = {};
};

Plate plate_that_tells(const Told& told) {
  const std::filesystem::path path = test::own_folder() / "plate.exr";
  Imf::Header header(2, 1);
  for (const char* name : {"R", "G", "B"}) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
  if (told.numbers != nullptr) Imf::addChromaticities(header, *told.numbers);
  for (const auto& [name, text] : told.names) header.insert(name, Imf::StringAttribute(text));
  {
    Imf::OutputFile file(path.c_str(), header);
    std::vector<float> values(2, 1.0f);
    Imf::FrameBuffer frame;
    for (const char* name : {"R", "G", "B"}) {
      frame.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), 4, 8));
    }
    file.setFrameBuffer(frame);
    file.writePixels(1);
  }
  PlateRequest request;
  request.files = {path};
  return Plate::open(request);
}

const Imf::Chromaticities kAp1({.713f, .293f}, {.165f, .830f}, {.128f, .044f}, {.32168f, .33767f});
const Imf::Chromaticities kOwn({.6f, .3f}, {.2f, .7f}, {.15f, .06f}, {.3127f, .329f});

TEST(PlatePrimaries, ByChromaticities) {
  EXPECT_EQ(plate_that_tells({}).primaries(), std::nullopt);
  const Imf::Chromaticities rec709;
  EXPECT_EQ(plate_that_tells({&rec709}).primaries(), kRec709) << "to the bit, not as it is stored";
  EXPECT_EQ(plate_that_tells({&kAp1}).primaries(), find_color_space("ACEScg"));
  const auto own = plate_that_tells({&kOwn}).primaries();
  ASSERT_TRUE(own);
  EXPECT_NEAR(own->green.y, .7, 1e-7);
  EXPECT_THAT(to_string(*own), HasSubstr("0.6000000238418579 0.3"));
}

TEST(PlatePrimaries, ByNameWhereThereAreNoNumbers) {
  EXPECT_EQ(plate_that_tells({nullptr, {{"oiio:ColorSpace", "ACES - ACEScg"}}}).primaries(),
            find_color_space("ACEScg"));
  EXPECT_EQ(
      plate_that_tells(
          {nullptr, {{"oiio:ColorSpace", "lin_rec709"}, {"colorInteropID", "lin_rec2020_scene"}}})
          .primaries(),
      find_color_space("Rec.2020"));
  EXPECT_EQ(plate_that_tells({nullptr, {{"oiio:ColorSpace", "sRGB"}}}).primaries(), std::nullopt);
  EXPECT_EQ(plate_that_tells({&kAp1, {{"oiio:ColorSpace", "lin_rec709"}}}).primaries(),
            find_color_space("ACEScg"));
}

TEST(PlatePrimaries, RefusesNone) {
  const Imf::Chromaticities none({0, 0}, {0, 0}, {0, 0}, {0, 0});
  const Plate plate = plate_that_tells({&none});
  try {
    plate.primaries();
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("chromaticities 0.0 0.0 0.0 0.0 0.0 0.0 0.0 0.0: expected"));
  }
}

TEST(PlatePrimaries, ToldOfAPicture) {
  const Primaries acescg = find_color_space("ACEScg").value();
  Attributes plate = plate_that_tells({&kAp1}).attributes();
  const Attributes same = plate;
  tell_primaries(plate, acescg);
  EXPECT_EQ(plate.at("chromaticities").bytes, same.at("chromaticities").bytes);
  Attributes silent;
  tell_primaries(silent, kRec709);
  EXPECT_TRUE(silent.empty()) << "a plate that says nothing is of Rec.709, and so is its picture";
  tell_primaries(silent, acescg);
  EXPECT_EQ(silent.at("chromaticities").bytes, same.at("chromaticities").bytes);
  Attributes wrong = plate_that_tells({&kAp1, {{"oiio:ColorSpace", "ACEScg"}}}).attributes();
  tell_primaries(wrong, kRec709);
  EXPECT_EQ(told_primaries(wrong), kRec709);
  EXPECT_FALSE(wrong.contains("oiio:ColorSpace"));
}

TEST(PlatePrimaries, AreInspected) {
  const auto inspected = [] {
    PlateRequest request;
    request.files = {test::own_folder() / "plate.exr"};
    return Plate::inspect(request);
  };
  plate_that_tells({&kAp1});
  EXPECT_THAT(inspected(), HasSubstr("plate.exr: ACEScg\n  part 0"));
  plate_that_tells({});
  EXPECT_THAT(inspected(), HasSubstr("plate.exr\n  part 0"));
}

}  // namespace
}  // namespace limpid
