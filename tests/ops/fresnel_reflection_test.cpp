#include "limpid/ops/fresnel_reflection.h"

#include "ops/tray.h"

namespace limpid {
namespace {

using test::Tray;
using Reflectance = FresnelReflection::Reflectance;

/// Bottom 0.5, mirrored 2; the viewer is straight up.
Tray mirror_tray(Vec3<double> normal = {0, 1, 0}) {
  Tray tray({10, 10});
  for (int c = 0; c < 3; ++c) tray.buffers.fill(plane_after(PlaneId::kReflectionR, c), 2);
  tray.buffers.normal(normal);
  return tray;
}

const Vec3<double> kSixtyDegrees{std::sqrt(0.75), 0.5, 0};

TEST(FresnelReflection, HandWorkedFromStraightAbove) {
  // F0 = (.333 / 2.333)^2 = .020373
  const test::Picture got = mirror_tray().wet();
  EXPECT_NEAR(got.aov(Aov::kFresnel, 3, 3), 0.020373, 1e-6);
  EXPECT_NEAR(got.aov(Aov::kReflected, 3, 3), 0.040746, 2e-6);
  EXPECT_NEAR(got.aov(Aov::kTransmitted, 3, 3), 0.489813, 1e-6);
  EXPECT_NEAR(got.color(3, 3).g, 0.530560, 2e-6);
}

TEST(FresnelReflection, ModelsAtSixtyDegrees) {
  struct Row {
    Reflectance model;
    double value;
  };
  for (const Row& row : {Row{Reflectance::kExact, .0597}, Row{Reflectance::kSchlick, .0510},
                         Row{Reflectance::kRim, .1250}}) {
    Tray tray = mirror_tray(kSixtyDegrees);
    tray.look.of<FresnelReflection>().reflectance = row.model;
    const test::Picture got = tray.wet();
    EXPECT_NEAR(got.aov(Aov::kFresnel, 4, 4), row.value, 5e-5);
    EXPECT_NEAR(got.color(4, 4).r, lerp(0.5, 2.0, row.value), 2e-4);
  }
}

TEST(FresnelReflection, RimOfCalmWaterFromAboveShowsNoMirror) {
  Tray tray = mirror_tray();
  tray.look.of<FresnelReflection>().reflectance = Reflectance::kRim;
  EXPECT_EQ(tray.wet().aov(Aov::kReflected, 3, 3), 0);
  EXPECT_EQ(tray.wet().color(3, 3).r, 0.5);
}

TEST(FresnelReflection, RimPowerZeroAndGrazingNormalsAreAllMirror) {
  Tray tray = mirror_tray();
  tray.look.of<FresnelReflection>().reflectance = Reflectance::kRim;
  tray.look.of<FresnelReflection>().power = 0;
  EXPECT_NEAR(tray.wet().color(3, 3).r, 2, 1e-6);
  Tray grazing = mirror_tray({1, 0, 0});
  grazing.look.of<FresnelReflection>().strength = 0;
  EXPECT_NEAR(grazing.wet().color(3, 3).r, 2, 1e-6);
}

TEST(FresnelReflection, IndexOfTheWaterIsTaken) {
  Tray tray = mirror_tray();
  tray.look.water.ior = 1.5;
  EXPECT_NEAR(tray.wet().aov(Aov::kFresnel, 3, 3), 0.04, 1e-6);
  tray.look.water.ior = 1;
  EXPECT_NEAR(tray.wet().aov(Aov::kFresnel, 3, 3), 0, 1e-6);
}

// Tilt .6 x strength 1/6 on ten pixels: one to the right; half as much: bilinear; clamped at the
// edge.
TEST(FresnelReflection, LookupFollowsTheTilt) {
  Tray tray = mirror_tray({0.6, 0.8, 0});
  tray.buffers.set(PlaneId::kReflectionR, [](int x, int) { return float(x); });
  const auto mirrored = [&](double strength, int x) {
    tray.look.of<FresnelReflection>().strength = strength;
    const test::Picture got = tray.wet();
    return got.aov(Aov::kReflected, x, 5) / got.aov(Aov::kFresnel, x, 5);
  };
  EXPECT_NEAR(mirrored(0, 3), 3, 1e-5);
  EXPECT_NEAR(mirrored(1.0 / 6, 3), 4, 1e-5);
  EXPECT_NEAR(mirrored(0.5 / 6, 3), 3.5, 1e-5);
  EXPECT_NEAR(mirrored(-1.0 / 6, 3), 2, 1e-5);
  EXPECT_NEAR(mirrored(1.0 / 6, 9), 9, 1e-5);
  EXPECT_NEAR(mirrored(-10, 5), 0, 1e-5);
}

// All that comes from below the surface is dimmed by 1 - F, the light of the water too.
TEST(FresnelReflection, DimsTheFogAsItDimsTheBottom) {
  Tray tray = mirror_tray(kSixtyDegrees);
  tray.look.of<DepthFog>() = test::plain_fog(DepthFog::Model::kLinear);
  const test::Picture mirrored = tray.wet();
  for (int c = 0; c < 3; ++c) tray.buffers.frame.planes[index_of(PlaneId::kReflectionR) + c] = {};
  const test::Picture plain = tray.wet();
  for (Aov term : {Aov::kTransmitted, Aov::kInScatter}) {
    EXPECT_GT(plain.aov(term, 4, 4), 0);
    EXPECT_NEAR(mirrored.aov(term, 4, 4) / plain.aov(term, 4, 4), 1 - .0597, 5e-5);
  }
}

TEST(FresnelReflection, IsABlend) {
  const Size size{40, 30};
  test::Noise noise(size);
  for (int c = 0; c < 3; ++c) {
    noise.buffers.set(plane_after(PlaneId::kReflectionR, c),
                      [=](int x, int y) { return 3 * test::noise(x, y, 70 + c); });
  }
  noise.look.of<FresnelReflection>().strength = 0;
  const test::Picture got = noise.wet();
  each_wet(got, size, [&](int x, int y) {
    const double f = got.aov(Aov::kFresnel, x, y);
    EXPECT_GE(f, 0.0203);
    EXPECT_LE(f, 1);
    const double under = noise.buffers.frame.plane(PlaneId::kColorB).at(x, y);
    const double mirrored = noise.buffers.frame.plane(PlaneId::kReflectionB).at(x, y);
    EXPECT_NEAR(got.color(x, y).b, lerp(under, mirrored, f), 1e-6);
  });
}

}  // namespace
}  // namespace limpid
