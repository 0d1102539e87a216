#include "limpid/files/exr/deep.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "files/exr/deep_files.h"

namespace limpid {
namespace {

using exr_test::DeepPicture;
using exr_test::DeepValues;
using exr_test::error_of;
using exr_test::point;
using exr_test::rgbaz;
using exr_test::temporary;
using exr_test::volume;
using exr_test::write_deep_picture;
using ::testing::HasSubstr;

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// What one pixel comes to.
struct Pixel {
  float r, g, b, a, depth, below_r, below_g, below_b, below_depth;
};

Pixel pixel_of(const DeepLayers& layers, int x, int y) {
  const auto at = [&](const Plane& plane) { return plane.view().at(x, y); };
  return {at(layers.color[0]),       at(layers.color[1]),       at(layers.color[2]),
          at(layers.color[3]),       at(layers.depth),          at(layers.below_color[0]),
          at(layers.below_color[1]), at(layers.below_color[2]), at(layers.below_depth)};
}

/// Writes these samples as the one pixel of a picture and reads them below a surface at `surface`.
DeepLayers one_pixel(std::vector<DeepValues> samples, float surface,
                     std::vector<std::string> more = {}) {
  DeepPicture picture = rgbaz();
  picture.data = {0, 0, 1, 1};
  for (const std::string& name : more) picture.channels[name] = Imf::FLOAT;
  picture.samples[{0, 0}] = std::move(samples);
  const std::string path = temporary("pixel.exr");
  write_deep_picture(path, picture);
  return read_deep_layers(ExrFile::open(path), 0, {&surface, 1, 1, {0, 0, 1, 1}});
}

Pixel flattened(std::vector<DeepValues> samples, float surface = kInf,
                std::vector<std::string> more = {"ZBack"}) {
  return pixel_of(one_pixel(std::move(samples), surface, std::move(more)), 0, 0);
}

TEST(Deep, FindsTheBottomThatTheForegroundHides) {
  // An opaque post at 2 in front of water at 5, the bottom at 8 behind it; not sorted.
  const Pixel p = flattened({point(8, 0.25f, 1), point(2, 0.5f, 1)}, 5);
  EXPECT_EQ(p.r, 0.5f);
  EXPECT_EQ(p.b, 1.5f);
  EXPECT_EQ(p.a, 1);
  EXPECT_EQ(p.depth, 2);
  EXPECT_EQ(p.below_r, 0.25f);
  EXPECT_EQ(p.below_g, 0.5f);
  EXPECT_EQ(p.below_b, 0.75f);
  EXPECT_EQ(p.below_depth, 8);
}

TEST(Deep, PointsAreCompositedFrontToBack) {
  const Pixel p =
      flattened({point(8, 0.5f, 1), point(6, 0.25f, 0.5f), point(2, 0.125f, 0.25f)}, 5, {});
  EXPECT_FLOAT_EQ(p.r, 0.125f + 0.75f * (0.25f + 0.5f * 0.5f));
  EXPECT_FLOAT_EQ(p.a, 1);
  EXPECT_EQ(p.depth, 2);
  EXPECT_FLOAT_EQ(p.below_r, 0.25f + 0.5f * 0.5f);
  EXPECT_EQ(p.below_depth, 6);
}

std::array<float, 4> foreground(std::vector<DeepValues> samples, float surface) {
  const DeepLayers layers = one_pixel(std::move(samples), surface, {"ZBack"});
  std::array<float, 4> rgba;
  for (std::size_t c = 0; c < 4; ++c) rgba[c] = layers.foreground[c].view().at(0, 0);
  return rgba;
}

// Two panes over each other before water at 5: .125 + .75 .25, and 1 - .75 .5 of the pixel.
TEST(Deep, WhatStandsBeforeTheWaterIsALayer) {
  const auto rgba =
      foreground({point(8, 0.5f, 1), point(3, 0.25f, 0.5f), point(2, 0.125f, 0.25f)}, 5);
  EXPECT_FLOAT_EQ(rgba[0], 0.125f + 0.75f * 0.25f);
  EXPECT_FLOAT_EQ(rgba[1], 2 * rgba[0]);
  EXPECT_FLOAT_EQ(rgba[3], 1 - 0.75f * 0.5f);
  // A point on the surface is before it, one behind it is not.
  EXPECT_FLOAT_EQ(foreground({point(5, 0.25f, 0.5f)}, 5)[3], 0.5f);
  EXPECT_EQ(foreground({point(5.01f, 0.25f, 0.5f)}, 5)[3], 0);
  EXPECT_EQ(foreground({point(2, 0.25f, 0.5f)}, kInf)[3], 0);  // no water
}

// Of a volume from 3 to 7 that lets a quarter through, the half before the water at 5 lets through
// a half; before and behind, over each other, are the whole.
TEST(Deep, TheSurfaceSplitsAVolume) {
  const auto rgba = foreground({volume(3, 7, 0.75f, 0.75f)}, 5);
  EXPECT_FLOAT_EQ(rgba[3], 0.5f);
  const Pixel p = flattened({volume(3, 7, 0.75f, 0.75f)}, 5);
  EXPECT_FLOAT_EQ(rgba[0] + (1 - rgba[3]) * p.below_r, p.r);
  EXPECT_FLOAT_EQ(foreground({volume(3, 7, 0.75f, 1)}, 5)[3], 1);
}

/// The share of transparent pixels of 4 x 3, of which these hold a pane under water at 5.
double transparent(const Rect& panes, float alpha) {
  DeepPicture picture = rgbaz();
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 4; ++x) {
      auto& samples = picture.samples[{x, y}] = {point(8, 0.5f, 1)};
      if (panes.contains({x, y, x + 1, y + 1})) samples.push_back(point(6, 0.1f, alpha));
    }
  }
  const std::string path = temporary("panes.exr");
  write_deep_picture(path, picture);
  const std::vector<float> surface(12, 5.0f);
  return read_deep_layers(ExrFile::open(path), 0, {surface.data(), 1, 4, {0, 0, 4, 3}}).transparent;
}

