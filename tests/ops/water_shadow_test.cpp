#include "op/caustics_table.h"
#include "ops/probe_strip.h"
#include "ops/tray.h"
#include "ops/water_shadow_kernel.h"
#include "plan/surveyed.h"

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
  tray.look.of<DepthFog>() = test::plain_fog(DepthFog::Model::kLinear);
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

// The planner relies on this bound where refraction is left out: the two shadows that differ most
// reach the bound.
TEST(WaterShadow, IsDisplacedByNoMoreThanItsRangeAndByAllOfIt) {
  Tray tray = half_shaded();
  const auto with_shadow = [&](float shadow) {
    tray.buffers.fill(PlaneId::kShadow, shadow);
    return tray.wet().color(2, 1).r;
  };
  Ranges ranges;
  ranges.shadow = {0.2, 0.9};
  ranges.light = 0.5;  // the picture of half_shaded()
  const double bound = Kernel<WaterShadow>::displaced(tray.look.of<WaterShadow>(), ranges);
  EXPECT_NEAR(with_shadow(0.9f) - with_shadow(0.2f), bound, 1e-6);
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

// --- scatter ------------------------------------------------------------------------------------

/// Murky water 4 deep under an overhead sun, in part lit from all around, shadow on the left half.
Tray half_shaded_murk() {
  Tray tray = half_shaded();
  tray.scene.sun = Sun{};
  DepthFog::Params& fog = tray.look.of<DepthFog>();
  fog = test::plain_fog(DepthFog::Model::kBeerLambert);
  fog.absorption = {0, 0, 0};
  fog.anisotropy = 0;
  fog.scattering = {0.5, 0.5, 0.5};
  fog.ambient = {0.25, 0.25, 0.25};
  fog.sunlight = DepthFog::Sunlight::kNone;
  tray.look.of<WaterShadow>() = {.model = WaterShadow::Model::kScatter, .strength = 1};
  return tray;
}

// The sun's part and the ambient part are .25 (1 - e^-2) each; tau = 2 has 1/2 - 1/(e^2 - 1) of the
// sun's at the far end.
constexpr double kPart = 0.2161662;
constexpr double kFar = 0.3434824;

double in_scatter(const Tray& tray, int x) { return tray.wet().aov(Aov::kInScatter, x, 1); }

/// The same as on a host's device, where no completer makes a shadow on the surface.
double in_scatter_of_bottom(const Tray& tray, int x) {
  Plan plan =
      make_plan(tray.look, test::inputs_of(tray.buffers.frame, tray.scene), test::all_state());
  plan.completed = plan.completed - PlaneSet{PlaneId::kSurfaceShadow};
  return test::picture_of(plan, tray.buffers.frame, tray.scene, test::by_reference)
      .aov(Aov::kInScatter, x, 1);
}

TEST(WaterShadow, ScatterTakesTheSunsPartOnly) {
  const Tray tray = half_shaded_murk();
  EXPECT_NEAR(in_scatter(tray, 7), 2 * kPart, 1e-6);
  EXPECT_NEAR(in_scatter(tray, 2), kPart, 1e-6);
  const test::Picture got = tray.wet();
  for (int x : {2, 7}) EXPECT_NEAR(got.aov(Aov::kTransmitted, x, 1), 0.5 * std::exp(-2.0), 1e-6);
}

// A shadow on the surface lies at the entry point of the light that any part of the path scatters:
// straight above, because the sun and the viewer stand there.
TEST(WaterShadow, ScatterKnowsTheSurfaceFromTheBottom) {
  Tray tray = half_shaded_murk();
  tray.buffers.fill(PlaneId::kSurfaceShadow, 1);
  EXPECT_NEAR(in_scatter(tray, 2), 2 * kPart, 1e-6);
  tray.buffers.fill(PlaneId::kSurfaceShadow, 0.25f);
  EXPECT_NEAR(in_scatter(tray, 2), kPart + 0.25 * kPart, 1e-6);
  EXPECT_NEAR(in_scatter(tray, 7), kPart + 0.25 * kPart, 1e-6);
  tray.look.of<WaterShadow>().strength = 0.5;
  EXPECT_NEAR(in_scatter(tray, 7), kPart + 0.625 * kPart, 1e-6);
}

TEST(WaterShadow, ASurfaceShadowAloneIsEnough) {
  Tray tray = half_shaded_murk();
  tray.buffers.frame.planes[index_of(PlaneId::kShadow)] = {};
  tray.buffers.fill(PlaneId::kSurfaceShadow, 0.25f);
  for (const int x : {2, 7}) EXPECT_NEAR(in_scatter(tray, x), kPart + 0.25 * kPart, 1e-6);
}

// The sun 45 degrees over the right: light that is scattered d deep enters d to the right. Shaded
// to the left of column 5; the path is 4 long, and water that scatters little sends as much light
// from each quarter of the path; the quarters' middles lie 0.5, 1.5, 2.5 and 3.5 deep.
TEST(WaterShadow, IsThatOfWhereTheSunlightEntered) {
  Tray tray = half_shaded_murk();
  tray.buffers.set(PlaneId::kSurfaceShadow, [](int x, int) { return x < 5 ? 0.f : 1.f; });
  tray.scene.sun->direction = {std::sqrt(0.5), std::sqrt(0.5), 0};
  DepthFog::Params& fog = tray.look.of<DepthFog>();
  fog.sunlight = DepthFog::Sunlight::kStraight;
  fog.ambient = {0, 0, 0};
  fog.scattering = {1e-4, 1e-4, 1e-4};
  const double all = in_scatter(tray, 8);
  // From the middle of column 2 the shadow ends between 2 and 3 to the right, linearly.
  EXPECT_NEAR(in_scatter(tray, 2) / all, (0 + 0 + 0.5 + 1) / 4, 0.01);
  EXPECT_NEAR(in_scatter(tray, 3) / all, (0 + 0.5 + 1 + 1) / 4, 0.01);
  EXPECT_NEAR(in_scatter(tray, 0) / all, 0, 0.01);
}

// The same sun over water so deep and murky that sunlight is scattered after 2 in the mean: exp(-d
// / 2) of the scattered light entered farther than d to the right. Four places stand for all entry
// points.
TEST(WaterShadow, OfMurkyWaterIsThatOfLightThatFadesExponentially) {
  Tray tray = half_shaded_murk();
  tray.buffers.fill(PlaneId::kDepth, 50);
  tray.buffers.set(PlaneId::kSurfaceShadow, [](int x, int) { return x < 5 ? 0.f : 1.f; });
  tray.scene.sun->direction = {std::sqrt(0.5), std::sqrt(0.5), 0};
  DepthFog::Params& fog = tray.look.of<DepthFog>();
  fog.sunlight = DepthFog::Sunlight::kStraight;
  fog.ambient = {0, 0, 0};
  const double scattering = 0.5 / (1 + std::sqrt(2.0));
  fog.scattering = {scattering, scattering, scattering};
  const double all = in_scatter(tray, 9);
  for (const int column : {3, 4}) {
    // The edge is as wide as a pixel.
    const double from = 4 - column, lit = 2 * (std::exp(-from / 2) - std::exp(-(from + 1) / 2));
    EXPECT_NEAR(in_scatter(tray, column) / all, lit, 0.05) << column;
  }
}

// Light that is scattered next to the surface of endless water has the surface's shadow, in float,
// too.
TEST(WaterShadow, OfEndlessWaterIsOfTheSameLightInFloat) {
  Tray tray = half_shaded_murk();
  tray.buffers.fill(PlaneId::kDepth, test::kInf);
  tray.buffers.set(PlaneId::kSurfaceShadow, [](int x, int) { return x < 5 ? 0.f : 1.f; });
  tray.scene.sun->direction = {std::sqrt(0.5), std::sqrt(0.5), 0};
  DepthFog::Params& fog = tray.look.of<DepthFog>();
  fog.sunlight = DepthFog::Sunlight::kStraight;
  fog.ambient = {0, 0, 0};
  for (const double scattering : {0.2, 3.0}) {
    fog.scattering = {scattering, scattering, scattering};
    const test::Picture got = test::fused(tray.look, tray.buffers.frame, tray.scene);
    for (int x = 0; x < 10; ++x) {
      EXPECT_NEAR(got.aov(Aov::kInScatter, x, 1), in_scatter(tray, x), 1e-6) << x;
    }
  }
}

// In clear water each of four places stands for a quarter of a path of 40. Over those 10 light
// comes in from 10 aside, and the lookup is 0.6 of that wide: half way between texels of 4 and 8.
TEST(WaterShadow, ShaftsAreAsWideAsAQuarterOfAClearWay) {
  const Tray tray = half_shaded_murk();
  const float bright = 3, even = 1;
  const Rect texels = rect_of({400, 400});
  CausticsTable water;
  water.count = 2;
  water.levels[0] = {{&bright, 0, 0, texels}, {-800, -800}, 4};
  water.levels[1] = {{&even, 0, 0, texels}, {-1600, -1600}, 8};
  water.depth = 1e-3;  // focused at this depth and below
  CausticsTable table;
  table.in_water = &water;
  Pass pass(tray.scene, tray.buffers.frame, 1.333, kWholeState);
  pass.caustics = &table;
  pass.planes = {};
  Pixel<double> p{};
  p.to_viewer = {0, 1, 0};
  p.surface_depth = 10;
  p.side = 1;
  p.path = 40;
  p.mean_scatter_distance = 20;
  p.sun_entry = {1, 0, 0};
  test::ProbeStrip strip;
  const PathLight<double> more = path_light(pass, p, test::ProbeStrip::Tap{strip, 0}, 1.0);
  EXPECT_NEAR(more.near, 0.5 * (bright - even), 1e-9);
  EXPECT_NEAR(more.far, 0.5 * (bright - even), 1e-9);
}

// Caustics that are not made for the water itself make no shafts. Full shadow is black: all of the
// sun's light, 2, may be missing.
TEST(WaterShadow, ShaftsThatCannotBeAreNotInItsBound) {
  Tray tray = half_shaded_murk();
  Pass pass(tray.scene, tray.buffers.frame, 1.333, kWholeState);
  const CausticsTable bottom_alone;
  pass.caustics = &bottom_alone;
  Ranges ranges;
  ranges.sun_light = 2;
  WaterShadow::Params& params = tray.look.of<WaterShadow>();
  for (const double shafts : {0.0, 1.0}) {
    params.shafts = shafts;
    EXPECT_EQ(Kernel<WaterShadow>::bound(params, pass, ranges), 2);
  }
}

// As in IsLookedUpWhereTheRefractedRayEnds: from column 3 half way into the light. The view enters
// the water in the shadow.
TEST(WaterShadow, ScatterFollowsTheRefractedRay) {
  Tray tray = half_shaded_murk();
  tray.buffers.normal({0.6, 0.8, 0});
  tray.look.of<Refraction>().strength = 0.25;
  EXPECT_NEAR(in_scatter_of_bottom(tray, 3), kPart + 0.5 * kFar * kPart, 1e-5);
  EXPECT_NEAR(in_scatter_of_bottom(tray, 4), kPart + kFar * kPart, 1e-5);
}

TEST(WaterShadow, ScatterIsNothingInClearWater) {
  Tray tray = half_shaded_murk();
  tray.look.of<DepthFog>().scattering = {0, 0, 0};
  const test::Picture got = tray.wet();
  test::expect_rgb(got.color(2, 1), got.color(7, 1), 0);
  test::expect_rgb(got.color(2, 1), {0.5, 0.5, 0.5}, 1e-7);
}

TEST(WaterShadow, ScatterNeverGoesBelowBlack) {
  Tray tray = half_shaded_murk();
  tray.look.of<DepthFog>().ambient = {0, 0, 0};
  tray.look.of<DepthFog>().scattering = {0.1, 0.7, 3};
  const test::Picture got = tray.wet();
  test::expect_rgb(rgb_of(got, Aov::kInScatter, 2, 1), {0, 0, 0});
  for (int c = 0; c < 3; ++c) EXPECT_GE(got.aov(Aov::kInScatter, 2, 1, c), 0);
}

TEST(WaterShadow, ScatterIsSkippedWhereNoSunScatters) {
  Tray tray = half_shaded_murk();
  tray.look.of<DepthFog>().scattering = {0, 0, 0};
  const Inputs inputs = test::inputs_of(tray.buffers.frame, tray.scene);
  const auto verdict = [&] { return make_plan(tray.look, inputs).of<WaterShadow>().verdict; };
  EXPECT_EQ(make_plan(tray.look, inputs).of<WaterShadow>().name, WaterShadow::kName);
  EXPECT_EQ(verdict(), Verdict::kNeutral);
  tray.look.of<DepthFog>().scattering = {0.5, 0.5, 0.5};
  EXPECT_EQ(verdict(), Verdict::kKept);
}

}  // namespace
}  // namespace limpid
