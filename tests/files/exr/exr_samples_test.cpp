#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "files/exr/exr_files.h"
#include "paths.h"

/// Files of other programs; what each shows is in its name and in tests/data/README.md.
namespace limpid {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

std::string sample(const std::string& file) { return LIMPID_TEST_DATA "/exr/" + file; }

struct Pixel {
  std::string file;
  int part;
  std::string channel;
  int x, y;
  float value;
};

const Pixel kPixels[] = {
    {"blender_multilayer_half_zip.exr", 0, "ViewLayer.Depth.Z", 0, 0, 18.2763004f},
    {"blender_multilayer_half_zip.exr", 0, "ViewLayer.Shadow Catcher.R", 5, 5, 1},
    {"blender_multilayer_half_zip.exr", 0, "ViewLayer.CryptoObject00.r", 40, 30, 1.24762915e+34f},
    {"blender_multilayer_half_zip.exr", 0, "ViewLayer.CryptoObject00.r", 0, 0, 4.35840841e-34f},
    {"blender_multilayer_half_zip.exr", 0, "ViewLayer.Combined.G", 20, 20, 0.743164062f},
    {"blender_multilayer_half_zip.exr", 0, "ViewLayer.Position.Y", 20, 20, 5.08677578f},
    {"blender_multilayer_half_dwaa.exr", 0, "ViewLayer.Position.Y", 20, 20, 5.0859375f},
    {"blender_multilayer_half_dwaa.exr", 0, "ViewLayer.Depth.Z", 47, 31, 11.5462418f},
    {"blender_film_transparent.exr", 0, "ViewLayer.Combined.A", 0, 0, 0},
    {"blender_film_transparent.exr", 0, "ViewLayer.Depth.Z", 0, 0, 1e10f},
    {"blender_film_transparent.exr", 0, "ViewLayer.Depth.Z", 47, 31, 480.657288f},
    {"border_nocrop.exr", 0, "ViewLayer.Depth.Z", 0, 0, 1e11f},
    {"border_nocrop.exr", 0, "ViewLayer.Combined.A", 0, 0, 0},
    {"border_nocrop.exr", 0, "ViewLayer.Combined.A", 47, 31, 1},
    {"blender_float_zip_rgbaz.exr", 0, "Z", 0, 0, 18.2763004f},
    {"blender_float_zip_rgbaz.exr", 0, "B", 47, 31, 0.326047748f},
    {"synthetic_nan_inf_negative.exr", 0, "Z", 4, 4, kNan},
    {"synthetic_nan_inf_negative.exr", 0, "Z", 4, 14, kInf},
    {"synthetic_nan_inf_negative.exr", 0, "Z", 4, 24, -1},
    {"synthetic_nan_inf_negative.exr", 0, "Z", 4, 34, 0},
    {"synthetic_nan_inf_negative.exr", 0, "R", 4, 44, kNan},
    {"synthetic_nan_inf_negative.exr", 0, "R", 4, 54, -0.25f},
    {"synthetic_nan_inf_negative.exr", 0, "R", 4, 64, kInf},
    {"oiio_cropwindow_rgba.exr", 0, "R", 96, 108, 0.569335938f},
    {"oiio_cropwindow_rgba.exr", 0, "R", 335, 242, 0.674316406f},
    {"oiio_cropwindow_rgba.exr", 0, "R", 95, 108, -5},
    {"oiio_depth_halfoverflow_inf.exr", 0, "Y", 0, 0, kInf},
    {"oiio_depth_halfoverflow_inf.exr", 0, "Y", 200, 130, 5.91015625f},
    {"oiio_multipart.exr", 0, "G", 120, 100, 0.189331055f},
    {"oiio_multipart.exr", 1, "Z", 0, 0, 1e10f},
    {"oiio_multipart.exr", 1, "Z", 120, 100, 9.55047035f},
    {"oiio_multipart.exr", 2, "N.X", 120, 100, 0},
    {"oiio_tiled_rgbz_noalpha.exr", 0, "Z", 239, 135, 5.53883123f},
    {"oiio_tiled_rgbz_noalpha.exr", 0, "Z", 64, 64, 17.7850361f},
    {"oiio_tiled_rgbz_noalpha.exr", 0, "R", 63, 64, 0.123596191f},
    {"stripes.exr", 0, "R", 10, 10, 0.199951172f},
    {"t01.exr", 0, "G", 0, 0, 1},
    {"t08.exr", 0, "G", 30, 40, 1},
    {"t08.exr", 0, "G", 29, 40, -5},
    {"t09.exr", 0, "G", 200, 150, 0},
    {"MirrorPattern.exr", 0, "R", 0, 0, 0.657226562f},
    {"MirrorPattern.exr", 0, "R", 511, 511, 0},
    {"WideFloatRange.exr", 0, "G", 100, 100, -38448128.0f},
    {"WideFloatRange.exr", 0, "G", 499, 0, -8.42502088e+37f},
};

TEST(ExrSamples, HoldTheValuesThatOtherReadersFind) {
  for (const Pixel& pixel : kPixels) {
    float value = 0;
    const ExrRequest request{pixel.part,
                             pixel.channel,
                             {&value, 1, 1, {pixel.x, pixel.y, pixel.x + 1, pixel.y + 1}},
                             -5};
    ExrFile::open(sample(pixel.file)).read(std::array{request});
    const bool both_nan = std::isnan(value) && std::isnan(pixel.value);
    EXPECT_TRUE(both_nan || value == pixel.value)
        << pixel.file << " " << pixel.channel << " at " << pixel.x << ", " << pixel.y << " is "
        << value << ", expected " << pixel.value;
  }
}

TEST(ExrSamples, AreReadWhole) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(LIMPID_TEST_DATA "/exr")) {
    EXPECT_EQ(exr_test::failure_of(entry.path()), "");
    ++files;
  }
  EXPECT_EQ(files, 17);
}