TEST(Deep, PanesUnderTheWaterAreCounted) {
  EXPECT_DOUBLE_EQ(transparent({0, 0, 4, 3}, 0.5f), 2.0 / 12);  // with such all around them
  EXPECT_DOUBLE_EQ(transparent({0, 0, 3, 3}, 0.5f), 1.0 / 12);
  EXPECT_EQ(transparent({0, 0, 2, 3}, 0.5f), 0);  // as narrow as an edge
  EXPECT_EQ(transparent({0, 0, 4, 3}, 1), 0);
}

TEST(Deep, WithoutWaterNothingIsBelow) {
  for (float surface : {kInf, kNan}) {
    const Pixel p = flattened({point(8, 0.5f, 1)}, surface);
    EXPECT_EQ(p.r, 0.5f);
    EXPECT_EQ(p.below_r, 0);
    EXPECT_EQ(p.below_depth, kInf);
  }
}

TEST(Deep, AnEmptyPixelIsTransparentAndInfinitelyFar) {
  const Pixel p = flattened({}, 5);
  EXPECT_EQ(p.r, 0);
  EXPECT_EQ(p.a, 0);
  EXPECT_EQ(p.depth, kInf);
  EXPECT_EQ(p.below_depth, kInf);
}

TEST(Deep, APointOnTheSurfaceIsNotBehindIt) {
  EXPECT_EQ(flattened({point(5, 0.5f, 1)}, 5).below_depth, kInf);
  EXPECT_EQ(flattened({point(std::nextafter(5.0f, 6.0f), 0.5f, 1)}, 5).below_r, 0.5f);
}

TEST(Deep, SamplesWithoutAlphaGlowButHaveNoDepth) {
  const Pixel p = flattened({point(2, 0.5f, 0), point(8, 0.25f, 1)}, 1);
  EXPECT_EQ(p.r, 0.75f);
  EXPECT_EQ(p.depth, 8);
  EXPECT_EQ(p.below_depth, 8);
}

