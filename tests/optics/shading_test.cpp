#include "optics/shading.h"

#include <cmath>

#include <gtest/gtest.h>

namespace limpid {
namespace {

constexpr Rgb<double> kBase{0.5, 0.25, 1}, kAmbient{0.1, 0.2, 0.3}, kSun{2, 4, 1};

void expect_rgb(const Rgb<double>& got, const Rgb<double>& want) {
  EXPECT_NEAR(got.r, want.r, 1e-12);
  EXPECT_NEAR(got.g, want.g, 1e-12);
  EXPECT_NEAR(got.b, want.b, 1e-12);
}

TEST(LambertShading, HandWorked) {
  // At 60 degrees, half in shadow: a quarter of the sun.
  expect_rgb(lambert_shading(kBase, kAmbient, 0.5, 0.5, kSun), {0.3, 0.3, 0.55});
  expect_rgb(lambert_shading(kBase, kAmbient, 1.0, 1.0, kSun), {1.05, 1.05, 1.3});
  expect_rgb(lambert_shading(kBase, kAmbient, -0.5, 1.0, kSun), kBase * kAmbient);
  EXPECT_EQ(lambert_shading(kBase, kAmbient, 1.0 + 1e-7, 1.0, kSun),
            lambert_shading(kBase, kAmbient, 1.0, 1.0, kSun))
      << "a cosine that rounding made too large";
}

TEST(PhongGlint, IsTheLobeTimesShadowAndSun) {
  const Vec3<double> n{0, 1, 0}, l{0, 0.8, 0.6}, mirrored{0, 0.8, -0.6};
  expect_rgb(phong_glint(kBase, 50.0, n, mirrored, l, 0.25, kSun), {0.25, 0.25, 0.25});
  // 2 (n.l) n - l = (0, .8, -.6), seen from straight above: .8^2.
  expect_rgb(phong_glint(kBase, 2.0, n, n, l, 1.0, kSun), {0.64, 0.64, 0.64});
  const Vec3<double> below{0, -0.8, 0.6};
  expect_rgb(phong_glint(kBase, 0.0, n, n, below, 1.0, kSun), {0, 0, 0});
}

TEST(ToonSteps, AreFifthsThatBeginAtOnce) {
  EXPECT_EQ(toon_steps(0.0), 0);
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(toon_steps(0.2 * i + 1e-3), 0.2 * (i + 1), 1e-12) << i;
    EXPECT_NEAR(toon_steps(0.2 * i + 0.199), 0.2 * (i + 1), 1e-12) << i;
  }
  EXPECT_NEAR(toon_steps(1.0), 1, 1e-12);
}

TEST(ToonShading, HandWorked) {
  // .9 of the sun, .6 of it in the light: .54, which is the third step.
  expect_rgb(toon_shading(kBase, kAmbient, 0.9, 0.6, kSun), {0.65, 0.65, 0.9});
  expect_rgb(toon_shading(kBase, kAmbient, -0.9, 1.0, kSun), kBase * kAmbient);
  expect_rgb(toon_shading(kBase, kAmbient, 1.0 + 1e-7, 1.0, kSun), {1.05, 1.05, 1.3});
}

}  // namespace
}  // namespace limpid
