#include "limpid/core/texture_levels.h"

#include <limits>

#include <gtest/gtest.h>

#include "support.h"

namespace limpid {
namespace {

Rgb<double> color_of(std::uint32_t texel) {
  return {(texel & 2047) / 2047.0, (texel >> 11 & 2047) / 2047.0, (texel >> 22) / 511.0};
}

double mean_of(const Texture& map, int channel) {
  const View<const float>& view = map.channels[channel];
  double sum = 0;
  for (int y = 0; y < view.window.height(); ++y) {
    for (int x = 0; x < view.window.width(); ++x) sum += view.at(x, y);
  }
  return sum / static_cast<double>(view.window.area());
}

TEST(LevelSizes, HalveDownToOneTexel) {
  const LevelSizes sizes = levels_from({7, 3});
  ASSERT_EQ(sizes.count, 3);
  EXPECT_EQ(sizes.size(0), (Size{7, 3}));
  EXPECT_EQ(sizes.size(1), (Size{3, 1}));
  EXPECT_EQ(sizes.size(2), (Size{1, 1}));
  // A column and a row more of each.
  EXPECT_EQ(sizes.first[1], 8 * 4);
  EXPECT_EQ(sizes.first[2], 8 * 4 + 4 * 2);
  EXPECT_EQ(sizes.texels, 8 * 4 + 4 * 2 + 2 * 2);
  EXPECT_EQ(levels_from({1, 1}).count, 1);
}

TEST(TextureLevels, ATexelIsTheMeanOfThoseUnderIt) {
  const test::NoiseMap map(8, 4);
  LevelMaker maker;
  maker.make(map.texture);
  const TextureLevels& levels = maker.levels();
  ASSERT_EQ(levels.sizes.size(0), (Size{4, 2}));
  for (int c = 0; c < 2; ++c) {
    const auto at = [&](int x, int y) -> double { return map.texture.channels[c].at(x, y); };
    const Rgb<double> got = color_of(levels.texels[levels.sizes.place(0, 3, 1)]);
    EXPECT_NEAR(c == 0 ? got.r : got.g, (at(6, 2) + at(7, 2) + at(6, 3) + at(7, 3)) / 4, 1 / 2047.);
  }
}

/// Where sizes are odd, too: the last level is the mean of the map, not of a part.
TEST(TextureLevels, TheLastIsTheMeanOfTheMap) {
  for (const Size size : {Size{1, 1}, Size{1, 5}, Size{7, 3}, Size{13, 11}, Size{64, 32}}) {
    const test::NoiseMap map(size.width, size.height);
    LevelMaker maker;
    maker.make(map.texture);
    const LevelSizes& sizes = maker.levels().sizes;
    const int last = sizes.count - 1;
    const Rgb<double> got = color_of(maker.levels().texels[sizes.place(last, 0, 0)]);
    EXPECT_NEAR(got.r, mean_of(map.texture, 0), 1e-3) << size.width << "x" << size.height;
    EXPECT_NEAR(got.g, mean_of(map.texture, 1), 1e-3) << size.width << "x" << size.height;
    EXPECT_NEAR(got.b, mean_of(map.texture, 2), 2e-3) << size.width << "x" << size.height;
  }
}

TEST(TextureLevels, BeginAgainAtTheEnd) {
  const test::NoiseMap map(7, 6);
  LevelMaker maker;
  maker.make(map.texture);
  const LevelSizes& sizes = maker.levels().sizes;
  const auto texel = [&](int x, int y) { return maker.levels().texels[sizes.place(0, x, y)]; };
  for (int y = 0; y < 3; ++y) EXPECT_EQ(texel(3, y), texel(0, y));
  for (int x = 0; x < 3; ++x) EXPECT_EQ(texel(x, 3), texel(x, 0));
  EXPECT_EQ(texel(3, 3), texel(0, 0));
}

/// A map of 1040 x 2 texels: slopes 1 and 3 along x by turns, all of which are in each texel of the
/// base.
TEST(TextureLevels, LargeMapsKeepTheMomentsOfTheirSlopes) {
  const Size size{1040, 2};
  std::array<Plane, 3> planes;
  Texture map;
  for (std::size_t c = 0; c < 3; ++c) {
    planes[c] = Plane(rect_of(size));
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        const float value[] = {x % 2 == 0 ? 0.6f : 0.8f, 0.5f, 0.6f};
        planes[c].view().at(x, y) = value[c];
      }
    }
    map.channels[c] = planes[c].view();
  }
  LevelMaker maker;
  maker.make(map);
  const TextureLevels& levels = maker.levels();
  ASSERT_EQ(levels.base, (Size{260, 1}));
  EXPECT_EQ(levels.halvings, 2);
  const float* moments = levels.moments + 77;
  EXPECT_NEAR(moments[0], 2, 1e-5);        // mean along x
  EXPECT_NEAR(moments[260], 0, 1e-6);      // along y
  EXPECT_NEAR(moments[2 * 260], 5, 1e-5);  // (1 + 9) / 2
  EXPECT_NEAR(moments[4 * 260], 0, 1e-6);
}

TEST(TextureLevels, WhatIsNoColorCountsAsOne) {
  const float values[] = {std::numeric_limits<float>::quiet_NaN(), -3, 7};
  std::array<Plane, 3> planes;
  Texture map;
  for (std::size_t c = 0; c < 3; ++c) {
    planes[c] = Plane(Rect{0, 0, 1, 1});
    planes[c].view().at(0, 0) = values[c];
    map.channels[c] = planes[c].view();
  }
  LevelMaker maker;
  maker.make(map);
  EXPECT_EQ(color_of(maker.levels().texels[0]), (Rgb<double>{0, 0, 1}));
}

}  // namespace
}  // namespace limpid
