#include <cmath>
#include <utility>

#include "ops/fresnel_reflection_kernel.h"
#include "ops/probe_strip.h"
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
  tray.look.of<FresnelReflection>().lookup = FresnelReflection::Lookup::kOffset;
  return tray;
}

/// One pixel that looks along its axis, at this angle in degrees from straight down (from straight
/// up with the camera below the surface); white light comes through the surface and white light is
/// mirrored.
struct Glance {
  Glance(double degrees, double height) : buffers(rect_of({1, 1})) {
    const double angle = degrees * std::numbers::pi / 180;
    const glm::dvec3 eye(0, height, 0);
    const glm::dvec3 along(std::sin(angle), height > 0 ? -std::cos(angle) : std::cos(angle), 0);
    Camera camera;
    camera.view = glm::lookAt(eye, eye + along, glm::dvec3(0, 0, 1));
    camera.projection = perspective(0.01, 1, 0.1, 1e3, ClipSpace::kGl);
    scene.camera = camera;
    scene.water = WaterPlane{};
    for (int c = 0; c < 3; ++c) buffers.fill(plane_after(PlaneId::kColorR, c), 1);
    buffers.fill(PlaneId::kDepth, 900);
    look.of<FresnelReflection>().source = FresnelReflection::Source::kConstant;
    look.of<FresnelReflection>().color = {1, 1, 1};
  }
  test::Picture wet() const { return test::reference(look, buffers.frame, scene); }
  double fresnel() const { return wet().aov(Aov::kFresnel, 0, 0); }

  test::Buffers buffers;
  Scene scene;
  Look look = test::still_look();
};

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
                         Row{Reflectance::kRim, .1250}, Row{Reflectance::kInversePower, .8750},
                         Row{Reflectance::kLinear, 0}}) {
    Tray tray = mirror_tray(kSixtyDegrees);
    tray.look.of<FresnelReflection>().reflectance = row.model;
    const test::Picture got = tray.wet();
    EXPECT_NEAR(got.aov(Aov::kFresnel, 4, 4), row.value, 5e-5);
    EXPECT_NEAR(got.color(4, 4).r, lerp(0.5, 2.0, row.value), 2e-4);
  }
}

