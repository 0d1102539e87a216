#include <cmath>

#include "ops/depth_fog_kernel.h"
#include "ops/probe_strip.h"
#include "ops/tray.h"

namespace limpid {
namespace {

using test::Tray;

/// Bottom 2 under the surface: f = 1 - .15 x 2 = .7, veil = .9 x (1 - .7) = .27.
Tray shallow_tray() {
  Tray tray({3, 2});
  tray.buffers.fill(PlaneId::kDepth, 12);
  tray.look.of<DepthFog>() = test::plain_fog(DepthFog::Model::kLinear);
  return tray;
}

TEST(DepthFog, HandWorkedPixel) {
  const test::Picture got = shallow_tray().wet();
  test::expect_rgb(rgb_of(got, Aov::kTransmitted, 1, 1), {0.365, 0.365, 0.365});
  test::expect_rgb(rgb_of(got, Aov::kInScatter, 1, 1), {0.0054, 0.027, 0.0324});
  test::expect_rgb(got.color(1, 1), {0.3704, 0.392, 0.3974});
  EXPECT_NEAR(got.aov(Aov::kPath, 1, 1), 2, 1e-6);
}

// As the article writes it: u' = lerp(u, lerp(color, u, f), alpha).
TEST(DepthFog, IsTheArticlesTwoBlends) {
  const Size size{40, 30};
  test::Noise noise(size);
  noise.look.of<DepthFog>() = test::plain_fog(DepthFog::Model::kLinear);
  noise.look.of<DepthFog>().offset = 0.1;
  const test::Picture got = noise.wet();
  each_wet(got, size, [&](int x, int y) {
    const bool none = std::isinf(noise.buffers.frame.plane(PlaneId::kDepth).at(x, y));
    const double u = none ? 0 : noise.buffers.frame.plane(PlaneId::kColorR).at(x, y);
    const double d = got.aov(Aov::kPath, x, y);
    const double f = std::isinf(d) ? 0 : 1 - std::clamp(0.15 * d - 0.1, 0.0, 1.0);
    EXPECT_NEAR(got.color(x, y).r, lerp(u, lerp(0.02, u, f), 0.9), 1e-6);
  });
}

TEST(DepthFog, NoWaterUnderTheSurfaceNoFog) {
  Tray tray = shallow_tray();
  tray.buffers.fill(PlaneId::kDepth, std::nextafter(10.f, 11.f));
  test::expect_rgb(tray.wet().color(0, 0), {0.5, 0.5, 0.5});
}

TEST(DepthFog, DeepWaterIsItsOwnColorUpToAlpha) {
  Tray tray = shallow_tray();
  for (float bottom : {1e6f, test::kInf}) {
    tray.buffers.fill(PlaneId::kDepth, bottom);
    tray.look.of<DepthFog>().alpha = 1;
    test::expect_rgb(tray.wet().color(0, 0), {0.02, 0.10, 0.12});
    tray.look.of<DepthFog>().alpha = 0.9;
    // A tenth of any bottom is left, however far away; where there is no bottom, no light comes
    // from there.
    const double left = std::isinf(bottom) ? 0 : 0.05;
    test::expect_rgb(tray.wet().color(0, 0), {left + 0.018, left + 0.09, left + 0.108});
  }
}

TEST(DepthFog, OffsetKeepsTheFirstMetresClear) {
  Tray tray = shallow_tray();
  tray.look.of<DepthFog>().offset = 0.3;
  test::expect_rgb(tray.wet().color(0, 0), {0.5, 0.5, 0.5});
}

TEST(DepthFog, NeverLosesFogWithDepth) {
  double before = 0.5;
  for (float bottom = 10.1f; bottom < 20; bottom += 0.3f) {
    Tray tray = shallow_tray();
    tray.buffers.fill(PlaneId::kDepth, bottom);
    const double now = tray.wet().aov(Aov::kTransmitted, 0, 0);
    EXPECT_LE(now, before);
    before = now;
  }
  EXPECT_NEAR(before, 0.05, 1e-6);
}

// 90 degrees of view on 2 x 2 pixels: centres at ndc +-1/2, rays (+-.5, +-.5, -1), length
// sqrt(1.5).
TEST(DepthFog, DistanceAlongTheRay) {
  Tray tray = shallow_tray();
  tray.buffers = test::Buffers(Rect{0, 0, 2, 2});
  for (int c = 0; c < 3; ++c) tray.buffers.fill(plane_after(PlaneId::kColorR, c), 0.5f);
  tray.buffers.fill(PlaneId::kSurfaceDepth, 10).fill(PlaneId::kDepth, 12);
  tray.scene.camera->projection = perspective(std::numbers::pi / 2, 1, 0.1, 100, ClipSpace::kGl);
  EXPECT_NEAR(tray.wet().aov(Aov::kPath, 0, 0), 2, 1e-6);
  tray.look.of<DepthFog>().distance = DepthFog::Distance::kRay;
  EXPECT_NEAR(tray.wet().aov(Aov::kPath, 0, 0), 2 * std::sqrt(1.5), 1e-6);
}

TEST(DepthFog, NegativeOffsetFogsTheSurfaceItself) {
  Tray tray = shallow_tray();
  tray.look.of<DepthFog>().density = 0;
  tray.look.of<DepthFog>().offset = -0.5;  // f = .5, veil = .45
  EXPECT_NEAR(tray.wet().aov(Aov::kTransmitted, 0, 0), 0.275, 1e-6);
}

TEST(DepthFog, LinearSaysWhatSurvives) {
  const test::Picture got = shallow_tray().wet();
  test::expect_rgb(rgb_of(got, Aov::kTransmittance, 1, 1), {0.73, 0.73, 0.73});
}

// On a flat bottom the straight path is longer than the refracted path by this much.
TEST(DepthFog, RefractedDistanceOfAFlatBottom) {
  const Tray tray({1, 1});
  DepthFog::Params params = test::plain_fog(DepthFog::Model::kLinear);
  const auto path = [&](DepthFog::Distance distance, StateSet made, double angle, double depth) {
    test::ProbeStrip strip;
    strip.pixels.push_back(test::random_pixel(0, {}));
    Pixel<double>& p = strip.pixels[0];
    p.to_viewer = {std::sin(angle), std::cos(angle), 0};
    p.surface_depth = 3;
    p.dry_depth = p.hit_depth = 3 + depth / std::cos(angle) / p.ray_length;
    p.path = 0.7;
    params.distance = distance;
    Kernel<DepthFog>::apply(params, Pass(tray.scene, tray.buffers.frame, 1.333, made), strip);
    return p.path;
  };
  constexpr double kDegree = std::numbers::pi / 180;
  using enum DepthFog::Distance;
  for (auto [degrees, ratio] :
       {std::pair{0, 1.0}, {30, 1.07}, {45, 1.20}, {60, 1.52}, {75, 2.66}}) {
    const double angle = degrees * kDegree, straight = path(kRay, {}, angle, 2);
    EXPECT_NEAR(straight, 2 / std::cos(angle), 1e-12);
    EXPECT_NEAR(straight / path(kRefracted, {}, angle, 2), ratio, 0.005);
    EXPECT_EQ(path(kRefracted, {StatePart::kPosition}, angle, 2), 0.7);  // as refraction found it
  }
  EXPECT_EQ(path(kRefracted, {}, 0.5, HUGE_VAL), HUGE_VAL);
  EXPECT_EQ(path(kRefracted, {}, std::numbers::pi / 2, HUGE_VAL), HUGE_VAL);
}

// The bound of light that is scattered once towards the viewer is the largest value of the phase
// function, for a sun straight above and views that go down at least as steeply as refracted rays:
// at the angle farthest from straight back if the water scatters forwards, else straight back.
TEST(DepthFog, BoundsKnowWhichWayTheWaterScatters) {
  Tray tray = shallow_tray();
  tray.scene.sun = Sun{};
  const Pass pass(tray.scene, tray.buffers.frame, 1.333, kWholeState);
  Ranges ranges;
  ranges.fog_path = {0, 1};
  ranges.color = {{{0, 0}, {0, 0}, {0, 0}}};
  const auto bound = [&](double anisotropy) {
    DepthFog::Params params = test::plain_fog(DepthFog::Model::kBeerLambert);
    params.absorption = {0, 0, 0};
    params.scattering = {0.5, 0.5, 0.5};
    params.sunlight = DepthFog::Sunlight::kRefracted;
    params.anisotropy = anisotropy;
    return Kernel<DepthFog>::bound(params, pass, ranges);
  };
  const double sink = std::sqrt(1 - 1 / (1.333 * 1.333));
  const double forwards = 0.36 / std::pow(1.64 + 1.6 * sink, 1.5), back = 0.36 / std::pow(0.2, 3);
  EXPECT_NEAR(bound(0.8) / bound(0), forwards, 1e-6);
  EXPECT_NEAR(bound(-0.8) / bound(0), back, 1e-6 * back);
}

// The sun lights the scattering water and, under a surface that reflects from below, the bottom.
Ranges ranges_at(const Tray& tray, double distance) {
  Ranges ranges;
  ranges.own = {distance, distance};
  ranges.color = {{{0.5, 0.5}, {0.5, 0.5}, {0.5, 0.5}}};
  ranges.light = 0.5;
  const Pass pass(tray.scene, tray.buffers.frame, 1.333, {});
  Kernel<DepthFog>::propagate_ranges(tray.look.of<DepthFog>(), pass, ranges);
  return ranges;
}

TEST(DepthFog, NoLightFromBelowIsBrighterThanItsRangesSay) {
  Tray tray({3, 2});
  tray.scene.sun = Sun{.color = {40, 40, 40}};
  DepthFog::Params red = test::plain_fog(DepthFog::Model::kLinear);
  red.color = {4, 0.1, 0.1}, red.alpha = 1;
  DepthFog::Params sunlit = test::plain_fog(DepthFog::Model::kBeerLambert);
  sunlit.scattering = {0.1, 0.5, 2};
  sunlit.sunlight = DepthFog::Sunlight::kNone;
  for (const DepthFog::Params& fog : {red, sunlit}) {
    tray.look.of<DepthFog>() = fog;
    for (const float distance : {0.1f, 1.0f, 20.0f}) {
      tray.buffers.fill(PlaneId::kDepth, 10 + distance);
      const test::Picture got = tray.wet();
      const double bound = ranges_at(tray, distance).light;
      for (int c = 0; c < 3; ++c) {
        const double light =
            got.aov(Aov::kTransmitted, 1, 1, c) + got.aov(Aov::kInScatter, 1, 1, c);
        EXPECT_LE(light, bound * (1 + 1e-6)) << distance;
      }
    }
  }
}

// However deep the water is, and however little red and blue light comes up.
TEST(DepthFog, WaterThatTakesNothingFromAColorIsNeverOpaque) {
  Tray tray({3, 2});
  DepthFog::Params& fog = tray.look.of<DepthFog>();
  fog = test::plain_fog(DepthFog::Model::kBeerLambert);
  const Pass pass(tray.scene, tray.buffers.frame, 1.333, {});
  const auto beyond = [&] { return Kernel<DepthFog>::beyond(fog, pass, ranges_at(tray, 1e3)); };
  fog.absorption = {1, 1, 1};
  EXPECT_EQ(beyond(), 0);
  fog.absorption = {1, 0, 1};
  EXPECT_EQ(beyond(), HUGE_VAL);
}

TEST(DepthFog, WantsLightThatIsScatteredMoreThanOnceWhereThereIsSome) {
  DepthFog::Params params = test::plain_fog(DepthFog::Model::kRadiativeTransfer);
  const auto wants = [&](double scattering, DepthFog::Crossing crossing) {
    params.scattering = {scattering, scattering, scattering};
    params.crossing = crossing;
    return Kernel<DepthFog>::wants_scattered_light(params);
  };
  EXPECT_TRUE(wants(0.1, DepthFog::Crossing::kRadiance));
  EXPECT_TRUE(wants(0.1, DepthFog::Crossing::kNone));
  EXPECT_TRUE(wants(0, DepthFog::Crossing::kRadiance));
  EXPECT_FALSE(wants(0, DepthFog::Crossing::kNone));
  params.model = DepthFog::Model::kBeerLambert;
  EXPECT_FALSE(wants(0.1, DepthFog::Crossing::kRadiance));
}

}  // namespace
}  // namespace limpid
