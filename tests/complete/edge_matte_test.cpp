#include "complete/edge_matte.h"

#include <gtest/gtest.h>

#include "complete/edge_blur.h"

// The estimates behind Edges, by hand.

namespace limpid {
namespace {

/// Pixels of that color and weight, less the color of the pixel.
EdgeMoments of(const std::vector<Rgb<double>>& colors, const Rgb<double>& pixel, double weight) {
  EdgeMoments sums;
  for (const Rgb<double>& c : colors) sums.add(weight, c - pixel, 1);
  return sums;
}

constexpr Rgb<double> kRed{1, 0, 0}, kGreen{0, 1, 0};

EdgeAround between(const Rgb<double>& pixel, const std::vector<Rgb<double>>& dry,
                   const std::vector<Rgb<double>>& wet) {
  EdgeAround around;
  around.of(EdgeKind::kSureDry) = of(dry, pixel, 1);
  around.of(EdgeKind::kSureWet) = of(wet, pixel, 2);
  return around;
}

// Between sides of one color each the difference is 1 / 0.01 of the allowed noise: s = 0.01.
TEST(EdgeMatte, LiesBetweenTwoColors) {
  const auto matte = matte_between(between({0.25, 0.75, 0}, {kRed}, {kGreen}));
  ASSERT_TRUE(matte);
  const double cover = (0.25 - 0.01) / 0.98;
  EXPECT_NEAR(matte->cover, cover, 1e-9);
  // The rest of the estimate belongs to both sides by their shares.
  const double rest = 0.25 - cover;
  EXPECT_NEAR(0.25 + matte->behind.r, (1 - cover) * rest, 1e-9);
  EXPECT_NEAR(0.75 + matte->behind.g, 1 - (1 - cover) * rest, 1e-9);
}

TEST(EdgeMatte, EndsAtTheSides) {
  EXPECT_EQ(matte_between(between(kRed, {kRed}, {kGreen}))->cover, 1);
  EXPECT_EQ(matte_between(between(kGreen, {kRed}, {kGreen}))->cover, 0);
}

// Both sides vary in green alone, by as much as their difference: red tells them apart.
TEST(EdgeMatte, TextureOfBothSidesIsNoShare) {
  const std::vector<Rgb<double>> dry{{1, 0, 0}, {1, 2, 0}}, wet{{0, 1, 0}, {0, 3, 0}};
  const auto matte = matte_between(between({0.5, 0.9, 0}, dry, wet));
  ASSERT_TRUE(matte);
  EXPECT_NEAR(matte->cover, 0.5, 0.01);
}

TEST(EdgeMatte, IsNotMadeUp) {
  EXPECT_FALSE(matte_between(between({0.5, 0.5, 0}, {kRed}, {kRed})));       // sides alike
  EXPECT_FALSE(matte_between(between({0.5, 0.5, 0}, {}, {kGreen})));         // one side
  EXPECT_FALSE(matte_between(between({0.5, 0.5, 0}, {kRed}, {})));           // the other
  EXPECT_FALSE(matte_between(between({0.5, 0.5, 0.9}, {kRed}, {kGreen})));   // a third color
  EXPECT_FALSE(matte_between(between({1.4, 0.5, 0}, {{1, 0, 0}, {0, 1, 0}},  // texture as large
                                     {{0.9, 0, 0}, {0, 0.9, 0}})));          // as the difference
}

// Without sure dry pixels: the dry share is 1 at red 0.6, 1/2 at 0.3, 0 at 0; so at 0.45 it is 3/4.
TEST(EdgeMatte, RegressesTheSidesOnColor) {
  const Rgb<double> pixel{0.45, 0, 0};
  EdgeAround around;
  around.of(EdgeKind::kDry) = of({{0.6, 0, 0}, {0.6, 0, 0}, {0.3, 0, 0}}, pixel, 1);
  around.of(EdgeKind::kWet) = of({{0.3, 0, 0}}, pixel, 1);
  around.of(EdgeKind::kSureWet) = of({{0, 0, 0}, {0, 0, 0}}, pixel, 1);
  const auto matte = matte_by_regression(around);
  ASSERT_TRUE(matte);
  EXPECT_NEAR(matte->cover, 0.75, 1e-3);
  EXPECT_NEAR(matte->behind.r, -0.45, 1e-12);
  // No pixel is dry; none is sure to be wet; colors do not tell the sides apart.
  EdgeAround none = around;
  none.of(EdgeKind::kDry) = {};
  EXPECT_FALSE(matte_by_regression(none));
  none = around;
  none.of(EdgeKind::kSureWet) = {};
  EXPECT_FALSE(matte_by_regression(none));
  none = around;
  none.of(EdgeKind::kDry) = of({{0.1, 0, 0}, {-0.1, 0, 0}}, {0, 0, 0}, 1);
  none.of(EdgeKind::kWet) = none.of(EdgeKind::kSureWet) = none.of(EdgeKind::kDry);
  EXPECT_FALSE(matte_by_regression(none));
}

// The share at red 0.15 is 0.26316, the object's red 0.61667, and -0.01228 of the red is
// unexplained: by texture of the variance 0.01, seen through the rest, and by errors 0.1 of the
// contrast.
TEST(EdgeMatte, LeavesTextureToThePartBehind) {
  const Rgb<double> pixel{0.15, 0, 0};
  EdgeAround around;
  around.of(EdgeKind::kDry) = of({{0.6, 0, 0}, {0.6, 0, 0}, {0.3, 0, 0}}, pixel, 1);
  around.of(EdgeKind::kWet) = of({{0.3, 0, 0}}, pixel, 1);
  around.of(EdgeKind::kSureWet) = of({{0.1, 0, 0}, {-0.1, 0, 0}}, pixel, 1);
  const auto matte = matte_by_regression(around);
  ASSERT_TRUE(matte);
  EXPECT_NEAR(matte->cover, 0.26316, 2e-4);
  EXPECT_NEAR(matte->behind.r, -0.15 - 0.79813 * 0.01228, 2e-4);
}

TEST(EdgeMatte, LooksWetWithinThreeDeviations) {
  for (const double red : {0.0, 0.25, 0.35}) {
    const Rgb<double> pixel{red, 0, 0};
    EdgeAround around;
    EXPECT_FALSE(looks_wet(around, pixel));
    around.of(EdgeKind::kSureWet) = of({{0.1, 0, 0}, {-0.1, 0, 0}}, pixel, 1);
    EXPECT_EQ(looks_wet(around, pixel), red < 0.3) << red;
  }
}

TEST(EdgePlane, GoesOnToThePixel) {
  EdgePlane plane;
  for (const auto& [x, y] : {std::pair{1, 0}, {2, 0}, {1, 3}, {-2, 1}}) {
    plane.add(0.5, x, y, 2 + 0.1 * x - 0.2 * y);
  }
  EXPECT_NEAR(plane.here(), 2, 1e-12);
  EdgePlane alone;
  alone.add(1, 4, 4, 0.5);
  EXPECT_EQ(alone.here(), 0.5);
}

/// How a ramp that is `width` pixels wide grows: at distance k it shows (2 k + 1) / width, at
/// most 1.
EdgeBlur::Growth ramp(double width) {
  const auto shown = [&](std::size_t i) {
    return std::min((2 * EdgeBlur::kLadder[i] + 1) / width, 1.0);
  };
  EdgeBlur::Growth growth;
  for (std::size_t i = 0; i < growth.own.size(); ++i) {
    growth.own[i] = shown(i) * shown(i);
    growth.next[i] = shown(i) * shown(i + 1);
    if (i < growth.after.size()) growth.after[i] = shown(i) * shown(i + 2);
  }
  return growth;
}

TEST(EdgeBlur, IsAsWideAsItsRampIsLong) {
  for (const auto& [width, half] :
       {std::pair{1.0, 0}, {1.3, 1}, {3.0, 1}, {6.0, 3}, {15.0, 7}, {30.0, 15}, {60.0, 31}}) {
    EXPECT_EQ(EdgeBlur::kLadder[static_cast<std::size_t>(ramp(width).full_at())], half) << width;
  }
}

// A difference that grows by a fifth at each distance is light that changes, not a blur.
TEST(EdgeBlur, EndsWhereTheDifferenceGrowsSlowly) {
  EdgeBlur::Growth growth = ramp(1.4);
  for (std::size_t i = 1; i < growth.own.size(); ++i) {
    growth.next[i] = 1.2 * growth.own[i];
  }
  growth.after[1] = 1.44 * growth.own[1];
  EXPECT_EQ(growth.full_at(), 1);
  EXPECT_EQ(EdgeBlur::Growth{}.full_at(), 0);
  EXPECT_EQ(ramp(200).full_at(), 0);    // light over the whole picture
  growth.dry[1] = 0.5 * growth.own[1];  // as beside a thin object
  EXPECT_EQ(growth.full_at(), 1);
  growth.wet[1] = 0.5 * growth.own[1];
  growth.steps = 10;
  EXPECT_EQ(growth.full_at(), 0);  // or as much change beside the edge
  growth.speckled = 4;             // a blur even where depth is that of either side by chance
  EXPECT_EQ(growth.full_at(), 1);
}

}  // namespace
}  // namespace limpid
