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
  // Each level has a column and a row more.
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

/// The last level is the mean of the whole map where sizes are odd, too.
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

/// A map of 1040 x 2 texels: slopes 1 and 3 along x by turns; each texel of the base holds both.
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

/// Covariance of the slopes of a map under four lookups.
Sym2<double> variance_of(const Texture& map, const FourShifts& shifts) {
  LevelMaker maker;
  maker.make(map);
  return slope_variance(maker.levels(), shifts);
}

/// Lookups that coincide are one lookup: its slopes over all texels, by hand.
TEST(SlopeVariance, OfOneLookupIsThatOfTheMap) {
  const test::NoiseMap map(8, 5);
  Vec2<double> mean{0, 0};
  Sym2<double> square{0, 0, 0};
  for (int i = 0; i < 40; ++i) {
    const auto slope = [&](int c) {
      return (2.0 * map.texture.channels[c].at(i % 8, i / 8) - 1) / 0.8;
    };
    const double x = slope(0), y = slope(1);
    mean = mean + Vec2<double>{x / 40, y / 40};
    square = square + (1.0 / 40) * Sym2<double>{x * x, x * y, y * y};
  }
  const FourShifts together{{{0.25, 0.4}, {0.25, 0.4}, {-0.75, 3.4}, {0.25, -0.6}}};
  for (const FourShifts& shifts : {FourShifts{}, together}) {
    const Sym2<double> got = variance_of(map.texture, shifts);
    EXPECT_NEAR(got.xx, square.xx - mean.x * mean.x, 1e-6);
    EXPECT_NEAR(got.xy, square.xy - mean.x * mean.y, 1e-6);
    EXPECT_NEAR(got.yy, square.yy - mean.y * mean.y, 1e-6);
  }
}

/// Half of the lookups move a quarter of a period, where this wave is at its other phase.
TEST(SlopeVariance, OfWavesThatCancelIsNone) {
  std::array<Plane, 3> planes;
  Texture map;
  for (std::size_t c = 0; c < 3; ++c) {
    planes[c] = Plane(Rect{0, 0, 8, 2});
    for (int i = 0; i < 16; ++i) {  // slope along x: 1, 1, 0, 0 by turns
      const float red = i % 4 < 2 ? 0.6f : 0.5f;
      planes[c].view().at(i % 8, i / 8) = c == 0 ? red : c == 1 ? 0.5f : 0.6f;
    }
    map.channels[c] = planes[c].view();
  }
  EXPECT_NEAR(variance_of(map, FourShifts{}).xx, 0.25, 1e-5);
  EXPECT_NEAR(variance_of(map, {{{0.25, 0}, {0, 0}, {0, 0.5}, {-0.25, 0}}}).xx, 0, 1e-5);
  EXPECT_NEAR(variance_of(map, {{{0.25, 0}, {0, 0}, {0, 0.5}, {0, 0}}}).xx, 0.25 / 4, 1e-5);
}

/// Maps larger than their base keep the variance within a texel of the base, as SlopeMap does.
TEST(SlopeVariance, OfALargeMapIsThatOfItsTexels) {
  std::array<Plane, 3> planes;
  Texture map;
  for (std::size_t c = 0; c < 3; ++c) {
    planes[c] = Plane(Rect{0, 0, 2048, 1});
    for (int i = 0; i < 2048; ++i) {
      planes[c].view().at(i, 0) = c == 1 && i % 2 ? 0.6f : c == 2 ? 0.6f : 0.5f;
    }
    map.channels[c] = planes[c].view();
  }
  EXPECT_NEAR(variance_of(map, FourShifts{}).yy, 0.25, 1e-4);
  EXPECT_NEAR(variance_of(map, {{{0.1, 0}, {0.3, 0}, {0.6, 0}, {0.8, 0}}}).yy, 0.25 / 4, 1e-4);
}

TEST(SlopeVariance, PlacesThatAreNoNumbersMoveNothing) {
  const test::NoiseMap map(4, 4);
  const double inf = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const FourShifts shifts{{{inf, 0}, {0, -inf}, {nan, nan}, {0, 0}}};
  EXPECT_EQ(variance_of(map.texture, shifts).xx, variance_of(map.texture, FourShifts{}).xx);
}

}  // namespace
}  // namespace limpid
