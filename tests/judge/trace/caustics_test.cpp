#include <gtest/gtest.h>

#include "limpid/core/error.h"

#include "judge/trace/trace_scenes.h"

/// Sunlight that the waves focus on the bottom.

namespace limpid::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr Size kRow{96, 24};

/// Water with the true normals of these waves, on a plane that stays flat.
Look clear(const std::vector<SineWave>& waves = {}) {
  Look look = calm_look();
  DepthFog::Params& fog = look.of<DepthFog>();
  fog.water_type = WaterType::kCustom;
  fog.absorption = fog.scattering = fog.ambient = {0, 0, 0};
  WaveNormals::Params& normals = look.of<WaveNormals>();
  normals.model = WaveNormals::Model::kSines;
  normals.waves = waves;
  normals.strength = 1;
  return look;
}

/// A view straight down, 3 wide.
Scene from_above(const glm::dvec3& to_sun) {
  Scene scene = over_water(90, kRow);
  scene.camera->view = glm::lookAt(glm::dvec3(0, 2, 0), glm::dvec3(0, 0, 0), glm::dvec3(0, 0, -1));
  scene.camera->projection = orthographic(3, 0.75, 0.1, 10, ClipSpace::kGl);
  scene.sun = Sun{glm::normalize(to_sun), {1, 1, 1}};
  return scene;
}

TruthOptions with_photons(int photons) {
  TruthOptions options = every_aov(kRow);
  options.visible = false;
  options.light = TruthOptions::Light::kPaths;
  options.paths = 1;
  options.photons = photons;
  return options;
}

Material dark() { return lambert({.01, .01, .01}, {0, 0, 0}); }

/// The mean of green over the columns x0 ... x1 - 1.
double green(const TruthPicture& p, int x0 = 0, int x1 = kRow.width) {
  double sum = 0;
  for (int y = 0; y < kRow.height; ++y) {
    for (int x = x0; x < x1; ++x) sum += p.target.color[1].at(x, y);
  }
  return sum / (x1 - x0) / kRow.height;
}

/// Calm water focuses no light: except for noise, light and shadows are those of the calm plane.
TEST(Caustics, AreNoneUnderCalmWater) {
  for (const glm::dvec3 to_sun : {glm::dvec3(0, 1, 0), glm::dvec3(-0.8, 0.7, 0.2)}) {
    Mesh slab = quad({-1, 0.5f, -9}, {-0.2f, 0.5f, -9}, {-0.2f, 0.5f, 9}, {-1, 0.5f, 9});
    slab.uvs.clear();
    const Scene scene = from_above(to_sun);
    const Mesh slope = quad({-3, -2, 9}, {3, -0.2f, 9}, {3, -0.2f, -9}, {-3, -2, -9});
    for (const Mesh& floor : {level(-1), slope}) {
      const Model open = model_of({floor}, dark());
      const double calm = green(traced(open, scene, clear(), with_photons(0)));
      const double sent = green(traced(open, scene, clear(), with_photons(200000)));
      EXPECT_NEAR(sent, calm, 0.01 * calm);
    }
    const double calm =
        green(traced(model_of({level(-1)}, dark()), scene, clear(), with_photons(0)));
    const Model shaded = model_of({level(-1), slab}, dark());
    const double dark_part = green(traced(shaded, scene, clear(), with_photons(200000)));
    EXPECT_NEAR(dark_part, green(traced(shaded, scene, clear(), with_photons(0))), 0.02 * calm);
    // From straight above the slab hides its own shadow.
    if (to_sun.y == 1) continue;
    EXPECT_LT(green(traced(shaded, scene, clear(), with_photons(200000)), 62, 76), 0.01 * calm);
  }
}

/// The crest of a long wave focuses light like a lens, at a depth of 4 radii of curvature; its
/// trough spreads light. Shallower, at depth z, the light is 1 / (1 - z / f) and 1 / (1 + z / f) of
/// the light under the calm plane; the mean is unchanged.
TEST(Caustics, AreThoseOfTheLensOfAWave) {
  constexpr double kAmplitude = 0.01, kWave = 2 * kPi, kDepth = 1;  // the wavelength is 1
  const Scene scene = from_above({0, 1, 0});
  // The crests are at x = 0, along PlaneAxes.
  const std::vector<SineWave> waves = {{kAmplitude, kWave, 0, kPi / 2, 0}};
  const Model model = model_of({level(-kDepth)}, dark());
  const double calm = green(traced(model, scene, clear(), with_photons(0)));
  // Waves refract the view as well, but not at crest and trough.
  const TruthPicture p = traced(model, scene, clear(waves), with_photons(2000000));
  const double focus = 1 / (kAmplitude * kWave * kWave) * kTraceIor / (kTraceIor - 1);
  const double crest = green(p, 47, 49), trough = green(p, 31, 33);
  EXPECT_NEAR(crest / calm, 1 / (1 - kDepth / focus), 0.05 * crest / calm);
  EXPECT_NEAR(trough / calm, 1 / (1 + kDepth / focus), 0.05 * trough / calm);
  EXPECT_GT(crest, 1.2 * trough);
}

/// A view from within the water up to the surface, which reflects all light at this angle: the
/// picture shows the bottom only by reflection.
TEST(Caustics, LightTheBottomThatTheSurfaceMirrors) {
  Scene scene = from_above({0.1, 1, 0.1});
  scene.camera->view =
      glm::lookAt(glm::dvec3(0, -0.5, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0));
  scene.camera->projection = perspective(0.2, 4, 0.05, 100, ClipSpace::kGl);
  const Look look = clear({{0.004, 0, 4 * kPi, 0, 0}});  // its crests run away from the eye
  const Model model = model_of({level(-1)}, dark());
  const TruthPicture even = traced(model, scene, look, with_photons(0));
  const TruthPicture sent = traced(model, scene, look, with_photons(1000000));
  double least = HUGE_VAL, most = 0;
  for (int x = 0; x < kRow.width; ++x) {
    const double focused = green(sent, x, x + 1) / green(even, x, x + 1);
    least = std::min(least, focused), most = std::max(most, focused);
  }
  EXPECT_LT(least, 0.92);
  EXPECT_GT(most, 1.08);
  EXPECT_NEAR(green(sent) / green(even), 1, 0.05);
}

TEST(Caustics, AreTheSameForAnyThreads) {
  const Scene scene = from_above({0.3, 1, 0.1});
  const Model model = model_of({level(-1)}, dark());
  const auto light = [&](int threads, std::uint64_t seed) {
    TruthOptions options = with_photons(20000);
    options.seed = seed;
    return green(traced(model, scene, clear({{0.02, 7, 1, 0, 0}}), options, threads));
  };
  EXPECT_EQ(light(1, 0), light(2, 0));
  EXPECT_NE(light(1, 0), light(1, 1));
}

TEST(Caustics, AreRefusedWhereNothingBendsTheSun) {
  const Model model = model_of({level(-1)}, dark());
  const Scene scene = from_above({0, 1, 0});
  Look look = clear({{0.02, 7, 1, 0, 0}});
  TruthOptions options = with_photons(-1);
  EXPECT_THROW(traced(model, scene, look, options), Error);
  options.photons = 1000;
  options.light = TruthOptions::Light::kOnce;
  EXPECT_THROW(traced(model, scene, look, options), Error);
  options.light = TruthOptions::Light::kPaths;
  look.of<DepthFog>().sunlight = DepthFog::Sunlight::kStraight;
  EXPECT_THROW(traced(model, scene, look, options), Error);
}

}  // namespace
}  // namespace limpid::test
