#include "judge/compare/flip.h"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "limpid/core/error.h"

#include "judge/compare/compare.h"
#include "judge/compare/metric_pictures.h"
#include "judge/compare/metrics_fixture.h"

namespace limpid {
namespace {

using test::ColorPlanes;
using test::MetricsFixture;

constexpr Rect kWindow{-3, 2, 30, 27};
const float kInf = std::numeric_limits<float>::infinity();

// A gradient up to `most`, with an edge and a point.
ColorPlanes scene(float most) {
  return {kWindow, [&](int x, int y) -> ColorPlanes::Color {
            const float v = most * static_cast<float>(x + 3) / 33;
            if (x == 20 && y == 9) return {most, 0, 0};
            return y < 12 ? ColorPlanes::Color{v, 0.5f * v, 0.2f * most}
                          : ColorPlanes::Color{0.1f * most, v, 0.8f * v};
          }};
}

double largest_difference(View<const float> a, View<const float> b) {
  const ComparedChannel channel{"map", a, b};
  return compare({&channel, 1}).overall.max;
}

double flip_of_uniform(ColorPlanes::Color a, ColorPlanes::Color b) {
  const ColorPlanes left(kWindow, a), right(kWindow, b);
  const ErrorMap error = flip({left.views(), right.views()});
  EXPECT_NEAR(error.max, error.mean, 1e-6);
  EXPECT_EQ(error.weighted_median, error.map.view().at(0, 5));
  return error.mean;
}

TEST(Flip, UniformColorsByHand) {
  // No edges, no points, nothing to blur: only the redistributed distance of two colors. The
  // numbers are those of metrics_numpy.py facts; black to white gives 100^.7 = 25.119 of 41.276.
  EXPECT_NEAR(flip_of_uniform({0, 0, 0}, {1, 1, 1}), 0.9673797615, 2e-6);
  EXPECT_NEAR(flip_of_uniform({0, 1, 0}, {0, 0, 1}), 1, 2e-6);  // the two farthest colors
  EXPECT_NEAR(flip_of_uniform({1, 0, 0}, {0, 1, 0}), 0.9866622752, 2e-6);
  EXPECT_NEAR(flip_of_uniform({0, 0, 0}, {0, 0, 1}), 0.9583294991, 2e-6);
  EXPECT_NEAR(flip_of_uniform({0.5f, 0.5f, 0.5f}, {0.18f, 0.18f, 0.18f}), 0.5715775215, 2e-6);
}

TEST(Flip, IsWhatAnIndependentReadingOfThePaperGives) {
  const MetricsFixture fixture;
  const ErrorMap error = flip(fixture.pictures());
  EXPECT_LT(largest_difference(error.map.view(), fixture.flip()), 2e-5);
  EXPECT_NEAR(error.mean, 0.0936601429, 2e-6);
}

TEST(Flip, EqualPicturesHaveNoErrorAtAll) {
  const ColorPlanes picture = scene(1);
  for (const ErrorMap& error :
       {flip({picture.views(), picture.views()}), hdr_flip({picture.views(), picture.views()})}) {
    EXPECT_EQ(error.max, 0);
    EXPECT_EQ(error.mean, 0);
    EXPECT_EQ(error.weighted_median, 0);
  }
}

TEST(Flip, IsSymmetricToTheBitAndWithinOne) {
  const MetricsFixture fixture;
  const auto [a, b] = fixture.pictures();
  const ErrorMap there = flip({a, b}), back = flip({b, a});
  EXPECT_EQ(largest_difference(there.map.view(), back.map.view()), 0);
  EXPECT_GT(there.mean, 0);
  // Checkers of the two farthest colors, and the same checkers with swapped colors.
  const auto checkers = [](int odd) {
    return ColorPlanes(kWindow, [odd](int x, int y) -> ColorPlanes::Color {
      return ((x ^ y) & 4) / 4 == odd ? ColorPlanes::Color{0, 1, 0} : ColorPlanes::Color{0, 0, 1};
    });
  };
  const ColorPlanes even = checkers(0), odd = checkers(1);
  const ErrorMap worst = flip({even.views(), odd.views()});
  EXPECT_LE(worst.max, 1);
  EXPECT_GT(worst.max, 0.9);
}

TEST(Flip, ShowsNothingThatADisplayDoesNot) {
  const ColorPlanes bright(kWindow, {5, -1, 1}), clipped(kWindow, {1, 0, 3e38f});
  EXPECT_EQ(flip({bright.views(), clipped.views()}).max, 0);
}

TEST(Flip, FromAfarFineCheckersAreGray) {
  const ColorPlanes checkers(kWindow, [](int x, int y) -> ColorPlanes::Color {
    const float v = ((x + y) & 1) != 0 ? 1.0f : 0.0f;
    return {v, v, v};
  });
  const ColorPlanes gray(kWindow, {0.5f, 0.5f, 0.5f});
  const double far = flip({checkers.views(), gray.views()}, {.pixels_per_degree = 120}).mean;
  const double near = flip({checkers.views(), gray.views()}, {.pixels_per_degree = 6}).mean;
  EXPECT_LT(far, 0.1);
  EXPECT_GT(near, 0.5);
}

TEST(Flip, NumbersThatAreNoneAreTheWorstThereIs) {
  const ColorPlanes b = scene(1);
  ColorPlanes a = scene(1);
  a.at(1, 4, 5) = std::nanf("");
  for (const ErrorMap& error : {flip({a.views(), b.views()}), hdr_flip({a.views(), b.views()})}) {
    EXPECT_EQ(error.mismatches, 1);
    EXPECT_EQ(error.mean, kInf);
    EXPECT_EQ(error.max, kInf);
    EXPECT_EQ(error.map.view().at(4, 5), kInf);
    EXPECT_EQ(error.map.view().at(5, 5), 0);  // black in both: nothing spreads
  }
  // Equal values in both pictures give no error.
  ColorPlanes same = scene(1), too = scene(1);
  for (ColorPlanes* picture : {&same, &too}) {
    picture->at(0, 8, 8) = kInf;
    picture->at(2, 9, 8) = std::nanf("");
  }
  EXPECT_EQ(flip({same.views(), too.views()}).max, 0);
  EXPECT_EQ(hdr_flip({same.views(), too.views()}).max, 0);
}

TEST(Flip, TakesPicturesOfOnePixel) {
  const Rect one{7, 7, 8, 8};
  const ColorPlanes black(one, {0, 0, 0}), white(one, {1, 1, 1});
  EXPECT_NEAR(flip({black.views(), white.views()}).mean, 0.9673797615, 2e-6);
  EXPECT_NEAR(flip({black.views(), white.views()}, {.pixels_per_degree = 1}).mean, 0.96738, 2e-6);
}

TEST(Flip, RefusesWhatItCannotDo) {
  const ColorPlanes a = scene(1), other(Rect{0, 0, 4, 4}, {0, 0, 0});
  EXPECT_THROW(flip({a.views(), other.views()}), Error);
  for (const double ppd : {0.0, -1.0, 1e9, std::nan("")}) {
    EXPECT_THROW(flip({a.views(), a.views()}, {.pixels_per_degree = ppd}), Error);
  }
  EXPECT_THROW(hdr_flip({a.views(), a.views()}, Exposures{0, 1, 1}), Error);
  EXPECT_THROW(hdr_flip({a.views(), a.views()}, Exposures{std::nan(""), 1, 4}), Error);
}

TEST(HdrFlip, IsWhatAnIndependentReadingOfThePaperGives) {
  const MetricsFixture fixture;
  const Exposures exposures = exposures_of(fixture.pictures().b);
  EXPECT_NEAR(exposures.start, fixture.exposures.start, 1e-9);
  EXPECT_NEAR(exposures.stop, fixture.exposures.stop, 1e-9);
  EXPECT_EQ(exposures.count, fixture.exposures.count);
  EXPECT_EQ(exposures.count, 8);
  const ErrorMap error = hdr_flip(fixture.pictures());
  EXPECT_LT(largest_difference(error.map.view(), fixture.hdr_flip()), 2e-5);
  EXPECT_NEAR(error.mean, 0.1352698465, 2e-6);
}

TEST(HdrFlip, ExposuresByHand) {
  // The tone .85 lies at x = 1.9535...: the exposure of a gray of 1 is its logarithm.
  const Exposures gray = exposures_of(ColorPlanes(kWindow, {1, 1, 1}).views());
  const double x = std::exp2(gray.start);
  EXPECT_NEAR((0.9036 * x * x + 0.018 * x) / (0.8748 * x * x + 0.354 * x + 0.14), 0.85, 1e-6);
  EXPECT_NEAR(gray.start, gray.stop, 1e-6);
  EXPECT_EQ(gray.count, 2);
  // Sixteen times as bright: four stops less.
  EXPECT_NEAR(exposures_of(ColorPlanes(kWindow, {16, 16, 16}).views()).start, gray.start - 4, 1e-6);
  // One pixel of 32 in a gray of 1: five stops from it to the median.
  ColorPlanes spark(kWindow, {1, 1, 1});
  for (int c = 0; c < 3; ++c) spark.at(c, 3, 3) = 31.9f;
  EXPECT_EQ(exposures_of(spark.views()).count, 5);
  EXPECT_NEAR(exposures_of(spark.views()).stop, gray.stop, 1e-6);
}

TEST(HdrFlip, HasExposuresForNightToo) {
  const ColorPlanes black(kWindow, {0, -1, 0});
  EXPECT_EQ(exposures_of(black.views()), Exposures{});
  ColorPlanes star(kWindow, {0, 0, 0});
  star.at(0, 3, 3) = star.at(1, 3, 3) = star.at(2, 3, 3) = 1;
  EXPECT_EQ(exposures_of(star.views()).count, 24);
  star.at(0, 5, 5) = kInf;  // counts as black
  EXPECT_EQ(exposures_of(star.views()).count, 24);
}

TEST(HdrFlip, SeesWhatOneExposureDoesNot) {
  // Two suns of 40 and 60 are both white on a display.
  ColorPlanes a(kWindow, {0.2f, 0.2f, 0.2f}), b(kWindow, {0.2f, 0.2f, 0.2f});
  for (int c = 0; c < 3; ++c) {
    for (int i = 0; i < 64; ++i) {
      a.at(c, 8 + i % 8, 8 + i / 8) = 40;
      b.at(c, 8 + i % 8, 8 + i / 8) = 60;
    }
  }
  EXPECT_EQ(flip({a.views(), b.views()}).max, 0);
  const ErrorMap error = hdr_flip({a.views(), b.views()});
  EXPECT_GT(error.max, 0.2);
  EXPECT_LE(error.max, 1);
  // The same gain on both pictures lowers the exposures by the same factor.
  const auto brighter = [](const ColorPlanes& picture) {
    return ColorPlanes(kWindow, [&](int x, int y) -> ColorPlanes::Color {
      const ColorViews views = picture.views();
      return {8 * views[0].at(x, y), 8 * views[1].at(x, y), 8 * views[2].at(x, y)};
    });
  };
  const ColorPlanes a8 = brighter(a), b8 = brighter(b);
  EXPECT_NEAR(hdr_flip({a8.views(), b8.views()}).mean, error.mean, 1e-5);
}

TEST(ErrorMap, SumsUpAsItSays) {
  // Half of the sum of errors lies in the 8 x 25 white columns.
  const ColorPlanes black(kWindow, {0, 0, 0});
  const ColorPlanes stripe(kWindow, [](int x, int) -> ColorPlanes::Color {
    return x < 5 ? ColorPlanes::Color{1, 1, 1} : ColorPlanes::Color{0, 0, 0};
  });
  const ErrorMap error = flip({stripe.views(), black.views()});
  double sum = 0, below = 0, largest = 0;
  int over = 0;
  for (int y = kWindow.y0; y < kWindow.y1; ++y) {
    for (int x = kWindow.x0; x < kWindow.x1; ++x) {
      const float v = error.map.view().at(x, y);
      sum += v;
      largest = std::max<double>(largest, v);
      over += v > error.p99;
      if (v < error.weighted_median) below += v;
    }
  }
  EXPECT_DOUBLE_EQ(error.mean, sum / 825);
  EXPECT_EQ(error.max, largest);
  EXPECT_LE(over, 8);
  EXPECT_LT(below, 0.5 * sum);
  EXPECT_GT(error.weighted_median, 0.5);
  EXPECT_EQ(to_text(ErrorMap{{}, 0.25, 0.5, 0.75, 1, 0}),
            "0.25, weighted median 0.5, 99% 0.75, max 1");
}

}  // namespace
}  // namespace limpid
