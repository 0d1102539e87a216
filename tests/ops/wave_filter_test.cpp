#include <algorithm>
#include <cstring>
#include <vector>

#include "complete/slope_map.h"
#include "judge/trace/one_pixel.h"
#include "op/pass.h"
#include "op/pixel_start.h"
#include "op/plain_texture.h"
#include "ops/tray.h"
#include "ops/wave_normals_kernel.h"

namespace limpid {
namespace {

using Filter = WaveNormals::Filter;
using Model = WaveNormals::Model;
using test::NoiseMap;
using test::Tray;

constexpr Size kEight{8, 8};
constexpr Model kMapModels[] = {Model::kFourMaps, Model::kTwoFlows, Model::kDudv, Model::kSlopes};
constexpr Filter kFilters[] = {Filter::kNone, Filter::kMip, Filter::kVariance};

/// Pixels one unit wide, and a map of 8 x 8 texels.
test::Picture waves(const NoiseMap& map, Model model, Filter filter, double tile_size) {
  Tray tray(kEight);
  tray.buffers.frame.wave_map = map.texture;
  WaveNormals::Params& params = tray.look.of<WaveNormals>();
  params.model = model;
  params.filter = filter;
  params.strength = 0.7;
  params.tile_size = tile_size;
  params.speed = 0.61;
  tray.scene.time = 3.3;
  return tray.wet();
}

/// By hand: 8 texels in 8 units, 8 in 20 and 8 in 1e9.
TEST(WaveFilter, ChangesNothingWhereTexelsAreResolved) {
  const NoiseMap map(8, 8);
  for (const Model model : kMapModels) {
    for (const double tile_size : {8.0, 20.0, 1e9}) {
      const std::vector<float> plain = waves(map, model, Filter::kNone, tile_size).values();
      for (const Filter filter : {Filter::kMip, Filter::kVariance}) {
        const std::vector<float> got = waves(map, model, filter, tile_size).values();
        ASSERT_EQ(plain.size(), got.size());
        EXPECT_EQ(std::memcmp(plain.data(), got.data(), plain.size() * sizeof(float)), 0)
            << int(model) << " " << tile_size;
      }
    }
  }
}

// Level 0 has slopes of 1, level 1 of 3: half of both where a pixel is as wide as 1.5 texels.
TEST(WaveFilter, LevelsPassIntoOneAnother) {
  SlopeLevels levels;
  levels.sizes = levels_from({4, 4});
  std::vector<float> slopes(static_cast<std::size_t>(levels.sizes.texels), 3);
  std::fill_n(slopes.begin(), levels.sizes.first[1], 1.0f);
  for (const float*& plane : levels.planes) plane = slopes.data();
  const auto slope = [&](double width) {
    return tiled_slopes_at(levels, {0.3, 0.4}, width).mean.x;
  };
  for (const double width : {0.0, 0.5, 1.0, 1.375}) EXPECT_EQ(slope(width), 1) << width;
  EXPECT_NEAR(slope(1.5), 2, 1e-12);
  for (const double width : {1.625, 2.0, 100.0}) EXPECT_NEAR(slope(width), 3, 1e-12) << width;
}

/// A pixel that holds the whole map, or a thousand maps, has the map's mean.
TEST(WaveFilter, AMapWithinAPixelIsItsMean) {
  const NoiseMap map(8, 8);
  double mean[2] = {};
  for (int i = 0; i < 64; ++i) {
    for (int c = 0; c < 2; ++c) mean[c] += (2 * map.texture.channels[c].at(i % 8, i / 8) - 1) / 64;
  }
  const auto leans = [](double x, double y, double up) {
    return normalize_or(Vec3<double>{x, up, -y}, Vec3<double>{0, 1, 0});
  };
  const auto expect_normals = [](const test::Picture& got, Vec3<double> expected,
                                 double tolerance) {
    for (int i = 0; i < 64; ++i) {
      const auto of = [&](int c) { return got.aov(Aov::kNormal, i % 8, i / 8, c); };
      EXPECT_NEAR(of(0), expected.x, tolerance);
      EXPECT_NEAR(of(1), expected.y, tolerance);
      EXPECT_NEAR(of(2), expected.z, tolerance);
    }
  };
  for (const double tile_size : {1.0, 0.5, 1e-3}) {
    for (const Filter filter : {Filter::kMip, Filter::kVariance}) {
      // lerp(up, mean, 0.7), blue 0.9; to within the bits of the levels.
      expect_normals(waves(map, Model::kFourMaps, filter, tile_size),
                     leans(0.7 * mean[0], 0.7 * mean[1], 0.3 + 0.7 * 0.8), 3e-3);
      // Slopes along the map's axes.
      expect_normals(waves(map, Model::kSlopes, filter, tile_size),
                     leans(0.7 * mean[0] / 0.8, 0.7 * mean[1] / 0.8, 1), 1e-5);
    }
  }
}

/// From one to two texels a pixel, no normal jumps.
TEST(WaveFilter, BlendsIn) {
  const NoiseMap map(8, 8);
  for (const Model model : kMapModels) {
    for (const double texels : {1.0, 2.0, 4.0, 8.0}) {
      const test::Picture under = waves(map, model, Filter::kVariance, 8 / (texels * (1 - 1e-7)));
      const test::Picture over = waves(map, model, Filter::kVariance, 8 / (texels * (1 + 1e-7)));
      for (int i = 0; i < 64; ++i) {
        for (int c = 0; c < 3; ++c) {
          EXPECT_NEAR(under.aov(Aov::kNormal, i % 8, i / 8, c),
                      over.aov(Aov::kNormal, i % 8, i / 8, c), 2e-5)
              << int(model) << " " << texels;
        }
      }
    }
  }
}

/// One pixel over a map of stripes, slope 1 and 0 by turns along x.
struct Striped {
  Striped() : tray(kEight) {
    const float values[] = {0.5f, 0.5f, 0.6f};
    for (std::size_t c = 0; c < 3; ++c) {
      planes[c] = Plane(rect_of(kEight));
      for (int i = 0; i < 64; ++i) {
        planes[c].view().at(i % 8, i / 8) = c == 0 && i % 2 == 0 ? 0.6f : values[c];
      }
      tray.buffers.frame.wave_map.channels[c] = planes[c].view();
    }
    params.tile_size = 8;
    params.strength = 0.5;
    params.filter = Filter::kVariance;
  }

