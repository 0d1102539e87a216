#include "limpid/ops/sun_highlight.h"

#include "ops/sun_highlight_kernel.h"
#include "ops/tray.h"

namespace limpid {
namespace {

using test::Tray;

/// Sun 30 degrees from straight up towards +x, color (3, 2, 1); the viewer straight up; calm water.
Tray sunny_tray() {
  Tray tray({6, 4});
  tray.scene.sun = Sun{{0.5, std::sqrt(0.75), 0}, {3, 2, 1}};
  tray.look.of<SunHighlight>() = {.model = SunHighlight::Model::kBlinnPhong};
  return tray;
}

/// Leaning towards the sun by 15 degrees: the half vector.
Vec3<double> half_way() {
  const double angle = std::numbers::pi / 12;
  return {std::sin(angle), std::cos(angle), 0};
}

TEST(SunHighlight, OfSlopesAloneLooksBesideThePixel) {
  for (const auto model :
       {SunHighlight::Model::kPhong, SunHighlight::Model::kBlinnPhong, SunHighlight::Model::kGgx}) {
    EXPECT_EQ(Kernel<SunHighlight>::reach({.model = model}), 0);
  }
  EXPECT_EQ(Kernel<SunHighlight>::reach({.model = SunHighlight::Model::kSlopes}), HUGE_VAL);
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
    test::expect_rgb(got.color(2, 2), {3.5, 2.5, 1.5}, 1e-4);  // added, not clamped
  }
}

// Phong's lobes meet their bound there; GGX is brighter than these lobes by orders of magnitude.
TEST(SunHighlight, NoGlintIsBrighterThanItsBound) {
  Tray tray = sunny_tray();
  tray.buffers.normal(half_way());
  const Pass pass(tray.scene, tray.buffers.frame, 1.333, {});
  SunHighlight::Params& params = tray.look.of<SunHighlight>();
  const auto glint = [&] { return tray.wet().aov(Aov::kHighlight, 2, 2); };
  const auto bound = [&] { return Kernel<SunHighlight>::bound(params, pass, {}); };
  for (auto model : {SunHighlight::Model::kPhong, SunHighlight::Model::kBlinnPhong}) {
    params = {.model = model};
    EXPECT_NEAR(glint(), bound(), 1e-4);
  }
  params = {.model = SunHighlight::Model::kGgx, .roughness = 0.01};
  EXPECT_GT(glint(), 100);
  EXPECT_LE(glint(), bound());
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

constexpr SunHighlight::Model kModels[] = {
    SunHighlight::Model::kPhong, SunHighlight::Model::kBlinnPhong, SunHighlight::Model::kGgx};

// The shadow that fell on the surface is better than the one on the bottom seen through it.
/// The half vector of a sun under the horizon may still lean upwards.
TEST(SunHighlight, FacetsThatFaceAwayDoNotGlint) {
  Tray tray = sunny_tray();
  for (auto model :
       {SunHighlight::Model::kPhong, SunHighlight::Model::kBlinnPhong, SunHighlight::Model::kGgx}) {
    tray.look.of<SunHighlight>() = {.model = model, .power = 2, .roughness = 0.5};
    tray.scene.sun->direction = {0.995, std::sqrt(1 - 0.995 * 0.995), 0};
    EXPECT_GT(tray.wet().aov(Aov::kHighlight, 2, 2), 0);
    tray.scene.sun->direction.y *= -1;
    EXPECT_EQ(tray.wet().aov(Aov::kHighlight, 2, 2), 0);
    // But a facet that leans towards the sun glints.
    tray.buffers.normal({std::sqrt(0.5), std::sqrt(0.5), 0});
    EXPECT_GT(tray.wet().aov(Aov::kHighlight, 2, 2), 0);
    tray.buffers.normal({0, 1, 0});
  }
}

TEST(SunHighlight, ShadowOfTheSurfacePointWhereThereIsOne) {
  for (auto model : kModels) {
    Tray tray = sunny_tray();
    tray.buffers.normal(half_way());
    tray.look.of<SunHighlight>().model = model;
    const double lit = tray.wet().aov(Aov::kHighlight, 2, 1);
    EXPECT_GT(lit, 1);
    tray.buffers.fill(PlaneId::kShadow, 0);
    EXPECT_EQ(tray.wet().aov(Aov::kHighlight, 2, 1), 0);
    tray.buffers.fill(PlaneId::kSurfaceShadow, 0.25f);
    EXPECT_NEAR(tray.wet().aov(Aov::kHighlight, 2, 1), 0.25 * lit, 1e-6 * lit);
  }
}

// A camera below the surface that looks up at it: no glint, whatever the normals.
TEST(SunHighlight, NoneFromBelow) {
  for (auto model : kModels) {
    Tray tray = sunny_tray();
    tray.buffers.normal(half_way());
    tray.look.of<SunHighlight>().model = model;
    tray.scene.camera->projection = perspective(1, 1, 0.1, 100, ClipSpace::kGl);
    EXPECT_GT(tray.wet().aov(Aov::kHighlight, 3, 2), 0);
    tray.scene.camera->view =
        glm::lookAt(glm::dvec3(0, -10, 0), glm::dvec3(0, 0, 0), glm::dvec3(0, 0, -1));
    for (const auto& picture :
         {tray.wet(), test::fused(tray.look, tray.buffers.frame, tray.scene)}) {
      EXPECT_FALSE(std::isinf(picture.aov(Aov::kSurfaceDepth, 3, 2)));
      EXPECT_EQ(picture.aov(Aov::kHighlight, 3, 2), 0);
    }
  }
}

// alpha 0.2, half vector at 15 degrees, viewer straight above, light at 30: density .04 / (pi
// (cos(15)^2 (.04 - 1) + 1)^2) = 1.1702, visibility .5 / (cos(30) + sqrt(.75 * .96 + .04)) =
// .28772, N.L .86603, reflectance of 15 degrees .020428: .0059567 / sr, times pi and the color.
TEST(SunHighlight, GgxByHand) {
  Tray tray = sunny_tray();
  tray.look.of<SunHighlight>() = {SunHighlight::Model::kGgx, 200, 1, 0.2};
  const double lobe = 0.0059567;
  const Rgb<double> sun{3 * std::numbers::pi, 2 * std::numbers::pi, std::numbers::pi};
  test::expect_rgb(rgb_of(tray.wet(), Aov::kHighlight, 2, 2), lobe * sun, 1e-6);
}

// Water as smooth as can be shows the disc: the reflectance of 15 degrees times the irradiance over
// the solid angle, pi 3 / 6.794e-5. Twice the strength is twice that.
TEST(SunHighlight, GgxIsNoBrighterThanTheMirroredSun) {
  Tray tray = sunny_tray();
  tray.buffers.normal(half_way());
  tray.look.of<SunHighlight>() = {SunHighlight::Model::kGgx, 200, 1, 0.001};
  const double disc = std::numbers::pi * 3 / 6.794e-5;
  const double glint = tray.wet().aov(Aov::kHighlight, 2, 2);
  EXPECT_NEAR(glint / disc, 0.020428, 1e-6);
  tray.look.of<SunHighlight>().strength = 2;
  EXPECT_NEAR(tray.wet().aov(Aov::kHighlight, 2, 2), 2 * glint, 1e-3);
  // Anywhere, at any roughness: at most the whole disc.
  const Size size{40, 30};
  test::Noise noise(size);
  for (double roughness : {0.001, 0.01, 0.1, 1.0}) {
    noise.look.of<SunHighlight>() = {SunHighlight::Model::kGgx, 200, 1, roughness};
    const test::Picture got = noise.wet();
    each_wet(got, size, [&](int x, int y) {
      EXPECT_GE(got.aov(Aov::kHighlight, x, y), 0);
      EXPECT_LE(got.aov(Aov::kHighlight, x, y), disc);
    });
  }
}

// Unlike the articles' lobes, a rougher sea is duller in the mirror direction and brighter beside
// it.
TEST(SunHighlight, GgxSpreadsTheSameLight) {
  Tray tray = sunny_tray();
  const auto glint = [&](Vec3<double> normal, double roughness) {
    tray.buffers.normal(normal);
    tray.look.of<SunHighlight>() = {SunHighlight::Model::kGgx, 200, 1, roughness};
    return tray.wet().aov(Aov::kHighlight, 2, 2);
  };
  EXPECT_GT(glint(half_way(), 0.02), 3 * glint(half_way(), 0.04));
  EXPECT_LT(glint({0, 1, 0}, 0.02), glint({0, 1, 0}, 0.04) / 3);
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
