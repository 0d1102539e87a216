#include "articles/article.h"
#include "optics/fresnel.h"
#include "optics/waves.h"

/// Rito15's water, a Unity surface shader: two flows of a normal map, a cube map mirrored by the
/// inverse power of V.n, Blinn-Phong, sine waves, penetration.

namespace limpid {
namespace {

using test::expect_rgb;
using test::expect_vector;
using test::normal_at;
using test::TexelMap;
using test::Tray;

constexpr Size kEight{8, 8};

/// Color .5, the surroundings 1 above the horizon and 0 below.
struct RitoTray : Tray {
  RitoTray() : Tray(kEight) {
    look = test::look_of_article("rito");
    look.of<WaveNormals>().tile_size = 8;
    look.of<WaveNormals>().speed = 1;
    surroundings([](int y) { return y < 2 ? 1.f : 0.f; });
  }
  /// Four rows from straight up to straight down, centres at 22.5, 67.5, ... degrees from up.
  template <class Fn>
  void surroundings(Fn&& value) {
    sky = Plane(Rect{0, 0, 8, 4});
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < 8; ++x) sky.view().at(x, y) = value(y);
    }
    for (int c = 0; c < 3; ++c) buffers.frame.environment.channels[c] = sky.view();
  }
  Plane sky;
};

/// Red a tenth of the texel's x, green of its y, blue .9.
TexelMap ramps() {
  return TexelMap([](int x, int y) { return Rgb<double>{x / 10.0, y / 10.0, 0.9}; });
}

// (normal1 + normal2) / 2, normal1 at uv, normal2 at uv / 2 and halved. At the texel (2, 2), 2.5
// texels from the map's corner: normal2 is read 1.25 from it, .75 by centres.
//   normal1 = 2 (.2, .2, .9) - 1       = (-.6, -.6, .8)
//   normal2 = (2 (.075, .075, .9) - 1) / 2 = (-.425, -.425, .4)
//   mean (-.5125, -.5125, .6), in the world (-.5125, .6, .5125)
TEST(RitoUnityWater, TwoFlows) {
  const TexelMap map = ramps();
  RitoTray tray;
  tray.buffers.frame.wave_map = map.texture;
  // Departs: made unit. The article's is .9409 long.
  expect_vector(normal_at(tray.wet(), 6, 1), {-0.5446852, 0.6376802, 0.5446852});
}

// uv + flow and uv / 2 - .3 flow, flow = (-1, 1) / sqrt(2) times time and speed: after sqrt(2) s at
// a texel a second (-1, 1) texels. normal1 at (1, 3), normal2 at (.75 + .3, .75 - .3):
//   ((2 (.1, .3, .9) - 1) + (2 (.105, .045, .9) - 1) / 2) / 2 = (-.5975, -.4275, .6)
TEST(RitoUnityWater, TheFlowsPartFromEachOther) {
  const TexelMap map = ramps();
  RitoTray tray;
  tray.buffers.frame.wave_map = map.texture;
  tray.scene.time = std::sqrt(2.0);
  expect_vector(normal_at(tray.wet(), 6, 1), {-0.6299034, 0.6325390, 0.4506840});
}

// 1 - pow(sat(V.n), 3) * 1: V.n = .6 with calm water seen aslant: 1 - .216 = .784.
TEST(RitoUnityWater, InversePowerFresnel) {
  const TexelMap calm(Rgb<double>{0.5, 0.5, 1});
  RitoTray tray;
  tray.buffers.frame.wave_map = calm.texture;
  look_aslant(tray);
  EXPECT_NEAR(tray.wet().aov(Aov::kFresnel, 3, 3), 0.784, 1e-6);
  // Departs: the article's calm normal is .75 long, so straight down its V.n is .75 and .578 is
  // mirrored; of a unit normal nothing is.
  RitoTray above;
  above.buffers.frame.wave_map = calm.texture;
  EXPECT_NEAR(above.wet().aov(Aov::kFresnel, 3, 3), 0, 1e-6);
  // Kept: less intensity mirrors more, .5 at normal incidence. Departs: not below 0; 1 - 2 would
  // take light away.
  EXPECT_NEAR(fresnel_inverse_power(1.0, 0.5, 3.0), 0.5, 1e-12);
  EXPECT_EQ(fresnel_inverse_power(1.0, 2.0, 3.0), 0);
}

