#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <gmock/gmock.h>

#include "limpid/plate/plate.h"

#include "files/exr/written.h"

/// Plates in other primaries than the water's.

namespace limpid {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::filesystem::path written(const Imf::Chromaticities* primaries) {
  const std::filesystem::path path = test::own_folder() / "plate.exr";
  Imf::Header header(2, 1);
  for (const char* name : {"R", "G", "B"}) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
  if (primaries != nullptr) Imf::addChromaticities(header, *primaries);
  Imf::OutputFile file(path.c_str(), header);
  std::vector<float> values(2, 1.0f);
  Imf::FrameBuffer frame;
  for (const char* name : {"R", "G", "B"}) {
    frame.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), 4, 8));
  }
  file.setFrameBuffer(frame);
  file.writePixels(1);
  return path;
}

std::vector<std::string> warnings_of(const Imf::Chromaticities* primaries) {
  PlateRequest request;
  request.files = {written(primaries)};
  return Plate::open(request).warnings();
}

TEST(Primaries, NothingIsSaidOfRec709) {
  EXPECT_THAT(warnings_of(nullptr), IsEmpty());
  const Imf::Chromaticities rec709;
  EXPECT_THAT(warnings_of(&rec709), IsEmpty());
}

TEST(Primaries, OthersAreNamed) {
  const Imf::Chromaticities ap1({.713f, .293f}, {.165f, .830f}, {.128f, .044f}, {.32168f, .33767f});
  EXPECT_THAT(warnings_of(&ap1),
              ElementsAre("the plate's chromaticities are those of ACEScg (AP1), not of Rec.709: "
                          "coefficients and colors of the water are for Rec.709 and are not "
                          "converted"));
  const Imf::Chromaticities p3({.68f, .32f}, {.265f, .69f}, {.15f, .06f}, {.3127f, .329f});
  EXPECT_THAT(warnings_of(&p3), ElementsAre(HasSubstr("those of P3-D65, not")));
}

TEST(Primaries, ThoseOfNoKnownSpaceAreToldAsNumbers) {
  const Imf::Chromaticities own({.6f, .3f}, {.2f, .7f}, {.15f, .06f}, {.3127f, .329f});
  EXPECT_THAT(warnings_of(&own),
              ElementsAre(HasSubstr("those of red (0.6, 0.3), green (0.2, 0.7), blue (0.15, 0.06), "
                                    "white (0.3127, 0.329), not")));
}

}  // namespace
}  // namespace limpid