TEST(Deep, AVolumeThatSpansTheSurfaceIsSplitThere) {
  // Three quarters of it lie below: T = 0.4^0.75.
  const Pixel p = flattened({volume(4, 8, 0.5f, 0.6f)}, 5);
  EXPECT_FLOAT_EQ(p.r, 0.5f);
  EXPECT_FLOAT_EQ(p.a, 0.6f);
  EXPECT_EQ(p.depth, 4);
  const double alpha = 1 - std::pow(0.4, 0.75);
  EXPECT_FLOAT_EQ(p.below_r, static_cast<float>(0.5 * alpha / 0.6));
  EXPECT_EQ(p.below_depth, 5);
  // One that only glows is shared out by length.
  EXPECT_FLOAT_EQ(flattened({volume(4, 8, 0.5f, 0)}, 5).below_r, 0.375f);
  // One that ends at the surface is in front, one that begins there is behind.
  EXPECT_EQ(flattened({volume(4, 5, 0.5f, 0.6f)}, 5).below_r, 0);
  EXPECT_FLOAT_EQ(flattened({volume(5, 6, 0.5f, 0.6f)}, 5).below_r, 0.5f);
}

TEST(Deep, APointInsideAVolumeSplitsIt) {
  // Half of a fog in front of a half transparent point, half behind.
  const Pixel p = flattened({volume(4, 8, 0.64f, 0.64f), point(6, 0.1f, 0.5f)});
  const double half_alpha = 1 - std::sqrt(0.36), through = 0.6;
  EXPECT_FLOAT_EQ(p.r, static_cast<float>(half_alpha + through * (0.1 + 0.5 * half_alpha)));
  EXPECT_FLOAT_EQ(p.a, static_cast<float>(1 - 0.36 * 0.5));
  // At the front of the volume it comes before it, at its back behind it.
  EXPECT_FLOAT_EQ(flattened({volume(4, 8, 0.64f, 0.64f), point(4, 0.1f, 0.5f)}).r,
                  0.1f + 0.5f * 0.64f);
  EXPECT_FLOAT_EQ(flattened({volume(4, 8, 0.64f, 0.64f), point(8, 0.1f, 0.5f)}).r,
                  0.64f + 0.36f * 0.1f);
}

TEST(Deep, CoincidentVolumesMergeByTheSpecification) {
  const double a1 = 0.5, a2 = 0.75, c1 = 0.2, c2 = 0.6;
  const double u1 = -std::log1p(-a1), u2 = -std::log1p(-a2);
  const double a = 1 - (1 - a1) * (1 - a2);
  const double merged = (c1 * u1 / a1 + c2 * u2 / a2) * a / (u1 + u2);
  for (bool volumes : {true, false}) {
    const float back = volumes ? 7 : 4;
    const Pixel p = flattened({volume(4, back, 0.2f, 0.5f), volume(4, back, 0.6f, 0.75f)});
    EXPECT_FLOAT_EQ(p.r, static_cast<float>(merged));
    EXPECT_FLOAT_EQ(p.a, static_cast<float>(a));
  }
}

TEST(Deep, OverlappingVolumesAreWhatThinSlicesOfThemAre) {
  const std::vector<DeepValues> fogs = {volume(1, 5, 0.3f, 0.7f), volume(2, 8, 0.8f, 0.9f),
                                        volume(4, 4.5f, 0.1f, 0), volume(3, 6, 0.05f, 0.2f)};
  const Pixel p = flattened(fogs, 3.5f);
  double color = 0, through = 1, below = 0, below_through = 1;
  const double step = 1e-3;
  for (double z = 1 + step / 2; z < 8; z += step) {
    for (const DeepValues& fog : fogs) {
      const double front = fog.at("Z"), back = fog.at("ZBack"), whole = fog.at("A");
      if (z < front || z > back) continue;
      const double share = step / (back - front);
      const double alpha = 1 - std::pow(1 - whole, share);
      const double light = fog.at("R") * (whole > 0 ? alpha / whole : share);
      color += through * light;
      through *= 1 - alpha;
      if (z < 3.5) continue;
      below += below_through * light;
      below_through *= 1 - alpha;
    }
  }
  EXPECT_NEAR(p.r, color, 1e-3);
  EXPECT_NEAR(p.a, 1 - 0.3 * 0.1 * 0.8, 1e-6);
  EXPECT_NEAR(p.below_r, below, 1e-3);
  EXPECT_EQ(p.below_depth, 3.5f);
}

