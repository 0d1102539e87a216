#include "complete/slope_map.h"

#include <gtest/gtest.h>

#include "support.h"

namespace limpid {
namespace {

/// Four lookups, shifted by the same drift along each direction of the map's axes.
FourShifts along_axes(double drift) { return {{{drift, 0}, {-drift, 0}, {0, drift}, {0, -drift}}}; }

/// The slopes of a map at one time.
struct Sloped {
  Sloped(const Texture& map, double drift, int threads = 1) {
    maker.make(map);
    slopes.make(maker.levels(), along_axes(drift), *make_executor(threads));
  }
  double at(int plane, int level, int x, int y) const {
    return slopes.levels().planes[plane][slopes.levels().sizes.place(level, x, y)];
  }
  int last() const { return slopes.levels().sizes.count - 1; }

  LevelMaker maker;
  SlopeMap slopes;
};

/// A map 0.6 up, of slopes 10 r - 5 along x and 10 g - 5 along y.
struct SteepMap {
  template <class Fn>
  SteepMap(Size size, Fn&& slope_x) {
    for (std::size_t c = 0; c < 3; ++c) {
      planes[c] = Plane(rect_of(size));
      for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
          const double value[] = {0.5 + slope_x(x, y) / 10, 0.5, 0.6};
          planes[c].view().at(x, y) = static_cast<float>(value[c]);
        }
      }
      texture.channels[c] = planes[c].view();
    }
  }
  std::array<Plane, 3> planes;
  Texture texture;
};

double stripes(int x, int) { return x % 2 == 0 ? 1 : 0; }

/// At time 0 the four lookups coincide: their mean varies as much as each lookup.
TEST(SlopeMap, WithoutDriftIsTheMap) {
  const Sloped still(SteepMap({8, 4}, stripes).texture, 0);
  EXPECT_NEAR(still.at(0, 0, 2, 1), 1, 1e-5);
  EXPECT_NEAR(still.at(0, 0, 3, 1), 0, 1e-5);
  EXPECT_NEAR(still.at(0, 1, 1, 1), 0.5, 1e-5);
  EXPECT_NEAR(still.at(2, 1, 1, 1), 0.5, 1e-5);  // mean of squares: variance 1/4
}

/// With a drift of one texel two of the four lookups read the other stripes, and nothing varies.
TEST(SlopeMap, WavesThatHaveDriftedApartCancel) {
  const Sloped apart(SteepMap({8, 4}, stripes).texture, 1. / 8);
  for (int x = 0; x < 8; ++x) EXPECT_NEAR(apart.at(0, 0, x, 0), 0.5, 1e-5);
  EXPECT_NEAR(apart.at(2, apart.last(), 0, 0), 0.25, 1e-5);  // mean of squares: variance 0
}

/// The mean of the four lookups, worked out by hand: each is bilinear in the map.
TEST(SlopeMap, IsTheMeanOfFourLookups) {
  const SteepMap map({5, 3}, [](int x, int y) { return test::noise(x, y, 8); });
  const auto at = [](int x, int y) { return double(test::noise((x + 10) % 5, (y + 6) % 3, 8)); };
  const double drift = 0.3;  // 1.5 texels along x, 0.9 along y
  const Sloped got(map.texture, drift);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 5; ++x) {
      const double right = (at(x + 1, y) + at(x + 2, y)) / 2;
      const double left = (at(x - 1, y) + at(x - 2, y)) / 2;
      const double down = 0.1 * at(x, y) + 0.9 * at(x, y + 1);
      const double up = 0.1 * at(x, y) + 0.9 * at(x, y - 1);
      const double mean = (right + left + down + up) / 4;
      EXPECT_NEAR(got.at(0, 0, x, y), mean, 1e-5) << x << ", " << y;
      EXPECT_NEAR(got.at(2, 0, x, y), mean * mean, 1e-5) << x << ", " << y;
    }
  }
}

TEST(SlopeMap, AlwaysHasTheMeanOfTheMap) {
  for (const Size size : {Size{1, 1}, Size{7, 3}, Size{600, 2}}) {
    const SteepMap map(size, [](int x, int y) { return test::noise(x, y, 9); });
    double mean = 0;
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) mean += test::noise(x, y, 9);
    }
    mean /= static_cast<double>(rect_of(size).area());
    for (const double drift : {0.0, 0.37, -12.81}) {
      const Sloped got(map.texture, drift);
      EXPECT_NEAR(got.at(0, got.last(), 0, 0), mean, 1e-4) << size.width << " " << drift;
    }
  }
}

/// Lookups share the variance within a texel of the base while they coincide, and share none once
/// they are a texel apart.
TEST(SlopeMap, LargeMapsKeepWhatVariesWithinATexel) {
  const Size size{2048, 2};  // the base is 512x1
  const SteepMap map(size, stripes);
  const auto variance = [&](double drift) {
    const Sloped got(map.texture, drift);
    const double mean = got.at(0, got.last(), 0, 0);
    return got.at(2, got.last(), 0, 0) - mean * mean;
  };
  EXPECT_NEAR(variance(0), 0.25, 1e-4);
  // The lookups that drift along y are 0.2 texels apart.
  EXPECT_NEAR(variance(0.1), 0.25 * (4 + 2 * 0.8) / 16, 1e-4);
}

TEST(SlopeMap, IsTheSameForAnyNumberOfThreads) {
  const test::NoiseMap map(61, 33);
  const Sloped one(map.texture, 0.21), two(map.texture, 0.21, 2);
  const SlopeLevels &a = one.slopes.levels(), &b = two.slopes.levels();
  for (int c = 0; c < TextureLevels::kMoments; ++c) {
    EXPECT_TRUE(std::equal(a.planes[c], a.planes[c] + a.sizes.texels, b.planes[c]));
  }
}

}  // namespace
}  // namespace limpid