// texCUBE(WorldReflectionVector(n)). The map is 1 up to 22.5 degrees from straight up, 3 at 67.5,
// so 2 at 45. A normal that leans by 22.5 degrees mirrors straight down views to there; V.n =
// .9238795, F = 1 - .7885806 = .2114194. Departs: the article mirrors at the calm normal, so its
// waves never show in the mirrored picture, which would be 1 here.
TEST(RitoUnityWater, SurroundingsAreMirroredAtTheWave) {
  RitoTray tray;
  tray.surroundings([](int y) { return y == 0 ? 1.f : 3.f; });
  tray.buffers.normal({0.3826834, 0.9238795, 0});
  const double a = 0.8;  // penetration, straight down
  EXPECT_NEAR(tray.wet().aov(Aov::kReflected, 3, 3), a * 0.2114194 * 2, 1e-5);
}

// o.Emission = Tint / 2 + reflection * fresnel, without light from below. V.n = .6 calm, white sky.
TEST(RitoUnityWater, TheTintIsAllThatComesFromBelow) {
  const TexelMap calm(Rgb<double>{0.5, 0.5, 1});
  RitoTray tray;
  tray.buffers.frame.wave_map = calm.texture;
  tray.look.of<Penetration>().model = Penetration::Model::kNone;
  look_aslant(tray);
  const test::Picture got = tray.wet();
  expect_rgb(rgb_of(got, Aov::kTransmitted, 3, 3), {0, 0, 0}, 0);
  // Departs: mirrored light does not come from below as well: 1 - .784 of the tint's .005.
  expect_rgb(got.color(3, 3), {0.784, 0.784, 0.784 + 0.216 * 0.005}, 1e-6);
}

// spec = pow(sat(H.n), 300), times 2 and the light's color. V = (0, .6, .8), L = (0, .8, -.6): V +
// L = (0, 1.4, .2), H.n = 1.4 / sqrt(2) = .9899495 with calm water; ^300 = .98^150 = .0482960.
TEST(RitoUnityWater, BlinnPhong) {
  const TexelMap calm(Rgb<double>{0.5, 0.5, 1});
  RitoTray tray;
  tray.buffers.frame.wave_map = calm.texture;
  tray.look.of<Penetration>().model = Penetration::Model::kNone;
  look_aslant(tray);
  tray.scene.sun = Sun{{0, 0.8, -0.6}, {3, 2, 1}};
  expect_rgb(rgb_of(tray.wet(), Aov::kHighlight, 3, 3), {0.2897761, 0.1931841, 0.0965920}, 1e-5);
  // Departs: masked by the sun's shadow, an argument that the article's function does not use.
  tray.buffers.fill(PlaneId::kShadow, 0.5f);
  EXPECT_NEAR(tray.wet().aov(Aov::kHighlight, 3, 3), 0.1448881, 1e-5);
}

// o.Alpha = 1 - pow(sat(V.n0), 5) * .2: .8 straight down, 1 - .2 * .07776 = .984448 at V.n0 = .6;
// the rest is the dry picture, .5. Straight down the surface is the tint, (0, 0, .005).
TEST(RitoUnityWater, Penetration) {
  const TexelMap calm(Rgb<double>{0.5, 0.5, 1});
  RitoTray tray;
  tray.buffers.frame.wave_map = calm.texture;
  expect_rgb(tray.wet().color(3, 3), {0.1, 0.1, 0.1 + 0.8 * 0.005}, 1e-6);
  look_aslant(tray);
  const double red = 0.984448 * 0.784 + 0.015552 * 0.5;
  expect_rgb(tray.wet().color(3, 3), {red, red, red + 0.984448 * 0.216 * 0.005}, 1e-6);
}