TEST(Deep, AnOpaqueVolumeIsAWallAtItsFront) {
  const Pixel p = flattened({volume(4, 8, 0.5f, 1), point(6, 9, 1), volume(2, 6, 0.64f, 0.64f)});
  EXPECT_FLOAT_EQ(p.r, 0.4f + 0.6f * 0.5f);
  EXPECT_EQ(p.a, 1);
  // Split at the surface, its back is as opaque.
  EXPECT_EQ(flattened({volume(4, 8, 0.5f, 1)}, 5).below_r, 0.5f);
  // Walls at one depth share it.
  EXPECT_EQ(flattened({volume(4, 8, 0.5f, 1), volume(4, 9, 0.25f, 1)}).r, 0.375f);
  EXPECT_EQ(flattened({point(4, 0.5f, 1), point(4, 0.25f, 1), point(4, 7, 0.5f)}).r, 0.375f);
}

TEST(Deep, EachColorHasItsOwnAlphaWhereThereIsOne) {
  DeepValues glass = point(2, 0.125f, 0.5f), fog = volume(3, 7, 0.5f, 0.5f), wall = point(8, 1, 1);
  for (DeepValues* sample : {&glass, &fog, &wall}) (*sample)["AR"] = sample->at("A");
  glass["AR"] = 1;
  fog["AR"] = 0;
  const Pixel p = flattened({glass, fog, wall}, 5, {"ZBack", "AR"});
  EXPECT_EQ(p.r, 0.125f);
  EXPECT_FLOAT_EQ(p.g, 0.25f + 0.5f * (1 + 0.5f * 2));
  EXPECT_FLOAT_EQ(p.a, 1);
  EXPECT_FLOAT_EQ(p.below_r, 0.25f + 1);
  EXPECT_FLOAT_EQ(p.below_g, static_cast<float>((1 - std::sqrt(0.5)) / 0.5 + std::sqrt(0.5) * 2));
}

TEST(Deep, AVolumeWithoutAFiniteBackAboveItsFrontIsAPoint) {
  for (float back : {3.0f, -1.0f, kInf, 1e9f, kNan, -kInf}) {
    const Pixel p = flattened({volume(4, back, 0.5f, 0.5f), point(8, 1, 1)}, 4.5f);
    EXPECT_FLOAT_EQ(p.r, 1) << back;
    EXPECT_EQ(p.below_r, 1) << back;
  }
}

TEST(Deep, ASkyIsBehindEverything) {
  const Pixel p = flattened({point(1e10f, 0.5f, 1), point(1e8f, 0.25f, 0.5f)}, 5, {});
  EXPECT_FLOAT_EQ(p.r, 0.5f);
  EXPECT_EQ(p.below_depth, 1e8f);
  const Pixel sky = flattened({point(kInf, 0.5f, 1)}, 5, {});
  EXPECT_EQ(sky.r, 0.5f);
  EXPECT_EQ(sky.depth, kInf);
  EXPECT_EQ(sky.below_r, 0.5f);

  DeepPicture half = rgbaz();
  half.channels["Z"] = Imf::HALF;
  half.samples[{1, 1}] = {point(65504, 0.5f, 1)};
  write_deep_picture(temporary("half.exr"), half);
  const float none[12] = {};
  const DeepLayers layers =
      read_deep_layers(ExrFile::open(temporary("half.exr")), 0, {none, 1, 4, {0, 0, 4, 3}});
  EXPECT_EQ(pixel_of(layers, 1, 1).depth, kInf);
  EXPECT_EQ(pixel_of(layers, 1, 1).a, 1);
}

