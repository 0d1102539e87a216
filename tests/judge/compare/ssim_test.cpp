#include "judge/compare/ssim.h"

#include <cmath>

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

template <class Value>
Plane made(Value value) {
  Plane plane(kWindow);
  for (int y = kWindow.y0; y < kWindow.y1; ++y) {
    for (int x = kWindow.x0; x < kWindow.x1; ++x) plane.view().at(x, y) = value(x, y);
  }
  return plane;
}

Plane waves() {
  return made(
      [](int x, int y) { return 0.5f + 0.4f * std::sin(0.7f * static_cast<float>(x + y)); });
}

TEST(Ssim, EqualPicturesAreAlikeToTheBit) {
  const Plane a = waves();
  const Ssim result = ssim(a.view(), a.view());
  EXPECT_EQ(result.mean, 1);
  EXPECT_EQ(result.min, 1);
  EXPECT_EQ(result.mismatches, 0);
}

TEST(Ssim, UniformPicturesByHand) {
  // Without contrast only the luminance term remains, (2 a b + C1) / (a^2 + b^2 + C1).
  const Plane a = made([](int, int) { return 0.25f; }), b = made([](int, int) { return 0.75f; });
  const double expected = (2 * 0.25 * 0.75 + 1e-4) / (0.0625 + 0.5625 + 1e-4);
  EXPECT_NEAR(ssim(a.view(), b.view()).mean, expected, 1e-12);
  EXPECT_NEAR(ssim(a.view(), b.view()).map.view().at(-3, 2), expected, 1e-7);
}

TEST(Ssim, TheInverseIsUnlike) {
  const Plane a = waves(), b = made([&](int x, int y) { return 1 - a.view().at(x, y); });
  EXPECT_LT(ssim(a.view(), b.view()).mean, -0.8);
  const Ssim there = ssim(a.view(), b.view()), back = ssim(b.view(), a.view());
  EXPECT_EQ(there.mean, back.mean);
  EXPECT_GE(there.min, -1);
}

TEST(Ssim, IsWhatAnIndependentReadingOfThePaperGives) {
  const MetricsFixture fixture;
  const Ssim result = ssim(fixture.pictures());
  const ComparedChannel map{"map", result.map.view(), fixture.ssim()};
  EXPECT_LT(compare({&map, 1}).overall.max, 1e-6);
}

TEST(Ssim, CountsWindowsThatLieInThePicture) {
  // A fault outside of every whole window.
  const Plane b = waves();
  Plane a = waves();
  a.view().at(kWindow.x0, kWindow.y0) = 0;
  const Ssim corner = ssim(a.view(), b.view());
  EXPECT_LT(corner.map.view().at(kWindow.x0, kWindow.y0), 0.99);
  EXPECT_GT(corner.min, 0.999999);  // the smallest weight of (3, 7) reaches the fault
  const Rect least{0, 0, 11, 11};
  Plane small(least);
  small.view().at(0, 0) = 1;
  const Ssim one = ssim(small.view(), small.view());
  EXPECT_EQ(one.mean, 1);
}

TEST(Ssim, OfColorIsOfItsLuminanceAsADisplayShowsIt) {
  const ColorPlanes gray(kWindow, {0.2126f, 0.2126f, 0.2126f}), red(kWindow, {1, 0, 0});
  EXPECT_NEAR(ssim({gray.views(), red.views()}).mean, 1, 1e-9);
  // Linear .5 and .18 are .7354 and .4614 on the display; values above white are clamped.
  const ColorPlanes half(kWindow, {0.5f, 0.5f, 0.5f}), mid(kWindow, {0.18f, 0.18f, 0.18f});
  const double a = 0.735357, b = 0.461356;
  EXPECT_NEAR(ssim({half.views(), mid.views()}).mean, (2 * a * b + 1e-4) / (a * a + b * b + 1e-4),
              1e-5);
  const ColorPlanes white(kWindow, {1, 1, 1}), sun(kWindow, {900, 1e30f, 7});
  EXPECT_EQ(ssim({white.views(), sun.views()}).mean, 1);
}

TEST(Ssim, NumbersThatAreNoneAreTheWorstThereIs) {
  const Plane b = waves();
  Plane a = waves();
  a.view().at(8, 8) = std::nanf("");
  const Ssim result = ssim(a.view(), b.view());
  EXPECT_EQ(result.mismatches, 1);
  EXPECT_EQ(result.mean, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(result.min, result.mean);
  EXPECT_EQ(result.map.view().at(8, 8), result.mean);
  EXPECT_EQ(result.map.view().at(9, 8), 1);
  EXPECT_EQ(ssim(a.view(), a.view()).mean, 1);
}

TEST(Ssim, RefusesWhatHasNoWindow) {
  const Plane small(Rect{0, 0, 40, 10}), other(Rect{0, 0, 40, 40});
  EXPECT_THROW(ssim(small.view(), small.view()), Error);
  EXPECT_THROW(ssim(small.view(), other.view()), Error);
}

}  // namespace
}  // namespace limpid