  /// The waves in a pixel of this width, after this drift in periods.
  Pixel<double> wave(double width, double drift = 0) {
    params.speed = drift * params.tile_size;
    tray.scene.time = 1;
    LevelMaker maker;
    maker.make(tray.buffers.frame.wave_map);
    SlopeMap slopes;
    slopes.make(maker.levels(), Kernel<WaveNormals>::four_shifts(params, 1), *make_executor(1));
    Frame frame = tray.buffers.frame;
    frame.wave_slopes = &slopes.levels();
    frame.wave_variance = Kernel<WaveNormals>::wave_variance(params, maker.levels(), 1);
    Pass pass(tray.scene, frame, 1.33, kWholeState);
    pass.part.origin_dx = width * pass.rays.origin_dx;
    pass.part.origin_dy = width * pass.rays.origin_dy;
    Pixel<double> pixel{};
    const RowRays<double> rays(pass, 4.5);
    begin_pixel(pass, rays, 4.5, 1.0, 10.0, 14.0, pixel);
    begin_state(kWholeState, pass, Rgb<double>{}, pixel);
    trace::OnePixel strip(pixel);
    Kernel<WaveNormals>::apply(params, pass, strip);
    return pixel;
  }

  std::array<Plane, 3> planes;
  Tray tray;
  WaveNormals::Params params;
};

TEST(WaveFilter, WhatAPixelCannotResolveBecomesVariance) {
  Striped striped;
  EXPECT_EQ(striped.wave(1).slope_variance.xx, 0);
  const Pixel<double> far = striped.wave(2);
  EXPECT_NEAR(far.slope_variance.xx, 0.25 * 0.25, 1e-5);  // strength squared, slopes' variance 1/4
  EXPECT_NEAR(far.slope_variance.xy, 0, 1e-6);
  EXPECT_NEAR(far.slope_variance.yy, 0, 1e-6);
  EXPECT_NEAR(far.normal.x / far.normal.y, 0.5 * 0.5, 1e-5);
  const double between = striped.wave(1.5).slope_variance.xx;
  EXPECT_GT(between, 0.01);
  EXPECT_LT(between, 0.0625);
}

/// Four lookups that read the same waves vary as one lookup does; two pairs of opposed lookups
/// cancel.
TEST(WaveFilter, KnowsHowFarTheLookupsHaveDrifted) {
  Striped striped;
  EXPECT_NEAR(striped.wave(2, 0.25).slope_variance.xx, 0.0625, 1e-5);
  EXPECT_NEAR(striped.wave(2, 0.125).slope_variance.xx, 0, 1e-5);
}

/// Stripes lean along x alone: a wind along x has no variance across to scale.
TEST(WaveFilter, AWindScalesWhatAPixelCannotResolve) {
  Striped striped;
  striped.params.wind = 8;
  const WindSlopes wanted = wind_slopes(8);
  for (const double degrees : {0.0, 90.0, 30.0, 200.0}) {
    striped.params.direction = degrees;
    const double angle = degrees * std::numbers::pi / 180;
    const Vec2<double> ahead{std::cos(angle), std::sin(angle)}, aside{-ahead.y, ahead.x};
    const Sym2<double> got = striped.wave(8e3).slope_variance;
    const double strength = 0.5, of_x = std::abs(ahead.x), of_y = std::abs(ahead.y);
    const double square = strength * strength;
    EXPECT_NEAR(along(got, ahead), of_x > 1e-9 ? square * wanted.along : 0, 1e-5) << degrees;
    EXPECT_NEAR(along(got, aside), of_y > 1e-9 ? square * wanted.across : 0, 1e-5) << degrees;
  }
}

TEST(WaveFilter, MipHasNoVariance) {
  Striped striped;
  striped.params.filter = Filter::kMip;
  const Pixel<double> far = striped.wave(2);
  EXPECT_EQ(far.slope_variance.xx, 0);
  EXPECT_EQ(far.slope_variance.yy, 0);
  EXPECT_NEAR(far.normal.x / far.normal.y, 0.5 * 0.5, 1e-5);
}

/// Footprints over the whole map and without bounds.
TEST(WaveFilter, AnyFootprintGivesTheMapsOwnVariance) {
  Striped striped;
  for (const double tile_size : {8.0, 1e-6}) {
    striped.params.tile_size = tile_size;
    for (const double width : {8 * tile_size, 1e3, 1e6, 1e12, 1e300}) {
      if (width < 8 * tile_size) continue;
      const Pixel<double> far = striped.wave(width);
      EXPECT_NEAR(far.slope_variance.xx, 0.0625, 1e-5) << width << " " << tile_size;
      EXPECT_NEAR(far.normal.x / far.normal.y, 0.25, 1e-5) << width << " " << tile_size;
    }
  }
}

TEST(WaveFilter, MapsOfOneTexelAndOfOddSizesHaveTheirMean) {
  for (const Size size : {Size{1, 1}, Size{1, 7}, Size{5, 3}}) {
    const NoiseMap map(size.width, size.height);
    for (const Model model : kMapModels) {
      for (const Filter filter : kFilters) {
        const test::Picture near = waves(map, model, filter, 1e6);
        const test::Picture far = waves(map, model, filter, 1e-6);
        for (int c = 0; c < 3; ++c) {
          EXPECT_TRUE(std::isfinite(near.aov(Aov::kNormal, 3, 3, c)));
          EXPECT_TRUE(std::isfinite(far.aov(Aov::kNormal, 3, 3, c)));
          if (rect_of(size).area() > 1) continue;
          EXPECT_NEAR(near.aov(Aov::kNormal, 3, 3, c), far.aov(Aov::kNormal, 3, 3, c), 3e-3);
        }
      }
    }
  }
}

}  // namespace
}  // namespace limpid