TEST(Deep, ValuesThatMeanNothingAreReplacedAndCounted) {
  DeepValues broken = point(3, kNan, 0.5f);
  broken["G"] = kInf;
  const DeepLayers layers =
      one_pixel({broken, point(kNan, 5, 1), point(-kInf, 5, 1), point(4, 0.5f, kInf),
                 volume(6, kNan, 0, 7), point(7, 9, -1)},
                1, {"ZBack"});
  EXPECT_EQ(layers.replaced.of(PlaneId::kDepth).total(), 3);
  EXPECT_EQ(layers.replaced.of(PlaneId::kColorR), (Replaced{2, 2}));
  const Pixel p = pixel_of(layers, 0, 0);
  EXPECT_FLOAT_EQ(p.r, 0.5f * 0.5f);
  EXPECT_FLOAT_EQ(p.g, kLargestColor + 0.5f * 1);
  EXPECT_FLOAT_EQ(p.b, 0.5f * 1.5f);
  EXPECT_EQ(p.a, 1);  // 7 counts as 1
  EXPECT_EQ(p.depth, 3);
}

TEST(Deep, ManySamplesInOnePixelTakeNoLongTime) {
  std::vector<DeepValues> fogs;
  for (int i = 0; i < 20000; ++i) {
    fogs.push_back(volume(2 + static_cast<float>(i) * 1e-5f, 9, 1e-5f, 1e-5f));
  }
  const Pixel p = flattened(fogs, 5);
  EXPECT_NEAR(p.a, 1 - std::pow(1 - 1e-5, 20000), 1e-5);
  EXPECT_EQ(p.below_depth, 5);
}

/// How a file keeps its samples.
struct Storage {
  std::string name;
  Imf::Compression compression = Imf::ZIPS_COMPRESSION;
  int tile_width = 0, tile_height = 0;
  bool mip = false, second_part = false;
};

std::vector<Storage> storages() {
  return {{"zips"},
          {"none", Imf::NO_COMPRESSION},
          {"rle", Imf::RLE_COMPRESSION},
          {"second_part", Imf::ZIPS_COMPRESSION, 0, 0, false, true},
          {"tiles", Imf::ZIPS_COMPRESSION, 16, 8},
          {"mip_tiles", Imf::RLE_COMPRESSION, 16, 16, true},
          {"second_part_tiles", Imf::NO_COMPRESSION, 64, 64, false, true}};
}

/// (x + 2y) % 4 samples a pixel, one behind the other; Z in half.
DeepPicture slope(const Storage& storage) {
  DeepPicture picture = rgbaz();
  picture.channels["Z"] = Imf::HALF;
  picture.channels["id"] = Imf::UINT;
  picture.data = {-3, 5, 37, 86};
  for (int y = picture.data.y0; y < picture.data.y1; ++y) {
    for (int x = picture.data.x0; x < picture.data.x1; ++x) {
      auto& samples = picture.samples[{x, y}];
      for (int s = (x + 2 * y + 4) % 4; s > 0; --s) {
        samples.push_back(point(static_cast<float>(4 * s), static_cast<float>(x + y * s) / 16, 1));
        samples.back()["id"] = 0;
      }
    }
  }
  picture.compression = storage.compression;
  picture.tile_width = storage.tile_width;
  picture.tile_height = storage.tile_height;
  picture.mip = storage.mip;
  picture.second_part = storage.second_part;
  return picture;
}