TEST(ExrSamples, HaveTheWindowsAndPartsThatTheyShow) {
  const ExrPart crop = ExrFile::open(sample("oiio_cropwindow_rgba.exr")).parts()[0];
  EXPECT_EQ(crop.data, (Rect{96, 108, 336, 243}));
  EXPECT_EQ(crop.display, (Rect{0, 0, 480, 270}));
  const ExrPart elsewhere = ExrFile::open(sample("t09.exr")).parts()[0];
  EXPECT_TRUE(intersection(elsewhere.data, elsewhere.display).empty());
  const ExrFile multi = ExrFile::open(sample("oiio_multipart.exr"));
  ASSERT_EQ(multi.parts().size(), 3u);
  EXPECT_EQ(multi.parts()[1].name, "depth");
  EXPECT_EQ(multi.parts()[0].channels[0].type, SampleType::kHalf);
  EXPECT_EQ(multi.parts()[1].channels[0].type, SampleType::kFloat);
  EXPECT_EQ(ExrFile::open(sample("blender_multilayer_half_dwaa.exr")).parts()[0].compression,
            "dwaa");
  EXPECT_TRUE(ExrFile::open(sample("MirrorPattern.exr")).parts()[0].tiled);
}

/// The pixel (x, y) is the half number with the bits 256 y + x.
TEST(ExrSamples, EveryHalfNumberBecomesTheSameFloat) {
  const ExrFile file = ExrFile::open(sample("AllHalfValues.exr"));
  Plane plane(Rect{0, 0, 256, 256});
  file.read(std::array{ExrRequest{0, "R", plane.view()}});
  for (int bits = 0; bits < 65536; ++bits) {
    const int exponent = (bits >> 10) & 31, fraction = bits & 1023;
    const float value = plane.view().at(bits % 256, bits / 256);
    EXPECT_EQ(std::signbit(value), bits >= 32768);
    if (exponent == 31) {
      EXPECT_TRUE(fraction == 0 ? std::isinf(value) : std::isnan(value)) << bits;
    } else {
      const float magnitude = exponent == 0
                                  ? std::ldexp(static_cast<float>(fraction), -24)
                                  : std::ldexp(static_cast<float>(1024 + fraction), exponent - 25);
      EXPECT_EQ(std::abs(value), magnitude) << bits;
    }
  }
}

}  // namespace
}  // namespace limpid
