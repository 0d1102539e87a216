#include "limpid/ops/water_shadow.h"

#include "ops/tray.h"

namespace limpid {
namespace {

using test::Tray;

/// Shadow on the left half of ten columns, strength 0.5.
Tray half_shaded() {
  Tray tray({10, 4});
  tray.buffers.set(PlaneId::kShadow, [](int x, int) { return x < 5 ? 0.f : 1.f; });
  tray.look.of<WaterShadow>().strength = 0.5;
  return tray;
}

TEST(WaterShadow, HandWorkedPixels) {
  const test::Picture got = half_shaded().wet();
  test::expect_rgb(got.color(2, 1), {0.25, 0.25, 0.25});
  test::expect_rgb(got.color(7, 1), {0.5, 0.5, 0.5});
}

TEST(WaterShadow, PenumbraIsLinear) {
  Tray tray = half_shaded();
  tray.buffers.fill(PlaneId::kShadow, 0.3f);
  EXPECT_NEAR(tray.wet().color(2, 1).r, 0.5 * (1 - 0.5 * 0.7), 1e-6);
}

TEST(WaterShadow, FullStrengthIsBlack) {
  Tray tray = half_shaded();
  tray.look.of<WaterShadow>().strength = 1;
  EXPECT_EQ(tray.wet().color(2, 1).r, 0);
  EXPECT_EQ(tray.wet().color(7, 1).r, 0.5);
}

TEST(WaterShadow, FallsOnTheFogToo) {
  Tray tray = half_shaded();
  tray.look.of<DepthFog>() = {};
  const test::Picture got = tray.wet();
  for (Aov term : {Aov::kTransmitted, Aov::kInScatter}) {
    EXPECT_GT(got.aov(term, 7, 1), 0);
    EXPECT_NEAR(got.aov(term, 2, 1), 0.5 * got.aov(term, 7, 1), 1e-7);
  }
}

// Tilt 0.6 times 0.25 on 10 pixels: one and a half pixels to the right, half way from the shaded
// column 4 to the lit column 5.
TEST(WaterShadow, IsLookedUpWhereTheRefractedRayEnds) {
  Tray tray = half_shaded();
  tray.buffers.normal({0.6, 0.8, 0});
  tray.look.of<Refraction>().strength = 0.25;
  const test::Picture got = tray.wet();
  EXPECT_NEAR(got.color(3, 1).r, 0.375, 1e-5);
  EXPECT_NEAR(got.color(2, 1).r, 0.25, 1e-5);
  EXPECT_NEAR(got.color(4, 1).r, 0.5, 1e-5);
}

TEST(WaterShadow, LeavesTheReflectionAlone) {
  Tray tray = half_shaded();
  for (int c = 0; c < 3; ++c) tray.buffers.fill(plane_after(PlaneId::kReflectionR, c), 1);
  const test::Picture got = tray.wet();
  EXPECT_GT(got.aov(Aov::kReflected, 2, 1), 0);
  EXPECT_EQ(got.aov(Aov::kReflected, 2, 1), got.aov(Aov::kReflected, 7, 1));
}

TEST(WaterShadow, DarkensMoreWithStrengthAndNeverBrightens) {
  double before = 0.5;
  for (double strength : {0.1, 0.4, 0.9, 1.0}) {
    Tray tray = half_shaded();
    tray.look.of<WaterShadow>().strength = strength;
    const double now = tray.wet().color(2, 1).r;
    EXPECT_LT(now, before);
    before = now;
  }
}

}  // namespace
}  // namespace limpid