// originNormal: the waves do not change the penetration.
TEST(RitoUnityWater, PenetrationGoesByTheCalmNormal) {
  RitoTray tray;
  tray.buffers.normal({0.6, 0.8, 0});
  EXPECT_NEAR(tray.wet().aov(Aov::kTransmitted, 3, 3), 0.2 * 0.5, 1e-6);
}

// Departs: the share of the surface is never below 0. Alpha .1 - .2 = -.1 would show 1.1 of the dry
// picture.
TEST(RitoUnityWater, PenetrationEndsAtTheDryPicture) {
  const TexelMap calm(Rgb<double>{0.5, 0.5, 1});
  RitoTray tray;
  tray.buffers.frame.wave_map = calm.texture;
  tray.look.of<Penetration>().alpha = 0.1;
  expect_rgb(tray.wet().color(3, 3), {0.5, 0.5, 0.5}, 1e-6);
}

// Departs: a glint is blended like the rest. The article adds the glint to alpha, .8 + 1 straight
// down, and so takes away .8 of the light below. H = n = up with the sun overhead: 2 * .8 of the
// sun's color.
TEST(RitoUnityWater, AGlintDoesNotMakeWaterOpaque) {
  const TexelMap calm(Rgb<double>{0.5, 0.5, 1});
  RitoTray tray;
  tray.buffers.frame.wave_map = calm.texture;
  tray.scene.sun = Sun{{0, 1, 0}, {1, 1, 1}};
  const test::Picture got = tray.wet();
  EXPECT_NEAR(got.aov(Aov::kHighlight, 3, 3), 1.6, 1e-4);
  EXPECT_NEAR(got.aov(Aov::kTransmitted, 3, 3), 0.1, 1e-6);
}

/// y = (sin(|u d.x| count + t) + sin(|v d.y| count + t)) height / 2 with count 8, height .1, d =
/// (-1, 1) / sqrt(2), t = 2 time: two sines of amplitude .05 and k = 8 / sqrt(2) that come towards
/// the origin.
const std::vector<SineWave> kArticleWaves = {{0.05, 4 * std::sqrt(2.0), 0, 0, -2},
                                             {0.05, 0, 4 * std::sqrt(2.0), 0, -2}};

// At u = .5, v = .25 after .3 s: .05 (sin(2.8284271 + .6) + sin(1.4142136 + .6)) = .05 (-.2829174 +
// .9032908) = .0310187.
TEST(RitoUnityWater, SineWaves) {
  const WaveHeight wave = wave_height(kArticleWaves, 0.5, 0.25, 0.3);
  EXPECT_NEAR(wave.height, 0.0310187, 1e-7);
  // Departs: the normals go with the waves. The article moves the vertices and leaves the normals
  // upright: slopes .05 k cos(phase), -.2712870 and -.1213476 here.
  EXPECT_NEAR(wave.slope_x, -0.2712870, 1e-6);
  EXPECT_NEAR(wave.slope_y, -0.1213476, 1e-6);
}

// Departs: a wave runs on past u = 0. The article's |u| folds it there: at u = -.5 it has sin(2.83
// + .6) as at .5, here sin(-2.8284271 + .6) = -.7914426.
TEST(RitoUnityWater, SineWavesDoNotFold) {
  const double folded = 0.0310187;
  const double straight = 0.05 * (-0.7914426 + 0.9032908);
  EXPECT_NEAR(wave_height(kArticleWaves, -0.5, 0.25, 0.3).height, straight, 1e-7);
  EXPECT_GT(std::abs(straight - folded), 0.02);
}

}  // namespace
}  // namespace limpid
