#include <numbers>

#include "ops/depth_fog_kernel.h"
#include "ops/probe_strip.h"
#include "ops/tray.h"

// The physical model of depth_fog. (Its table of parameters and the linear model:
// depth_fog_test.cpp.)

namespace limpid {
namespace {

using test::expect_rgb;
using test::Picture;
using test::Tray;
using Sunlight = DepthFog::Sunlight;
using Crossing = DepthFog::Crossing;
using Distance = DepthFog::Distance;

constexpr double kPi = std::numbers::pi;
constexpr double kN = 1.333;

/// Bottom 2 under the surface, seen from straight above, no sun.
Tray clear_tray() {
  Tray tray({3, 2});
  tray.buffers.fill(PlaneId::kDepth, 12);
  tray.look.of<DepthFog>() = test::plain_fog(DepthFog::Model::kBeerLambert);
  return tray;
}

/// Water that absorbs nothing and scatters half of the light each metre, evenly in all directions;
/// the sun straight above.
Tray murky_tray(Sunlight sunlight) {
  Tray tray = clear_tray();
  tray.scene.sun = Sun{};
  DepthFog::Params& fog = tray.look.of<DepthFog>();
  fog.absorption = {0, 0, 0};
  fog.scattering = {0.5, 0.5, 0.5};
  fog.anisotropy = 0;
  fog.sunlight = sunlight;
  return tray;
}

double transmitted(const Tray& tray) { return tray.wet().aov(Aov::kTransmitted, 1, 1); }
double in_scatter(const Tray& tray) { return tray.wet().aov(Aov::kInScatter, 1, 1); }

// --- worked by hand -----------------------------------------------------------------------------

// exp(-.68), exp(-.113), exp(-.01844).
TEST(BeerLambert, PureWater) {
  const Picture got = clear_tray().wet();
  expect_rgb(rgb_of(got, Aov::kTransmittance, 1, 1), {0.506617, 0.893151, 0.981729});
  expect_rgb(rgb_of(got, Aov::kTransmitted, 1, 1), {0.253308, 0.446575, 0.490864});
  expect_rgb(rgb_of(got, Aov::kInScatter, 1, 1), {0, 0, 0});
  EXPECT_NEAR(got.aov(Aov::kPath, 1, 1), 2, 1e-6);
}

// Light of the sun overhead goes down through the same depth of 2.
TEST(BeerLambert, SunlightLosesOnItsWayDownToo) {
  Tray tray = clear_tray();
  tray.scene.sun = Sun{};
  EXPECT_NEAR(transmitted(tray), 0.5 * 0.506617 * 0.506617, 1e-6);
  tray.look.of<DepthFog>().sunlight = Sunlight::kStraight;
  EXPECT_NEAR(transmitted(tray), 0.5 * 0.506617 * 0.506617, 1e-6);
  tray.look.of<DepthFog>().sunlight = Sunlight::kNone;
  EXPECT_NEAR(transmitted(tray), 0.5 * 0.506617, 1e-6);
  // 60 deg from the zenith: 4 along the straight ray, 2 / .760267 along the refracted one.
  tray.scene.sun->direction = {std::sqrt(0.75), 0.5, 0};
  tray.look.of<DepthFog>().sunlight = Sunlight::kStraight;
  EXPECT_NEAR(transmitted(tray), 0.5 * 0.506617 * std::exp(-0.34 * 4), 1e-6);
  tray.look.of<DepthFog>().sunlight = Sunlight::kRefracted;
  EXPECT_NEAR(transmitted(tray), 0.5 * 0.506617 * std::exp(-0.34 * 2 / 0.760206), 1e-6);
}

// F0 = (.333 / 2.333)^2 = .0203733, n^2 = 1.776889.
TEST(BeerLambert, CrossingTheSurface) {
  Tray tray = clear_tray();
  tray.look.of<DepthFog>().absorption = {0, 0, 0};
  tray.look.of<DepthFog>().crossing = Crossing::kRadiance;
  EXPECT_NEAR(transmitted(tray), 0.5 * (1 - 0.0664) / 1.776889, 2e-5);
  tray.scene.sun = Sun{};
  EXPECT_NEAR(transmitted(tray), 0.5 * (1 - 0.0203733) / 1.776889, 1e-6);
  tray.scene.sun->direction = {std::sqrt(0.75), 0.5, 0};
  EXPECT_NEAR(transmitted(tray), 0.5 * (1 - 0.0597) / 1.776889, 2e-5);
}

// b p E = .5 / (4 pi) pi = 1/8, times (1 - e^-1) / .5 or, with the path down, (1 - e^-2) / 1.
TEST(BeerLambert, SunInMurkyWater) {
  EXPECT_NEAR(in_scatter(murky_tray(Sunlight::kNone)), 0.25 * (1 - std::exp(-1.0)), 1e-6);
  EXPECT_NEAR(in_scatter(murky_tray(Sunlight::kStraight)), 0.125 * (1 - std::exp(-2.0)), 1e-6);
  Tray tray = murky_tray(Sunlight::kRefracted);
  EXPECT_NEAR(in_scatter(tray), 0.9796267 * 0.125 * (1 - std::exp(-2.0)), 1e-6);
  EXPECT_NEAR(transmitted(tray), 0.5 * std::exp(-2.0), 1e-6);
  tray.look.of<DepthFog>().crossing = Crossing::kRadiance;
  EXPECT_NEAR(in_scatter(tray), 0.9796267 / 1.776889 * 0.125 * (1 - std::exp(-2.0)), 1e-6);
  tray.scene.sun->color = {2, 0, 1};
  const double red = in_scatter(tray);
  EXPECT_NEAR(red, 2 * 0.9796267 / 1.776889 * 0.125 * (1 - std::exp(-2.0)), 1e-6);
  expect_rgb(rgb_of(tray.wet(), Aov::kInScatter, 1, 1), {red, 0, red / 2});
}

// Light that is scattered forwards is not lost on the path down: K = a + b (1 - g).
TEST(BeerLambert, ForwardScatteringReachesDeeper) {
  Tray tray = murky_tray(Sunlight::kRefracted);
  tray.look.of<DepthFog>().anisotropy = 0.8;
  EXPECT_NEAR(transmitted(tray), 0.5 * std::exp(-1.0 - 0.2), 1e-6);
}

TEST(BeerLambert, AmbientLight) {
  Tray tray = murky_tray(Sunlight::kRefracted);
  tray.scene.sun.reset();
  tray.look.of<DepthFog>().ambient = {0.2, 0.4, 0};
  const double column = 1 - std::exp(-1.0);  // b (1 - e^-bd) / b
  expect_rgb(rgb_of(tray.wet(), Aov::kInScatter, 1, 1), {0.2 * column, 0.4 * column, 0});
  tray.look.of<DepthFog>().absorption = {0.5, 0, 0};
  EXPECT_NEAR(in_scatter(tray), 0.2 * 0.5 * (1 - std::exp(-2.0)), 1e-6);
}

// Type 3C takes .46 .19 .39 from light going down, and 1 / 1.0395 of that from a ray.
TEST(BeerLambert, NamedWaters) {
  Tray tray = clear_tray();
  DepthFog::Params& fog = tray.look.of<DepthFog>();
  fog.absorption = {9, 9, 9};
  fog.water_type = WaterType::kPure;
  expect_rgb(rgb_of(tray.wet(), Aov::kTransmittance, 1, 1), {0.506617, 0.893151, 0.981729});
  fog.water_type = WaterType::kJerlov3C;
  const auto left = [](double rate) { return std::exp(-2 * rate); };
  const Rgb<double> ray = {left(.46 / 1.0395), left(.19 / 1.0395), left(.39 / 1.0395)};
  expect_rgb(rgb_of(tray.wet(), Aov::kTransmittance, 1, 1), ray);
  tray.scene.sun = Sun{};
  expect_rgb(rgb_of(tray.wet(), Aov::kTransmitted, 1, 1),
             0.5 * (ray * Rgb<double>{left(.46), left(.19), left(.39)}));
  // Scattering adds to the loss of the ray; K_d includes scattering already.
  fog.scattering = {0.1, 0.1, 0.1};
  EXPECT_NEAR(transmitted(tray), 0.5 * ray.r * left(0.1) * left(.46), 1e-6);
  fog.water_type = WaterType::kPure;
  fog.anisotropy = 0;
  EXPECT_NEAR(transmitted(tray), 0.5 * left(0.34 + 0.1) * left(0.34 + 0.1), 1e-6);
}

// Two grams of sediment scatter 1; humus of 1 at 440 nm absorbs e^-2.94 of red, in any water.
TEST(BeerLambert, SedimentAndHumusAreAddedToEachWater) {
  const double sediment = 0.082 * std::exp(-0.0123 * 207), humus = std::exp(-2.94);
  const auto left = [](double rate) { return std::exp(-2 * rate); };
  Tray tray = clear_tray();
  DepthFog::Params& fog = tray.look.of<DepthFog>();
  for (WaterType type : {WaterType::kCustom, WaterType::kJerlov3C, WaterType::kCase1}) {
    fog.water_type = type;
    fog.sediment = fog.cdom = 0;
    fog.anisotropy = 0.8;
    tray.scene.sun.reset();
    const double ray = transmitted(tray);
    tray.scene.sun = Sun{};
    const double both = transmitted(tray);
    fog.sediment = 2;
    fog.cdom = 1;
    // On the path down, light that is scattered forwards is not lost.
    EXPECT_NEAR(transmitted(tray) / both,
                left(sediment + humus + 1) * left(sediment + humus + 1 - 0.8), 1e-6);
    tray.scene.sun.reset();
    EXPECT_NEAR(transmitted(tray) / ray, left(sediment + humus + 1), 1e-6);
  }
}

// Sediment scatters light back, humus absorbs light.
TEST(BeerLambert, SedimentBrightensAndHumusDarkens) {
  Tray tray = murky_tray(Sunlight::kRefracted);
  DepthFog::Params& fog = tray.look.of<DepthFog>();
  const double before = in_scatter(tray);
  fog.sediment = 1;
  const double bright = in_scatter(tray);
  EXPECT_GT(bright, 1.1 * before);
  fog.cdom = 5;
  EXPECT_LT(in_scatter(tray), 0.9 * bright);
}

// The share of the scattered light that ocean water scatters back (Petzold 1972).
TEST(BeerLambert, DefaultAnisotropyIsThatOfTheOcean) {
  const double g = DepthFog::Params{}.anisotropy;
  double back = 0;
  for (int i = 0; i < 10000; ++i) {
    back += 2 * kPi * henyey_greenstein(-(i + 0.5) / 10000, g) / 10000;
  }
  EXPECT_NEAR(back, 0.018, 5e-4);
}

// --- laws ---------------------------------------------------------------------------------------

TEST(BeerLambert, NothingIsLostOrWonInAWhiteFurnace) {
  Tray tray = murky_tray(Sunlight::kRefracted);
  tray.scene.sun.reset();
  for (int c = 0; c < 3; ++c) tray.buffers.fill(plane_after(PlaneId::kColorR, c), 1);
  tray.look.of<DepthFog>().scattering = {1e-5, 0.3, 40};
  tray.look.of<DepthFog>().ambient = {1, 1, 1};
  for (float bottom : {10.001f, 10.5f, 14.f, 900.f}) {
    tray.buffers.fill(PlaneId::kDepth, bottom);
    expect_rgb(tray.wet().color(1, 1), {1, 1, 1});
  }
}

// Suns from the whole sky with 1 of radiance each are no brighter than the furnace.
TEST(BeerLambert, SunsAllOverTheSkyScatterNoMoreThanIsLost) {
  const int steps = 48;
  for (Sunlight sunlight : {Sunlight::kNone, Sunlight::kStraight, Sunlight::kRefracted}) {
    for (double g : {-0.6, 0.0, 0.7}) {
      double scattered = 0, survived = 0;
      for (int i = 0; i < steps; ++i) {
        const double cosine = (i + 0.5) / steps, solid_angle = 2 * kPi / steps;
        Tray tray = murky_tray(sunlight);
        tray.look.of<DepthFog>().anisotropy = g;
        const double color = solid_angle / kPi;
        tray.scene.sun = Sun{{std::sqrt(1 - cosine * cosine), cosine, 0}, {color, color, color}};
        const Picture got = tray.wet();
        scattered += got.aov(Aov::kInScatter, 1, 1);
        survived = got.aov(Aov::kTransmittance, 1, 1);
      }
      EXPECT_GT(scattered, 0.01 * (1 - survived));
      EXPECT_LE(scattered + survived, 1) << g;
    }
  }
}

// Without absorption, all sunlight that enters deep water is scattered in the end: 4 pi times the
// radiance L straight up, seen through a rate of 1 + 1/cos_t instead of 1/cos_t.
TEST(BeerLambert, AllLightThatEntersDeepWaterIsScattered) {
  for (double angle : {0.0, 0.6, 1.2, 1.5}) {
    Tray tray = murky_tray(Sunlight::kRefracted);
    tray.buffers.fill(PlaneId::kDepth, 1e4f);
    tray.scene.sun->direction = {std::sin(angle), std::cos(angle), 0};
    const double cos_t = std::cos(std::asin(std::sin(angle) / kN));
    const double scattered = 4 * kPi * in_scatter(tray) * (1 + cos_t);
    const double s = (std::cos(angle) - kN * cos_t) / (std::cos(angle) + kN * cos_t);
    const double p = (kN * std::cos(angle) - cos_t) / (kN * std::cos(angle) + cos_t);
    EXPECT_NEAR(scattered, (1 - (s * s + p * p) / 2) * kPi * std::cos(angle), 1e-5) << angle;
  }
}

TEST(BeerLambert, WithoutScatteringWhatIsNotSwallowedArrives) {
  Tray tray = clear_tray();
  tray.scene.sun = Sun{{0.6, 0.8, 0}, {5, 5, 5}};
  tray.look.of<DepthFog>().sunlight = Sunlight::kNone;
  tray.look.of<DepthFog>().ambient = {3, 3, 3};
  for (double absorption : {0.0, 0.2, 3.0}) {
    tray.look.of<DepthFog>().absorption = {absorption, absorption, absorption};
    double swallowed = 0;
    for (int i = 0; i < 1000; ++i) {
      swallowed += absorption * std::exp(-absorption * 2 * (i + 0.5) / 1000) * 2 / 1000;
    }
    const Picture got = tray.wet();
    EXPECT_NEAR(got.aov(Aov::kTransmitted, 1, 1) / 0.5 + swallowed, 1, 2e-6);
    EXPECT_EQ(got.aov(Aov::kInScatter, 1, 1), 0);
  }
}

TEST(BeerLambert, TwoWaysOneAfterTheOther) {
  const auto through = [](float length) {
    Tray tray = murky_tray(Sunlight::kNone);
    tray.buffers.fill(PlaneId::kDepth, 10 + length);
    return tray.wet().aov(Aov::kTransmittance, 1, 1);
  };
  EXPECT_NEAR(through(1.5f) * through(3), through(4.5f), 1e-7);
}

TEST(BeerLambert, DimsAndGlowsMoreWithDepth) {
  double light = 1, glow = -1;
  for (float length = 0.01f; length < 12; length += 0.37f) {
    Tray tray = murky_tray(Sunlight::kRefracted);
    tray.scene.sun->direction = {0.6, 0.8, 0};
    tray.look.of<DepthFog>().ambient = {0.1, 0.1, 0.1};
    tray.look.of<DepthFog>().absorption = {0.1, 0.1, 0.1};
    tray.buffers.fill(PlaneId::kDepth, 10 + length);
    EXPECT_LT(transmitted(tray), light);
    EXPECT_GT(in_scatter(tray), glow);
    light = transmitted(tray);
    glow = in_scatter(tray);
  }
}

TEST(BeerLambert, ScatteringGoesToNothingWithB) {
  for (double b : {1e-2, 1e-5, 1e-9, 0.0}) {
    Tray tray = murky_tray(Sunlight::kRefracted);
    tray.look.of<DepthFog>().ambient = {1, 1, 1};
    tray.look.of<DepthFog>().scattering = {b, b, b};
    const double thin = b * 2 * (1 + 0.9796267 / 4);
    EXPECT_NEAR(in_scatter(tray), thin, (3 * b + 1e-6) * thin);
  }
}

TEST(BeerLambert, SkyUnderWaterIsGoneWhereThereIsWater) {
  Tray tray = murky_tray(Sunlight::kRefracted);
  tray.buffers.fill(PlaneId::kDepth, test::kInf);
  tray.look.of<DepthFog>().scattering = {0.5, 0, 1e-30};
  tray.look.of<DepthFog>().ambient = {1, 1, 1};
  const Picture got = tray.wet();
  expect_rgb(rgb_of(got, Aov::kTransmittance, 1, 1), {0, 1, 0});
  expect_rgb(rgb_of(got, Aov::kTransmitted, 1, 1), {0, 0, 0});  // clear water over nothing
  const double deep = 1 + 0.9796267 / 8;                        // b / b, and b / 4 / (b + b)
  expect_rgb(rgb_of(got, Aov::kInScatter, 1, 1), {deep, 0, deep});
}

// A sun at or below the horizon does not light the water, and no sunlight is lost.
TEST(BeerLambert, AfterSunset) {
  for (glm::dvec3 direction : {glm::dvec3(1, 0, 0), glm::dvec3(0.8, -0.6, 0)}) {
    Tray tray = murky_tray(Sunlight::kRefracted);
    tray.scene.sun->direction = direction;
    EXPECT_EQ(in_scatter(tray), 0);
    EXPECT_NEAR(transmitted(tray), 0.5 * std::exp(-1.0), 1e-6);
    tray.look.of<DepthFog>().crossing = Crossing::kRadiance;
    EXPECT_NEAR(transmitted(tray), 0.5 * std::exp(-1.0) * (1 - 0.0664) / 1.776889, 2e-5);
  }
}

// --- against a sum over the path ----------------------------------------------------------------

struct Angles {
  double zenith, azimuth;
  glm::dvec3 direction() const {
    return {std::sin(zenith) * std::cos(azimuth), std::cos(zenith),
            std::sin(zenith) * std::sin(azimuth)};
  }
  Angles in_water() const { return {std::asin(std::sin(zenith) / kN), azimuth}; }
};

/// Single scattering by the textbook, under water only: one channel.
struct Textbook {
  double a, b, g;
  Angles sun;
  Sunlight sunlight;

