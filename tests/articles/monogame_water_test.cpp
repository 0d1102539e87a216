#include "articles/article.h"
#include "optics/fresnel.h"
#include "raster/mirror.h"

/// "How to create Water shader in Monogame XNA": planes clipped at the water, a DuDv map looked up
/// in two steps, linear Fresnel, normal map and Blinn-Phong.

namespace limpid {
namespace {

using test::expect_rgb;
using test::expect_shift;
using test::expect_vector;
using test::normal_at;
using test::shift_at;
using test::TexelMap;
using test::Tray;

constexpr Size kEight{8, 8};

Tray monogame_tray() {
  Tray tray(kEight);
  tray.look = test::look_of_article("monogame");
  tray.look.of<WaveNormals>().tile_size = 8;
  tray.look.of<WaveNormals>().speed = 0.4;  // the look's 0.05 periods a second
  fill_places(tray.buffers, PlaneId::kColorR);
  return tray;
}

/// Red a tenth of the texel's x, green of its y, blue .9.
TexelMap ramps() {
  return TexelMap([](int x, int y) { return Rgb<double>{x / 10.0, y / 10.0, 0.9}; });
}

/// A map whose distortion is (.5, -.5) everywhere.
TexelMap flat_map() { return TexelMap(Rgb<double>{0.75, 0.25, 0.9}); }

// distorted = tex(u + move, v) * .01; distorted = uv + (distorted.x, distorted.y + move); total =
// tex(distorted).rg * 2 - 1. At the texel (2, 2), move 0: .01 (.2, .2) periods = (.016, .016)
// texels; the second lookup reads (.2016, .2016), total (-.5968, -.5968).
//
// refractionTex = uv - .001 / z + total * .01. Depth 10 between .1 and 100, orthographic: z = 9.9 /
// 99.9, .001 / z = .0100909. So both shifts are -.0100909 - .005968 = -.0160589 of the picture,
// -.1284713 pixels.
TEST(MonogameWater, TwoStepDistortion) {
  const TexelMap map = ramps();
  Tray tray = monogame_tray();
  tray.buffers.frame.wave_map = map.texture;
  const test::Picture got = tray.wet();
  expect_shift(shift_at(got, Aov::kStmapG, 6, 1, kEight), {-0.1284713, -0.1284713});
  // Straight down the surface mirrors no light: the dry picture unchanged at the shifted position.
  expect_rgb(got.color(6, 1), {5.8715287, 0.8715287, 5.8715287}, 1e-5);
}

// After 2.5 s move is .125 periods, a texel. First lookup (3, 2): .01 (.3, .2) periods = (.024,
// .016) texels; second (2.024, 3.016): (.2024, .3016), total (-.5952, -.3968). Shifts -.0100909 -
// .005952 and -.0100909 - .003968, times 8 pixels.
TEST(MonogameWater, TheDistortionMoves) {
  const TexelMap map = ramps();
  Tray tray = monogame_tray();
  tray.buffers.frame.wave_map = map.texture;
  tray.scene.time = 2.5;
  expect_shift(shift_at(tray.wet(), Aov::kStmapG, 6, 1, kEight), {-0.1283433, -0.1124713});
}

// normal = normalize(2 r - 1, b, 2 g - 1) at the distorted place: (-.5968, .9, .5968) / 1.2338298.
// Kept: blue is not decoded, .9 instead of .8. Departs: the article puts green along +z, which is
// right for only one layout of a quad; here green runs along the map's own v, which is -z.
TEST(MonogameWater, NormalMap) {
  const TexelMap map = ramps();
  Tray tray = monogame_tray();
  tray.buffers.frame.wave_map = map.texture;
  expect_vector(normal_at(tray.wet(), 6, 1), {-0.4836965, 0.7294350, 0.4836965});
}

// Kept: the article calls .001 / z a bend that grows with distance, but .001 / z shrinks: calm
// water at depth 50 (z = 49.9 / 99.9) shifts by .0020020 instead of .0100909, to the upper left
// whatever lies below.
TEST(MonogameWater, TheShiftByDistanceShrinks) {
  const TexelMap calm(Rgb<double>{0.5, 0.5, 1});
  Tray tray = monogame_tray();
  tray.buffers.frame.wave_map = calm.texture;
  expect_shift(shift_at(tray.wet(), Aov::kStmapG, 6, 1, kEight), {-0.0807273, -0.0807273});
  tray.buffers.fill(PlaneId::kSurfaceDepth, 50).fill(PlaneId::kDepth, 60);
  expect_shift(shift_at(tray.wet(), Aov::kStmapG, 6, 1, kEight), {-0.0160160, -0.0160160});
  // Departs: at the near plane, z = 0, the article divides by 0; here z is at least .01.
  tray.buffers.fill(PlaneId::kSurfaceDepth, 0.1f);
  expect_shift(shift_at(tray.wet(), Aov::kStmapG, 6, 1, kEight), {-0.8, -0.8});
}

// _refractionClippingPlane: the refraction is drawn without the objects above the water, so a pole
// in front of the water is never refracted, though no lookup is rejected on screen.
TEST(MonogameWater, RefractionIsThatBelowTheWater) {
  const TexelMap map = flat_map();
  Tray tray = monogame_tray();
  tray.buffers.frame.wave_map = map.texture;
  for (int c = 0; c < 3; ++c) {
    tray.buffers.fill(plane_after(PlaneId::kColorR, c), 7);
    tray.buffers.fill(plane_after(PlaneId::kBelowR, c), 0.25f);
  }
  expect_rgb(tray.wet().color(6, 1), {7, 7, 7}, 1e-6);
  tray.buffers.fill(PlaneId::kBelowDepth, 14);
  expect_rgb(tray.wet().color(6, 1), {0.25, 0.25, 0.25}, 1e-6);
  // Kept: without that layer the pole is refracted. At 40 times the strength .4 (.5, -.5) 8 = (1.6,
  // -1.6) pixels less .0807 lead there from (3, 3).
  Tray without = monogame_tray();
  without.buffers.frame.wave_map = map.texture;
  without.look.of<Refraction>().strength = 0.4;
  without.buffers.set(PlaneId::kDepth, [](int x, int) { return x < 5 ? 14.f : 8.f; });
  expect_shift(shift_at(without.wet(), Aov::kStmapG, 3, 3, kEight), {1.5192727, -1.6807273});
}

// lerp(reflection, refraction, V.n of the quad): V.up = .6, so .4 of the mirror whatever the map's
// normal. The mirror is distorted as well: .01 (.5, -.5) of the picture, .04 pixels.
TEST(MonogameWater, LinearFresnelOfTheCalmNormal) {
  const TexelMap map = flat_map();
  Tray tray = monogame_tray();
  tray.buffers.frame.wave_map = map.texture;
  look_aslant(tray);
  fill_places(tray.buffers, PlaneId::kReflectionR);
  const test::Picture got = tray.wet();
  EXPECT_NEAR(got.aov(Aov::kFresnel, 6, 1), 0.4, 1e-6);
  // Departs: without the article's + .001 / z, .0807 pixels more here: the lookup of a flat mirror
  // is at the pixel itself.
  expect_rgb(rgb_of(got, Aov::kReflected, 6, 1), {0.4 * 6.04, 0.4 * 0.96, 0.4 * 6.04}, 1e-5);
  // The refraction: (.04 - .0807273, -.04 - .0807273) pixels.
  expect_rgb(rgb_of(got, Aov::kTransmitted, 6, 1),
             {0.6 * 5.9592727, 0.6 * 0.8792727, 0.6 * 5.9592727}, 1e-5);
}

// Kept: no reflection at normal incidence, where water mirrors .02. Departs: seen from behind, V.n
// = -.5, the article's 1 - V.n would be 1.5.
TEST(MonogameWater, LinearFresnelAtItsEnds) {
  EXPECT_EQ(fresnel_linear(1.0), 0);
  EXPECT_EQ(fresnel_linear(-0.5), 1);
}

// sign(N.L) KSpecular LightColor pow(N.H, 25), KSpecular .3: V = (0, 1, 0), L = (.8, .6, 0), H =
// (1, 2, 0) / sqrt(5), N.H^2 = .8, .8^12.5 = .0614646.
TEST(MonogameWater, BlinnPhong) {
  const TexelMap calm(Rgb<double>{0.5, 0.5, 1});
  Tray tray = monogame_tray();
  tray.buffers.frame.wave_map = calm.texture;
  tray.scene.sun = Sun{{0.8, 0.6, 0}, {1, 2, 0.5}};
  expect_rgb(rgb_of(tray.wet(), Aov::kHighlight, 6, 1), {0.0184394, 0.0368787, 0.0092197}, 1e-6);
  // sign(0) is 0, without which it would be .3 2^-12.5 = 5.179e-5.
  tray.scene.sun = Sun{{1, 0, 0}, {1, 1, 1}};
  EXPECT_EQ(tray.wet().aov(Aov::kHighlight, 6, 1), 0);
  // Departs: below the horizon the article's glint takes light away.
  tray.scene.sun = Sun{{0.96, -0.28, 0}, {1, 1, 1}};
  EXPECT_EQ(tray.wet().aov(Aov::kHighlight, 6, 1), 0);
}

// The whole look at one pixel: V = (0, .6, .8), L = (0, .6, -.8), so H is up. The map's normal (.5,
// .9, .5) / 1.1445523 has N.H = .7863337, ^25 = .0024557. .6 of the refraction, .4 of the mirror,
// on top of them .3 .0024557 of a sun of 1000, not clamped.
TEST(MonogameWater, AllOfIt) {
  const TexelMap map = flat_map();
  Tray tray = monogame_tray();
  tray.buffers.frame.wave_map = map.texture;
  look_aslant(tray);
  fill_places(tray.buffers, PlaneId::kReflectionR);
  tray.scene.sun = Sun{{0, 0.6, -0.8}, {1000, 1000, 1000}};
  const double glint = 300 * 0.0024557;
  expect_rgb(tray.wet().color(6, 1),
             {0.6 * 5.9592727 + 0.4 * 6.04 + glint, 0.6 * 0.8792727 + 0.4 * 0.96 + glint,
              0.6 * 5.9592727 + 0.4 * 6.04 + glint},
             5e-5);
}

/// The article's camera at (0, 50, 300), leant down by the angle whose sine is .6.
Camera article_camera() {
  Camera camera;
  camera.view =
      glm::lookAt(glm::dvec3(0, 50, 300), glm::dvec3(0, 50 - 6, 300 - 8), glm::dvec3(0, 1, 0));
  camera.projection = perspective(1.0, 1.5, 0.1, 1000, ClipSpace::kGl);
  return camera;
}

// position - 2 N (N.(position - plane)) = (0, -50, 300); Reflect(forward, N) = (0, .6, -.8);
// Reflect(up, N) = (0, -.8, -.6). (10, 20, 200) lies at (10, 70, -100) from there: -56 + 60 = 4 up,
// 42
// + 80 = 122 away, and by CreateLookAt, whose right is forward x up = (-1, 0, 0), at -10.
TEST(MonogameWater, ReflectionCamera) {
  const Camera mirrored = mirrored_camera(article_camera(), WaterPlane{});
  const glm::dvec4 seen = mirrored.view * glm::dvec4(10, 20, 200, 1);
  // Departs: a true mirror keeps right and left. The article's picture is the same picture with its
  // sides swapped; the article swaps them back by projecting the water with that camera.
  EXPECT_NEAR(seen.x, 10, 1e-12);
  EXPECT_NEAR(seen.y, 4, 1e-12);
  EXPECT_NEAR(seen.z, -122, 1e-12);
}

// clip(dot(world, (0, 1, 0, -height))): points above the water stay, points below are cut. Departs:
// the near plane cuts, not each pixel.
TEST(MonogameWater, ReflectionIsClippedAtTheWater) {
  const Camera mirrored = mirrored_camera(article_camera(), WaterPlane{});
  const auto depth = [&](double y) {
    const glm::dvec4 clip = mirrored.projection * mirrored.view * glm::dvec4(10, y, 200, 1);
    EXPECT_GT(clip.w, 0);
    return clip.z / clip.w;
  };
  EXPECT_GT(depth(1), -1);
  EXPECT_LT(depth(-1), -1);
}

}  // namespace
}  // namespace limpid
