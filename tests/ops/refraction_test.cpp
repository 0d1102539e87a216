#include "limpid/ops/refraction.h"

#include "ops/tray.h"

namespace limpid {
namespace {

using test::Tray;

/// Red counts columns, green rows; every normal leans right by 0.6. strength 1/6 on 10 pixels:
/// 0.1 uv, one pixel to the right.
Tray leaning_tray() {
  Tray tray({10, 10});
  tray.buffers.set(PlaneId::kColorR, [](int x, int) { return float(x); });
  tray.buffers.set(PlaneId::kColorG, [](int, int y) { return float(y); });
  tray.buffers.normal({0.6, 0.8, 0});
  tray.look.of<Refraction>().strength = 1.0 / 6;
  return tray;
}

TEST(Refraction, LooksUpWhereTheNormalLeans) {
  const test::Picture got = leaning_tray().wet();
  test::expect_rgb(rgb_of(got, Aov::kTransmitted, 3, 4), {4, 4, 0.5}, 1e-5);
  EXPECT_EQ(got.aov(Aov::kConfidence, 3, 4), 1);
}

TEST(Refraction, DownIsTowardsTheViewer) {
  Tray tray = leaning_tray();
  tray.buffers.normal({0, 0.8, 0.6});
  test::expect_rgb(rgb_of(tray.wet(), Aov::kTransmitted, 3, 4), {3, 5, 0.5}, 1e-5);
}

TEST(Refraction, ColorTapIsBilinear) {
  Tray tray = leaning_tray();
  tray.look.of<Refraction>().strength = 0.25 / 6;
  test::expect_rgb(rgb_of(tray.wet(), Aov::kTransmitted, 3, 4), {3.25, 4, 0.5}, 1e-5);
}

TEST(Refraction, TapsAreClampedAtTheEdges) {
  Tray tray = leaning_tray();
  EXPECT_NEAR(tray.wet().aov(Aov::kTransmitted, 9, 0), 9, 1e-6);
  tray.look.of<Refraction>().strength = 10;
  EXPECT_NEAR(tray.wet().aov(Aov::kTransmitted, 0, 0), 9, 1e-6);
  tray.look.of<Refraction>().strength = -10;
  EXPECT_NEAR(tray.wet().aov(Aov::kTransmitted, 9, 0), 0, 1e-6);
}

// Water that bends no light splits no light either.
TEST(Refraction, ChannelsStayTogetherInWaterOfIndexOne) {
  Tray tray = leaning_tray();
  for (int c = 0; c < 3; ++c) {
    tray.buffers.set(plane_after(PlaneId::kColorR, c), [](int x, int) { return float(x); });
  }
  tray.look.water.ior = 1;
  tray.look.of<PrismSplit>() = {PrismSplit::Model::kDispersion, 0, 10};
  test::expect_rgb(rgb_of(tray.wet(), Aov::kTransmitted, 3, 4), {4, 4, 4}, 1e-5);
}

TEST(Refraction, CalmWaterDoesNotShift) {
  Tray tray = leaning_tray();
  tray.buffers.normal({0, 1, 0});
  EXPECT_EQ(tray.wet().aov(Aov::kTransmitted, 3, 4), 3);
}

/// A post at column 5, in front of the water.
Tray tray_with_post() {
  Tray tray = leaning_tray();
  tray.buffers.set(PlaneId::kDepth, [](int x, int) { return x == 5 ? 9.f : float(11 + x); });
  tray.look.of<DepthFog>().alpha = 1e-9;  // so that the path is measured
  return tray;
}

TEST(Refraction, SnapGoesBackWhereItWouldSeeThePost) {
  const test::Picture got = tray_with_post().wet();
  EXPECT_NEAR(got.aov(Aov::kTransmitted, 4, 2), 4, 1e-6);
  EXPECT_EQ(got.aov(Aov::kConfidence, 4, 2), 0);
  EXPECT_NEAR(got.aov(Aov::kPath, 4, 2), 5, 1e-6);  // own depth 15, surface 10
  EXPECT_NEAR(got.aov(Aov::kTransmitted, 3, 2), 4, 1e-5);
  EXPECT_EQ(got.aov(Aov::kConfidence, 3, 2), 1);
  EXPECT_NEAR(got.aov(Aov::kPath, 3, 2), 5, 1e-6);  // depth where it landed 15
}

TEST(Refraction, SnapSwitchesThePrismOffInEveryChannel) {
  Tray tray = tray_with_post();
  for (int c = 0; c < 3; ++c) {
    tray.buffers.set(plane_after(PlaneId::kColorR, c),
                     [](int x, int y) { return float(x + 100 * y); });
  }
  tray.buffers.normal({0.48, 0.8, 0.36});
  tray.look.of<Refraction>().strength = 1.0 / 4.8;  // (1, .75) pixels
  tray.look.of<PrismSplit>().strength = 1.0 / 4.8;
  const test::Picture got = tray.wet();
  test::expect_rgb(rgb_of(got, Aov::kTransmitted, 4, 2), {204, 204, 204}, 1e-4);
  test::expect_rgb(rgb_of(got, Aov::kTransmitted, 2, 2), {279, 316, 353}, 1e-3);
}

// Fault of the model, kept: only the centre of the three prism lookups is tested.
TEST(Refraction, SnapTestsOnlyTheCentreOfThePrism) {
  Tray tray = tray_with_post();
  tray.look.of<PrismSplit>().strength = 1.0 / 6;
  EXPECT_NEAR(tray.wet().aov(Aov::kTransmitted, 3, 2), 5, 1e-5);
}

TEST(Refraction, WithoutRejectionThePostIsSeen) {
  Tray tray = tray_with_post();
  tray.look.of<Refraction>().rejection = Refraction::Rejection::kNone;
  const test::Picture got = tray.wet();
  EXPECT_NEAR(got.aov(Aov::kTransmitted, 4, 2), 5, 1e-5);
  EXPECT_EQ(got.aov(Aov::kConfidence, 4, 2), 1);
  EXPECT_EQ(got.aov(Aov::kPath, 4, 2), 0);  // never below 0
}

TEST(Refraction, DepthAtTheSurfaceIsNotInFrontOfIt) {
  Tray tray = tray_with_post();
  tray.buffers.set(PlaneId::kDepth, [](int x, int) { return x == 5 ? 10.f : 14.f; });
  EXPECT_EQ(tray.wet().aov(Aov::kConfidence, 4, 2), 1);
}

TEST(Refraction, WhatSnapLetsPassLiesUnderTheSurface) {
  const Size size{61, 47};
  test::Noise noise(size);
  noise.look.of<Refraction>().strength = 0.1;
  noise.look.of<DepthFog>().alpha = 1e-9;
  const test::Picture got = noise.wet();
  int snapped = 0;
  each_wet(got, size, [&](int x, int y) {
    const double own = double(noise.buffers.frame.plane(PlaneId::kDepth).at(x, y)) -
                       noise.buffers.frame.plane(PlaneId::kSurfaceDepth).at(x, y);
    // The light is whole, or the part beside texels without a hit; or no surface was hit.
    const bool passed =
        got.aov(Aov::kConfidence, x, y) > 0 || std::isinf(got.aov(Aov::kPath, x, y));
    EXPECT_GT(got.aov(Aov::kPath, x, y), 0);  // 0 where the hit is in front of the surface
    if (passed) return;
    const double u = got.aov(Aov::kStmapG, x, y, 0), v = got.aov(Aov::kStmapG, x, y, 1);
    const double edge_u = 0.5 / size.width, edge_v = 0.5 / size.height;
    if (u < edge_u || u > 1 - edge_u || v < edge_v || v > 1 - edge_v) return;  // off the frame
    ++snapped;
    EXPECT_EQ(got.aov(Aov::kConfidence, x, y), 0);
    EXPECT_EQ(float(got.aov(Aov::kPath, x, y)), float(own));
    EXPECT_NEAR(got.aov(Aov::kTransmitted, x, y),
                noise.buffers.frame.plane(PlaneId::kColorR).at(x, y), 1e-6);
  });
  EXPECT_GT(snapped, 20);
}

}  // namespace
}  // namespace limpid
