#include "limpid/ops/sun_highlight.h"

#include "ops/tray.h"

namespace limpid {
namespace {

using test::Tray;

/// Sun 30 degrees from straight up towards +x, color (3, 2, 1); the viewer straight up; calm water.
Tray sunny_tray() {
  Tray tray({6, 4});
  tray.scene.sun = Sun{{0.5, std::sqrt(0.75), 0}, {3, 2, 1}};
  tray.look.of<SunHighlight>() = {};
  return tray;
}

/// Leaning towards the sun by 15 degrees: the half vector.
Vec3<double> half_way() {
  const double angle = std::numbers::pi / 12;
  return {std::sin(angle), std::cos(angle), 0};
}

TEST(SunHighlight, HandWorkedLobes) {
  Tray tray = sunny_tray();
  // Blinn-Phong, power 200: cos(15 deg)^200 = 9.743e-4.
  test::expect_rgb(rgb_of(tray.wet(), Aov::kHighlight, 2, 2), {2.923e-3, 1.949e-3, 9.743e-4}, 1e-6);
  // Phong, power 2: cos(30 deg)^2 = .75.
  tray.look.of<SunHighlight>() = {SunHighlight::Model::kPhong, 2, 1};
  test::expect_rgb(rgb_of(tray.wet(), Aov::kHighlight, 2, 2), {2.25, 1.5, 0.75});
  tray.look.of<SunHighlight>().strength = 4;
  test::expect_rgb(rgb_of(tray.wet(), Aov::kHighlight, 2, 2), {9, 6, 3}, 2e-6);
}

TEST(SunHighlight, IsTheSunsColorInTheMirrorDirection) {
  Tray tray = sunny_tray();
  tray.buffers.normal(half_way());
  for (auto model : {SunHighlight::Model::kPhong, SunHighlight::Model::kBlinnPhong}) {
    tray.look.of<SunHighlight>().model = model;
    const test::Picture got = tray.wet();
    test::expect_rgb(rgb_of(got, Aov::kHighlight, 2, 2), {3, 2, 1}, 1e-4);
    test::expect_rgb(got.color(2, 2), {3.5, 2.5, 1.5}, 1e-4);  // on top, not clamped
  }
}

TEST(SunHighlight, NoGlintInShadow) {
  Tray tray = sunny_tray();
  tray.buffers.normal(half_way());
  tray.buffers.set(PlaneId::kShadow, [](int x, int) {
    return x == 2 ? 0.f : x == 3 ? 0.25f : 1.f;
  });
  const test::Picture got = tray.wet();
  EXPECT_EQ(got.aov(Aov::kHighlight, 2, 1), 0);
  EXPECT_NEAR(got.aov(Aov::kHighlight, 3, 1), 0.75, 1e-4);
  EXPECT_NEAR(got.aov(Aov::kHighlight, 4, 1), 3, 1e-4);
}

TEST(SunHighlight, ShadowIsThePixelsOwn) {
  Tray tray = sunny_tray();
  tray.buffers.normal(half_way());
  tray.buffers.set(PlaneId::kShadow, [](int x, int) { return x == 2 ? 0.f : 1.f; });
  tray.look.of<Refraction>().strength = 1;
  EXPECT_EQ(tray.wet().aov(Aov::kHighlight, 2, 1), 0);
}

TEST(SunHighlight, NothingWithTheSunBehindTheWater) {
  Tray tray = sunny_tray();
  tray.scene.sun->direction = {0, -1, 0};
  for (auto model : {SunHighlight::Model::kPhong, SunHighlight::Model::kBlinnPhong}) {
    tray.look.of<SunHighlight>().model = model;
    EXPECT_EQ(tray.wet().aov(Aov::kHighlight, 2, 1), 0);
  }
}

TEST(SunHighlight, NeverMoreThanStrengthTimesSun) {
  const Size size{40, 30};
  test::Noise noise(size);
  noise.look.of<SunHighlight>() = {SunHighlight::Model::kBlinnPhong, 20, 2};
  const test::Picture got = noise.wet();
  double most = 0;
  each_wet(got, size, [&](int x, int y) {
    const double glint = got.aov(Aov::kHighlight, x, y);
    EXPECT_GE(glint, 0);
    EXPECT_LE(glint, 6 + 1e-5);
    most = std::max(most, glint);
  });
  EXPECT_GT(most, 1);
}

}  // namespace
}  // namespace limpid