TEST(Deep, EveryStorageReadsAlikeWithAnyNumberOfThreads) {
  const std::string path = temporary("slope.exr");
  const Rect window{-10, 0, 30, 50};  // reaches out of the picture, and the picture out of it
  Plane surface(window);
  for (int y = window.y0; y < window.y1; ++y) {
    std::fill_n(surface.view().row(y), window.width(), 6.0f);
  }
  for (const Storage& storage : storages()) {
    write_deep_picture(path, slope(storage));
    for (int threads : {0, 3}) {
      set_file_threads(threads);
      const DeepLayers layers = read_deep_layers(ExrFile::open(path), storage.second_part ? 1 : 0,
                                                 std::as_const(surface).view());
      EXPECT_EQ(layers.replaced.total(), 0);
      for (int y = window.y0; y < window.y1; ++y) {
        for (int x = window.x0; x < window.x1; ++x) {
          const int samples = x >= -3 && y >= 5 ? (x + 2 * y + 4) % 4 : 0;
          const Pixel p = pixel_of(layers, x, y);
          ASSERT_EQ(p.r, samples > 0 ? static_cast<float>(x + y) / 16 : 0) << storage.name;
          ASSERT_EQ(p.depth, samples > 0 ? 4 : kInf) << storage.name;
          ASSERT_EQ(p.below_r, samples > 1 ? static_cast<float>(x + 2 * y) / 16 : 0)
              << storage.name;
          ASSERT_EQ(p.below_depth, samples > 1 ? 8 : kInf) << storage.name;
        }
      }
    }
  }
  set_file_threads(0);
}

TEST(Deep, BlocksHoldEveryPixelOnceAndNotTheWholePicture) {
  const std::string path = temporary("slope.exr");
  for (const Storage& storage : storages()) {
    const DeepPicture picture = slope(storage);
    write_deep_picture(path, picture);
    std::int64_t pixels = 0;
    std::size_t samples = 0;
    int blocks = 0;
    const std::string channels[] = {"Z", "R"};
    const ExrFile file = ExrFile::open(path);
    file.read_deep(storage.second_part ? 1 : 0, channels, [&](const DeepBlock& block) {
      ++blocks;
      pixels += block.window.area();
      ASSERT_EQ(block.first.size(), static_cast<std::size_t>(block.window.area()) + 1);
      ASSERT_EQ(block.values.size(), 2u);
      ASSERT_EQ(block.values[1].size(), block.first.back());
      samples += block.first.back();
    });
    std::size_t expected = 0;
    for (const auto& [pixel, all] : picture.samples) expected += all.size();
    EXPECT_EQ(pixels, picture.data.area());
    EXPECT_EQ(samples, expected);
    EXPECT_GE(blocks, 2) << storage.name;
  }
}

TEST(Deep, AMissingChannelIsNamed) {
  const std::string path = temporary("a.exr");
  for (const char* missing : {"R", "G", "B", "A", "Z"}) {
    DeepPicture picture = rgbaz();
    picture.channels.erase(missing);
    write_deep_picture(path, picture);
    const ExrFile file = ExrFile::open(path);
    const float surface = 1;
    EXPECT_THAT(error_of([&] {
                  read_deep_layers(file, 0, {&surface, 1, 1, {0, 0, 1, 1}});
                }),
                HasSubstr(path + ": no channel '" + missing + "' in part 0, which has "));
  }
}

TEST(Deep, FlatAndDeepPartsAreNotTakenForOneAnother) {
  const std::string path = temporary("a.exr");
  DeepPicture picture = rgbaz();
  picture.second_part = true;
  write_deep_picture(path, picture);
  const ExrFile file = ExrFile::open(path);
  const std::string channels[] = {"Z"}, unknown[] = {"Y"};
  const auto sink = [](const DeepBlock&) {};
  EXPECT_EQ(error_of([&] { file.read_deep(0, channels, sink); }),
            path + ": part 0 ('flat') holds flat pixels: expected deep samples");
  EXPECT_EQ(error_of([&] { file.read_deep(2, channels, sink); }),
            path + ": part 2: expected 0 ... 1");
  EXPECT_THAT(error_of([&] { file.read_deep(1, unknown, sink); }),
              HasSubstr("no channel 'Y' in part 1 ('deep'): expected one of A, B, G, R, Z"));
  const View<const float> nowhere{nullptr, 1, 0, {0, 0, 2, 2}};
  EXPECT_THAT(error_of([&] { read_deep_layers(file, 0, nowhere); }), HasSubstr("no channel 'R'"));
  EXPECT_THAT(error_of([&] { read_deep_layers(file, 7, nowhere); }), HasSubstr("part 7"));
  EXPECT_EQ(pixel_of(read_deep_layers(file, 1, nowhere), 1, 1).depth, kInf);
}

}  // namespace
}  // namespace limpid