  /// The light that is scattered to a viewer along a path that begins at depth `from` along `view`.
  double sun_scatter(double from, glm::dvec3 view, double length) const {
    const Angles in_water = sunlight == Sunlight::kRefracted ? sun.in_water() : sun;
    const double cosine = std::cos(sun.zenith), cos_t = std::cos(in_water.zenith);
    double irradiance = kPi;  // of a sun of color 1
    if (sunlight == Sunlight::kRefracted) {
      const double s = (cosine - kN * cos_t) / (cosine + kN * cos_t);
      const double p = (kN * cosine - cos_t) / (kN * cosine + cos_t);
      irradiance *= (1 - (s * s + p * p) / 2) * cosine / cos_t;
    }
    const double turn = glm::dot(-in_water.direction(), -view);
    const double phase = (1 - g * g) / (4 * kPi * std::pow(1 + g * g - 2 * g * turn, 1.5));
    const double k = sunlight == Sunlight::kNone ? 0 : (a + b * (1 - g)) / cos_t;
    const int steps = 4000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
      const double s = length * (i + 0.5) / steps, depth = from - s * view.y;
      sum += std::exp(-k * depth) * std::exp(-(a + b) * s) * length / steps;
    }
    return b * phase * irradiance * sum;
  }
};

/// The operator alone on one pixel; `made` tells whether refraction has made the path.
Pixel<double> fogged(const DepthFog::Params& params, const Scene& scene, StateSet made,
                     const Pixel<double>& pixel) {
  const Tray tray({1, 1});
  test::ProbeStrip strip;
  strip.pixels.push_back(pixel);
  Kernel<DepthFog>::apply(params, Pass(scene, tray.buffers.frame, kN, made), strip);
  return strip.pixels[0];
}

DepthFog::Params params_of(const Textbook& t) {
  DepthFog::Params fog = test::plain_fog(DepthFog::Model::kBeerLambert);
  fog.distance = Distance::kRefracted;
  fog.absorption = {t.a, t.a, t.a};
  fog.scattering = {t.b, t.b, t.b};
  fog.anisotropy = t.g;
  fog.sunlight = t.sunlight;
  return fog;
}

template <class Fn>
void each_textbook(Fn&& fn) {
  for (Sunlight sunlight : {Sunlight::kNone, Sunlight::kStraight, Sunlight::kRefracted}) {
    for (double zenith : {0.0, 0.7, 1.4}) {
      fn(Textbook{0.2, 0.05, 0.92, {zenith, 0.3}, sunlight});
      fn(Textbook{0.0, 0.6, -0.4, {zenith, 2.0}, sunlight});
      fn(Textbook{0.02, 1.5, 0.6, {zenith, 4.0}, sunlight});
    }
  }
}

TEST(BeerLambert, AgreesWithTheSumSeenFromTheAir) {
  Scene scene = test::tray_scene({1, 1});
  each_textbook([&](const Textbook& t) {
    scene.sun = Sun{t.sun.direction(), {1, 1, 1}};
    for (double zenith : {0.1, 0.8, 1.3}) {
      for (double length : {0.05, 1.0, 9.0}) {
        Pixel<double> pixel = test::random_pixel(1, {});
        const Angles viewer{zenith, 1.0};
        const glm::dvec3 to_viewer = viewer.direction(), view = -viewer.in_water().direction();
        pixel.to_viewer = {to_viewer.x, to_viewer.y, to_viewer.z};
        pixel.path = length;
        const Pixel<double> got = fogged(params_of(t), scene, {StatePart::kPosition}, pixel);
        const double expected = t.sun_scatter(0, view, length);
        EXPECT_NEAR(got.in_scatter.r / expected, 1, 1e-5) << t.sun.zenith << " " << zenith;
        EXPECT_NEAR(got.sun_near.g + got.sun_far.g, got.in_scatter.g, 1e-12);
        EXPECT_GE(got.sun_near.b, got.sun_far.b);
      }
    }
  });
}

/// A camera 3 under the surface.
Scene diver() {
  Scene scene = test::tray_scene({1, 1});
  scene.camera->view =
      glm::lookAt(glm::dvec3(0, -3, 0), glm::dvec3(0, -3, -1), glm::dvec3(0, 1, 0));
  scene.camera->projection = perspective(1, 1, 0.1, 100, ClipSpace::kGl);
  return scene;
}

/// The light that this camera sees in a direction; the view ends at the surface if the surface is
/// nearer.
Pixel<double> seen_by_diver(const Angles& towards, double dry_length) {
  Pixel<double> pixel = test::random_pixel(2, {});
  const glm::dvec3 view = towards.direction();
  pixel.to_viewer = {-view.x, -view.y, -view.z};
  pixel.dry_depth = dry_length / pixel.ray_length;
  pixel.surface_depth = view.y > 0 ? 3 / view.y / pixel.ray_length : pixel.dry_depth;
  pixel.side = pixel.surface_depth < pixel.dry_depth ? -1 : 0;
  return pixel;
}

TEST(BeerLambert, AgreesWithTheSumSeenFromTheWater) {
  Scene scene = diver();
  each_textbook([&](const Textbook& t) {
    scene.sun = Sun{t.sun.direction(), {1, 1, 1}};
    for (double zenith : {0.1, 1.4, kPi / 2, 2.2, kPi}) {
      for (double length : {1.0, 9.0}) {
        const Angles towards{zenith, 1.0};
        const Pixel<double> pixel = seen_by_diver(towards, length);
        const double distance = pixel.side < 0 ? 3 / std::cos(zenith) : length;
        DepthFog::Params params = params_of(t);
        params.crossing = Crossing::kRadiance;  // the viewer is in the water already
        const Pixel<double> got = fogged(params, scene, {StatePart::kPosition}, pixel);
        EXPECT_NEAR(got.path, distance, 1e-9);
        const double expected = t.sun_scatter(3, towards.direction(), distance);
        EXPECT_NEAR(got.in_scatter.r / expected, 1, 1e-5) << t.sun.zenith << " " << zenith;
      }
    }
  });
}

// --- where the view begins ----------------------------------------------------------------------

TEST(BeerLambert, DiverSeesTheBottomLitThroughItsOwnDepth) {
  Scene scene = diver();
  scene.sun = Sun{};
  DepthFog::Params params = params_of({0.2, 0, 0, {0, 0}, Sunlight::kRefracted});
  params.crossing = Crossing::kRadiance;
  const Angles down{kPi, 0};
  Pixel<double> pixel = seen_by_diver(down, 5);
  pixel.transmitted = {1, 1, 1};
  const Pixel<double> got = fogged(params, scene, {}, pixel);
  EXPECT_NEAR(got.transmitted.r, std::exp(-0.2 * 5) * std::exp(-0.2 * 8), 1e-12);
  EXPECT_NEAR(got.transmittance.r, std::exp(-0.2 * 5), 1e-12);
}

TEST(BeerLambert, DiverSeesTheAirThroughTheWaterOnlyOnce) {
  Scene scene = diver();
  scene.sun = Sun{};
  DepthFog::Params params = params_of({0.2, 0, 0, {0, 0}, Sunlight::kRefracted});
  params.crossing = Crossing::kRadiance;
  Pixel<double> pixel = seen_by_diver({0, 0}, HUGE_VAL);
  pixel.transmitted = {1, 1, 1};
  EXPECT_EQ(pixel.side, -1);
  EXPECT_NEAR(fogged(params, scene, {}, pixel).transmitted.r, std::exp(-0.2 * 3), 1e-12);
}

// A camera 2 under the surface that looks straight down at a bottom 5 away, as a picture.
TEST(BeerLambert, PictureFromUnderWater) {
  Tray tray = clear_tray();
  tray.scene.camera->view =
      glm::lookAt(glm::dvec3(0, -2, 0), glm::dvec3(0, -3, 0), glm::dvec3(0, 0, -1));
  tray.scene.camera->projection = perspective(1, 1.5, 0.1, 100, ClipSpace::kGl);
  tray.scene.sun = Sun{};
  tray.buffers = test::Buffers(rect_of({3, 3}));
  for (int c = 0; c < 3; ++c) tray.buffers.fill(plane_after(PlaneId::kColorR, c), 0.5f);
  tray.buffers.fill(PlaneId::kDepth, 5);
  const Picture got = tray.wet();
  EXPECT_NEAR(got.aov(Aov::kPath, 1, 1), 5, 1e-6);
  EXPECT_NEAR(got.color(1, 1).r, 0.5 * std::exp(-0.34 * 5) * std::exp(-0.34 * 7), 1e-6);
}

TEST(BeerLambert, NoNanAtAnyEdge) {
  Scene scene = diver();
  for (glm::dvec3 sun : {glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0)}) {
    scene.sun = Sun{sun, {1, 1, 1}};
    for (Sunlight sunlight : {Sunlight::kNone, Sunlight::kStraight, Sunlight::kRefracted}) {
      for (double a : {0.0, 1e6}) {
        for (Angles towards : {Angles{0, 0}, Angles{kPi / 2, 0}, Angles{kPi, 0}}) {
          for (double length : {0.0, HUGE_VAL}) {
            for (double side : {-1.0, 0.0, 1.0}) {
              Pixel<double> pixel = seen_by_diver(towards, length);
              if (towards.zenith == kPi / 2) pixel.to_viewer.y = 0;
              pixel.side = side;
              pixel.surface_depth = 1;
              const DepthFog::Params params = params_of({a, a, 0.99, {0, 0}, sunlight});
              const Pixel<double> got = fogged(params, scene, {}, pixel);
              EXPECT_FALSE(std::isnan(got.path));
              EXPECT_TRUE(std::isfinite(got.transmitted.r) && std::isfinite(got.in_scatter.r));
              EXPECT_TRUE(std::isfinite(got.sun_near.r) && std::isfinite(got.sun_far.r));
            }
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace limpid