// 1 - .5 (cos 60)^2 of the normal; 1 - cos 60 of the calm surface, whatever the normal.
TEST(FresnelReflection, ParametersOfTheArticles) {
  Tray tray = mirror_tray(kSixtyDegrees);
  FresnelReflection::Params& params = tray.look.of<FresnelReflection>();
  params.reflectance = Reflectance::kInversePower;
  params.intensity = 0.5;
  params.power = 2;
  EXPECT_NEAR(tray.wet().aov(Aov::kFresnel, 4, 4), .875, 1e-6);
  params.intensity = 100;
  EXPECT_EQ(tray.wet().aov(Aov::kFresnel, 4, 4), 0);
  for (const Vec3<double>& normal : {Vec3<double>{0, 1, 0}, kSixtyDegrees}) {
    Glance glance(60, 3);
    glance.buffers.normal(normal);
    glance.look.of<FresnelReflection>().reflectance = Reflectance::kLinear;
    EXPECT_NEAR(glance.fresnel(), 0.5, 1e-6);
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

// All light from below the surface is dimmed by 1 - F, the light of the water too.
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
  noise.buffers.fill(PlaneId::kReflectionValid, 1);
  noise.look.of<FresnelReflection>().lookup = FresnelReflection::Lookup::kOffset;
  noise.look.of<FresnelReflection>().strength = 0;
  const test::Picture got = noise.wet();
  each_wet(got, size, [&](int x, int y) {
    const double f = got.aov(Aov::kFresnel, x, y);
    EXPECT_GE(f, 0.0203);
    EXPECT_LE(f, 1);
    const bool hit = std::isfinite(noise.buffers.frame.plane(PlaneId::kDepth).at(x, y));
    const double under = hit ? noise.buffers.frame.plane(PlaneId::kColorB).at(x, y) : 0;
    const double mirrored = noise.buffers.frame.plane(PlaneId::kReflectionB).at(x, y);
    EXPECT_NEAR(got.aov(Aov::kTransmitted, x, y, 2), (1 - f) * under, 1e-6);
    EXPECT_NEAR(got.aov(Aov::kReflected, x, y, 2), f * mirrored, 1e-6);
    EXPECT_NEAR(got.color(x, y).b, lerp(under, mirrored, f), 1e-6);
  });
}

// White below and white around: the surface is invisible.
TEST(FresnelReflection, WhiteFurnace) {
  const Size size{40, 30};
  test::Noise noise(size);
  for (int c = 0; c < 3; ++c) noise.buffers.fill(plane_after(PlaneId::kColorR, c), 1);
  noise.buffers.fill(PlaneId::kDepth, 1e6f);
  const float one = 1;
  for (View<const float>& view : noise.buffers.frame.environment.channels)
    view = {&one, 0, 0, {0, 0, 8, 4}};
  FresnelReflection::Params& params = noise.look.of<FresnelReflection>();
  params.source = FresnelReflection::Source::kEnvironment;
  for (Reflectance model : {Reflectance::kRim, Reflectance::kLinear, Reflectance::kInversePower,
                            Reflectance::kSchlick, Reflectance::kExact}) {
    params.reflectance = model;
    const test::Picture exact = noise.wet();
    const test::Picture fast = test::fused(noise.look, noise.buffers.frame, noise.scene);
    each_wet(exact, size, [&](int x, int y) {
      const double f = exact.aov(Aov::kFresnel, x, y);
      EXPECT_TRUE(f >= 0 && f <= 1) << f;
      test::expect_rgb(exact.color(x, y), {1, 1, 1}, 1e-7);
      test::expect_rgb(fast.color(x, y), {1, 1, 1}, 3e-7);
    });
  }
}

// --- from below ---------------------------------------------------------------------------------

// sin t = 1.333 / 2; s: ((1.333 cos 30 - cos t) / (1.333 cos 30 + cos t))^2 = .04632, p: .00472.
TEST(FresnelReflection, ExactFromBelowWhateverTheModel) {
  for (Reflectance model : {Reflectance::kRim, Reflectance::kLinear, Reflectance::kInversePower,
                            Reflectance::kSchlick, Reflectance::kExact}) {
    for (const auto& [degrees, expected] : {std::pair{30., .02552}, {48.7, 1.}, {80., 1.}}) {
      Glance glance(degrees, -2);
      glance.look.of<FresnelReflection>().reflectance = model;
      EXPECT_NEAR(glance.fresnel(), expected, 1e-5) << degrees;
    }
  }
  EXPECT_LT(Glance(48.5, -2).fresnel(), 0.8);
}

TEST(FresnelReflection, SameFromBothSidesAlongOnePath) {
  for (double above : {0.0, 20.0, 45.0, 60.0, 80.0}) {
    const double degree = std::numbers::pi / 180;
    const double below = std::asin(std::sin(above * degree) / 1.333) / degree;
    EXPECT_NEAR(Glance(above, 3).fresnel(), Glance(below, -2).fresnel(), 1e-5) << above;
  }
}

TEST(FresnelReflection, LosesNothingFromBelow) {
  for (double degrees : {0.0, 30.0, 45.0, 70.0}) {
    const Glance glance(degrees, -2);
    test::expect_rgb(glance.wet().color(0, 0), {1, 1, 1});
    // The same without a reader of the fog's transmittance: the fog, which changes nothing, does
    // not run.
    const test::Picture bare(rect_of({1, 1}));
    Target target = bare.target;
    target.aovs = {};
    const Frame& frame = glance.buffers.frame;
    const Plan plan = make_plan(glance.look, test::inputs_of(frame, glance.scene));
    EXPECT_FALSE(plan.keeps<DepthFog>());
    run_reference(plan, frame, glance.scene, target);
    test::expect_rgb(bare.color(0, 0), {1, 1, 1});
  }
}

// The water between the viewer and the surface was applied before: this water dims the mirror too,
// and the surface does not dim this water's light.
TEST(FresnelReflection, TheWaterInFrontOfTheUndersideStaysInFront) {
  const Glance glance(0, -2);
  FresnelReflection::Params params = glance.look.of<FresnelReflection>();
  params.color = {4, 4, 4};
  const Pass pass(glance.scene, glance.buffers.frame, 1.333, {});
  ASSERT_TRUE(pass.submersible);
  test::ProbeStrip strip;
  for (double side : {-1.0, 0.0, 1.0}) {
    Pixel<double> p = test::random_pixel(1, {});
    p.to_viewer = {0, side < 0 ? -1.0 : 1.0, 0};
    p.side = side;
    p.transmittance = {0.5, 0.25, 0.125};
    p.transmitted = {0.6, 0.6, 0.6};
    p.in_scatter = {0.3, 0.3, 0.3};
    strip.pixels.push_back(p);
  }
  Kernel<FresnelReflection>::apply(params, pass, strip);
  const double f = 0.0203731, t = 0.6 * (1 - f), s = 0.3 * (1 - f);
  const Pixel<double>&below = strip.pixels[0], &within = strip.pixels[1], &above = strip.pixels[2];
  test::expect_rgb(below.transmitted, {t, t, t});
  test::expect_rgb(below.in_scatter, {0.3, 0.3, 0.3});
  test::expect_rgb(below.reflected, {2 * f, f, f / 2});
  EXPECT_EQ(within.fresnel, 0);
  test::expect_rgb(within.transmitted, {0.6, 0.6, 0.6}, 0);
  test::expect_rgb(within.in_scatter, {0.3, 0.3, 0.3}, 0);
  test::expect_rgb(within.reflected, {0, 0, 0}, 0);
  test::expect_rgb(above.transmitted, {t, t, t});
  test::expect_rgb(above.in_scatter, {s, s, s});
  test::expect_rgb(above.reflected, {4 * f, 4 * f, 4 * f});
}

// The mirror planes belong to the eye's side of the surface, here under water. A pixel that begins
// on the other side mirrors its own picture instead.
TEST(FresnelReflection, PlanesAreOfTheSideOnWhichTheEyeIs) {
  Glance glance(0, -2);
  for (int c = 0; c < 3; ++c) glance.buffers.fill(plane_after(PlaneId::kReflectionR, c), 2);
  FresnelReflection::Params& params = glance.look.of<FresnelReflection>();
  params.source = FresnelReflection::Source::kPlanar;
  const Pass pass(glance.scene, glance.buffers.frame, 1.333, {});
  ASSERT_TRUE(pass.submersible);
  for (const auto lookup : {FresnelReflection::Lookup::kOffset, FresnelReflection::Lookup::kRay}) {
    params.lookup = lookup;
    test::ProbeStrip strip;
    Pixel<double> p = test::random_pixel(1, {});
    p.to_viewer = {0, 1, 0};
    p.transmitted = {0.1, 0.2, 0.3};
    strip.pixels.push_back(p);
    Kernel<FresnelReflection>::apply(params, pass, strip);
    const Pixel<double>& above = strip.pixels[0];
    EXPECT_GT(above.fresnel, 0.02);
    test::expect_rgb(above.reflected,
                     {0.1 * above.fresnel, 0.2 * above.fresnel, 0.3 * above.fresnel}, 1e-9);
  }
}

}  // namespace
}  // namespace limpid
