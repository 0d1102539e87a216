#include <gtest/gtest.h>

#include "limpid/core/error.h"

#include "judge/trace/column.h"
#include "judge/trace/trace_scenes.h"
#include "optics/fresnel.h"

/// Light by random paths through a model, beside the column, which closed forms check, and beside
/// the closed forms of single scattering.

namespace limpid::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr Size kSmall{12, 10};

TruthOptions with_paths(int paths, Size size = kSmall) {
  TruthOptions options = every_aov(size);
  options.visible = false;
  options.light = TruthOptions::Light::kPaths;
  options.paths = paths;
  return options;
}

/// All pixels look into the water in the same direction.
Scene one_way(double degrees) {
  Scene scene = over_water(degrees, kSmall);
  scene.camera->projection =
      perspective(1e-4, double(kSmall.width) / kSmall.height, 0.1, 1e3, ClipSpace::kGl);
  return scene;
}

Look murky(const Rgb<double>& absorption, const Rgb<double>& scattering, double anisotropy,
           bool real_surface) {
  Look look = calm_look();
  DepthFog::Params& fog = look.of<DepthFog>();
  fog.water_type = WaterType::kCustom;
  fog.absorption = absorption;
  fog.scattering = scattering;
  fog.anisotropy = anisotropy;
  fog.ambient = {0, 0, 0};
  fog.sunlight = real_surface ? DepthFog::Sunlight::kRefracted : DepthFog::Sunlight::kStraight;
  fog.crossing = real_surface ? DepthFog::Crossing::kRadiance : DepthFog::Crossing::kNone;
  return look;
}

/// The mean of the picture, and its largest standard error.
ColumnLight mean_of(const TruthPicture& p) {
  Rgb<double> sum{0, 0, 0}, squares{0, 0, 0};
  for_each_pixel(p.window.size(), [&](int x, int y) {
    const auto at = [&](std::size_t c) { return double(p.target.color[c].at(x, y)); };
    const Rgb<double> color{at(0), at(1), at(2)};
    sum = sum + color;
    squares = squares + color * color;
  });
  const double n = double(p.window.width()) * p.window.height();
  const auto error = [n](double s, double q) {
    return std::sqrt(std::max(q / n - s * s / n / n, 0.0) / (n - 1));
  };
  return {(1 / n) * sum,
          {error(sum.r, squares.r), error(sum.g, squares.g), error(sum.b, squares.b)}};
}

void expect_alike(const ColumnLight& got, const ColumnLight& right, double most_error = 0.01) {
  for (int c = 0; c < 3; ++c) {
    const double error = std::hypot(channel(got.error, c), channel(right.error, c));
    const double wanted = channel(right.mean, c);
    EXPECT_NEAR(channel(got.mean, c), wanted, 0.002 * wanted + 3.5 * error) << c;
    EXPECT_LT(error, most_error * wanted) << c;
  }
}

/// A floor, a sun and an even sky, as in a column. The sky lights the floor as the ambient light of
/// the floor's material.
TEST(Paths, SendWhatAColumnSends) {
  Scene scene = one_way(40);
  scene.sun = Sun{glm::normalize(glm::dvec3(0.3, 0.8, -0.4)), {1, 0.9, 0.8}};
  scene.sky = SkyLight{{0.2, 0.3, 0.5}};
  Column column{.absorption = {.22, .3, .7}, .scattering = {1.5, 1.3, .8}};
  column.view = 40;
  column.sun = std::asin(scene.sun->direction.y) * 180 / kPi;
  column.azimuth = std::atan2(0.3, -0.4) * 180 / kPi;
  column.irradiance = kPi * scene.sun->color;
  column.sky = scene.sky->radiance;
  for (const bool real : {false, true}) {
    for (const double depth : {0.3, 1.0, 100.0}) {
      for (const double g : {0.0, 0.8}) {
        SCOPED_TRACE(testing::Message() << "real " << real << ", depth " << depth << ", g " << g);
        column.real_surface = real;
        column.depth = depth;
        column.bottom = depth < 100 ? Rgb<double>{.5, .3, .7} : Rgb<double>{0, 0, 0};
        column.anisotropy = g;
        const Model model = model_of({level(-depth)}, lambert(column.bottom, column.sky));
        const TruthPicture p = traced(
            model, scene, murky(column.absorption, column.scattering, g, real), with_paths(400));
        expect_alike(mean_of(p), trace_column(column, 60000), 0.03);
      }
    }
  }
}

/// Nothing absorbs light, and the radiance is the same everywhere, also from the reflected sky.
TEST(Paths, KeepAllLightOfAWhiteFurnace) {
  Scene scene = one_way(25);
  scene.sun.reset();
  scene.sky = SkyLight{{1, 1, 1}};
  Model model = model_of({level(-0.7)}, lambert({1, 1, 1}, {1, 1, 1}));
  model.background = {1, 1, 1};
  for (const double g : {0.0, 0.9}) {
    for (const bool real : {false, true}) {
      Look look = murky({0, 0, 0}, {1, 2, .5}, g, real);
      look.of<PrismSplit>().gain = real ? 1 : 0;
      look.of<FresnelReflection>().source = FresnelReflection::Source::kPlanar;
      const ColumnLight light = mean_of(traced(model, scene, look, with_paths(150)));
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(channel(light.mean, c), 1, 0.002 + 3 * channel(light.error, c));
      }
    }
  }
}

/// With little scattering, or with light from the bottom alone, random paths agree with the closed
/// form of single scattering.
TEST(Paths, AgreeWithOneScatteringWhereThereIsLittle) {
  const Scene scene = one_way(50);
  TruthOptions once = with_paths(1);
  once.light = TruthOptions::Light::kOnce;
  for (const bool real : {false, true}) {
    for (const double gain : {0.0, 1.0}) {
      for (const bool murky_water : {false, true}) {
        SCOPED_TRACE(testing::Message()
                     << "real " << real << ", gain " << gain << ", murky " << murky_water);
        const double albedo = murky_water ? 0 : 0.004;
        const Rgb<double> scattering = (murky_water ? 1.0 : 0.0) * Rgb<double>{.002, .003, .001};
        Look look = murky({.4, .6, .9}, scattering, 0.85, real);
        look.of<PrismSplit>().gain = gain;
        const Model model = model_of({level(-1.2)}, lambert({albedo, albedo, albedo}, {0, 0, 0}));
        expect_alike(mean_of(traced(model, scene, look, with_paths(100))),
                     mean_of(traced(model, scene, look, once)));
      }
    }
  }
}

/// The sky is the environment; without an environment the sky of the scene, and without that the
/// ambient light of the look.
TEST(Paths, AreLitByTheSkyThatIsThere) {
  const Model model = model_of({level(-50)}, lambert({0, 0, 0}));
  Scene scene = one_way(40);
  scene.sun.reset();
  Look look = murky({.1, .1, .1}, {1, 1, 1}, 0, true);
  look.of<DepthFog>().ambient = {.1, .2, .4};
  TruthOptions options = with_paths(40);
  const auto seen = [&] { return mean_of(traced(model, scene, look, options)).mean; };
  const Rgb<double> guessed = seen();
  EXPECT_GT(guessed.r, 0.02);
  EXPECT_NEAR(guessed.b, 4 * guessed.r, 1e-6);
  scene.sky = SkyLight{{.4, .2, .1}};
  const Rgb<double> known = seen();
  EXPECT_NEAR(known.r, guessed.b, 1e-6);
  EXPECT_NEAR(known.b, guessed.r, 1e-6);

  // An environment that is bright only straight above: from below only a cone is visible.
  std::array<Plane, 3> planes;
  for (std::size_t c = 0; c < 3; ++c) {
    planes[c] = Plane(Rect{0, 0, 4, 64});
    for_each_pixel({4, 64}, [&](int x, int y) {
      planes[c].view().at(x, y) = y < 32 && c == 0 ? 1 : 0;  // above the horizon, red
    });
    options.environment.channels[c] = planes[c].view();
  }
  const Rgb<double> around = seen();
  EXPECT_NEAR(around.r, known.r / .4, 0.05 * around.r);  // except for the texels at the horizon
  EXPECT_EQ(around.g, 0);
}

/// Light that a model of depth_fog counts as unscattered is scattered here.
TEST(Paths, AreTheSameForEachModelOfTheFog) {
  const Model model = model_of({level(-1)}, lambert({.5, .4, .3}));
  Look look = murky({.2, .1, .05}, {1, 1, 1}, 0.9, true);
  look.of<DepthFog>().ambient = {.1, .2, .3};
  const auto seen = [&](DepthFog::Model fog) {
    look.of<DepthFog>().model = fog;
    return mean_of(traced(model, one_way(40), look, with_paths(4))).mean;
  };
  const Rgb<double> right = seen(DepthFog::Model::kBeerLambert);
  EXPECT_EQ(seen(DepthFog::Model::kRadiativeTransfer), right);
  EXPECT_EQ(seen(DepthFog::Model::kLinear), right);
}

/// A slab over half of the water: light reaches the water under the slab from the side; dry
/// surfaces are as in the raster pass.
TEST(Paths, BringLightUnderShadowsAndLeaveDryPixelsAlone) {
  Mesh slab = quad({-3, 0.02f, -1}, {3, 0.02f, -1}, {3, 0.02f, -9}, {-3, 0.02f, -9});
  slab.uvs.clear();
  const Model model = model_of({level(-30), slab}, lambert({.5, .4, .3}));
  const Scene scene = over_water(35);
  const Look look = murky({.1, .1, .1}, {2, 2, 2}, 0, true);
  TruthOptions once = every_aov();
  const TruthPicture p = traced(model, scene, look, with_paths(8, kTraceSize)),
                     q = traced(model, scene, look, once);
  int dry = 0, brighter = 0, wet = 0;
  for_each_pixel(kTraceSize, [&](int x, int y) {
    if (std::isinf(value(p, Aov::kSurfaceDepth, x, y))) {
      ++dry;
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_EQ(p.target.color[c].at(x, y), q.target.color[c].at(x, y));
      }
    } else {
      ++wet;
      brighter += value(p, Aov::kInScatter, x, y) > value(q, Aov::kInScatter, x, y);
    }
    double sum = 0;
    for (const Aov term : {Aov::kTransmitted, Aov::kInScatter, Aov::kReflected, Aov::kHighlight}) {
      sum += value(p, term, x, y, 1);
    }
    EXPECT_NEAR(sum, p.target.color[1].at(x, y), 1e-6);
  });
  EXPECT_GT(dry, 100);
  EXPECT_GT(brighter, wet * 9 / 10);
}

/// Light that a wall reflects straight to the floor belongs to the ambient light of the floor's
/// material, in the water as in the air.
TEST(Paths, LeaveOutWhatDrySurfacesThrowAtOneAnother) {
  Mesh wall = quad({-30, -2, -3}, {30, -2, -3}, {30, -0.01f, -3}, {-30, -0.01f, -3});
  wall.uvs.clear();
  const Model model = model_of({level(-2), wall}, lambert({.8, .8, .8}, {.2, .2, .2}));
  const Scene scene = one_way(45);
  Look look = murky({0, 0, 0}, {0, 0, 0}, 0, false);
  TruthOptions once = with_paths(1);
  once.light = TruthOptions::Light::kOnce;
  const TruthPicture p = traced(model, scene, look, with_paths(50)),
                     q = traced(model, scene, look, once);
  expect_alike(mean_of(p), mean_of(q), 1e-6);
  // Light that the surface reflects back down belongs to the water.
  look = murky({0, 0, 0}, {0, 0, 0}, 0, true);
  EXPECT_GT(mean_of(traced(model, scene, look, with_paths(50))).mean.g,
            1.1 * mean_of(traced(model, scene, look, once)).mean.g);
}

/// In a basin, light that the surface reflects to the walls reaches the floor by the walls.
TEST(Paths, GoOnFromDrySurfacesToOthersWithWhatTheWaterSends) {
  Scene scene = one_way(90);
  scene.sun->direction = {0, 1, 0};  // along the walls
  const auto seen = [&](double wall_albedo) {
    std::vector<Mesh> meshes{level(-1, 1)};
    for (int side = 0; side < 4; ++side) {
      const double a = side * kPi / 2;
      const glm::vec3 out(std::round(std::sin(a)), 0, std::round(std::cos(a)));
      const glm::vec3 along(out.z, 0, -out.x), up(0, 1, 0);
      meshes.push_back(quad(out + along - up, out - along - up, out - along, out + along));
      meshes.back().uvs.clear();
      meshes.back().material = 1;
    }
    Model model = model_of(meshes, lambert({.8, .8, .8}, {0, 0, 0}));
    model.materials.push_back(lambert({wall_albedo, wall_albedo, wall_albedo}, {0, 0, 0}));
    return mean_of(traced(model, scene, murky({0, 0, 0}, {0, 0, 0}, 0, true), with_paths(200)));
  };
  const double black = seen(0).mean.g, white = seen(.9).mean.g;
  EXPECT_GT(white, 1.03 * black);
  // The surface reflects light at grazing angles, where the black walls block the path.
  const double enters = 1 - fresnel_exact(1.0, kTraceIor);
  const double direct = enters * enters / kTraceIor / kTraceIor * .8 * scene.sun->color.g;
  EXPECT_NEAR(black, direct, 0.02 * direct);
}

/// Beyond the edge of its mesh the water continues.
TEST(Paths, KnowNoEdgeOfASmallMeshOfWater) {
  const Scene scene = one_way(60);
  const Look look = murky({.1, .1, .1}, {.5, .5, .5}, 0.5, true);
  const Model plane = model_of({level(-2)}, lambert({.5, .5, .5}));
  Model mesh = model_of({level(-2), level(0, 3)}, lambert({.5, .5, .5}));
  mesh.instances[1].water = true;
  expect_alike(mean_of(traced(mesh, scene, look, with_paths(200))),
               mean_of(traced(plane, scene, look, with_paths(200))));
}

/// A view from just under the surface has the same radiance before the exit.
TEST(Paths, AreSeenFromTheWaterToo) {
  Scene scene = one_way(60);
  scene.camera->view = glm::translate(scene.camera->view, glm::dvec3(0, 2 + 1e-5, 0));
  const Model model = model_of({level(-60)}, lambert({0, 0, 0}));
  Column column{.absorption = {.2, .2, .2}, .scattering = {1, 1, 1}};
  const Look look = murky(column.absorption, column.scattering, 0, true);
  const double sine = 0.5 * column.ior, cosine = std::sqrt(1 - sine * sine);
  column.sun = std::asin(scene.sun->direction.y) * 180 / kPi;
  column.view = std::asin(cosine) * 180 / kPi;
  column.irradiance = kPi * scene.sun->color;
  ColumnLight air = trace_column(column, 40000);
  const double out = (1 - fresnel_exact(cosine, column.ior)) / (column.ior * column.ior);
  air = {(1 / out) * air.mean, (1 / out) * air.error};
  expect_alike(mean_of(traced(model, scene, look, with_paths(200))), air);
}

/// Without absorption and without a bottom, paths still end, and hardly any light is lost.
TEST(Paths, EndInEndlessWaterThatAbsorbsNothing) {
  Scene scene = one_way(90);
  scene.sun.reset();
  scene.sky = SkyLight{{1, 1, 1}};
  const Model model = model_of({level(-1e6, 1)}, lambert({0, 0, 0}));
  const TruthPicture p = traced(model, scene, murky({0, 0, 0}, {1, 1, 1}, 0, false), with_paths(2));
  EXPECT_NEAR(mean_of(p).mean.g, 1 - fresnel_exact(1.0, kTraceIor), 0.02);
}

TEST(Paths, TellTheirNoise) {
  const Model model = model_of({level(-1)}, lambert({.5, .5, .5}));
  const Scene scene = one_way(45);
  const Look look = murky({.1, .1, .1}, {1, 1, 1}, 0.5, true);
  const TruthPicture few = traced(model, scene, look, with_paths(16)),
                     many = traced(model, scene, look, with_paths(256));
  EXPECT_NEAR(many.relative_error, few.relative_error / 4, 0.05 * few.relative_error);
  // The noise of the pixels, which all look at the same water.
  const ColumnLight spread = mean_of(many);
  const double pixels = std::sqrt(double(kSmall.width) * kSmall.height);
  EXPECT_NEAR(pixels * (spread.error.r + spread.error.g + spread.error.b) /
                  (spread.mean.r + spread.mean.g + spread.mean.b),
              many.relative_error, 0.25 * many.relative_error);
  EXPECT_TRUE(std::isnan(traced(model, scene, look, with_paths(1)).relative_error));
  TruthOptions two = with_paths(1);
  two.samples = 2;
  EXPECT_GT(traced(model, scene, look, two).relative_error, 0);
  two.light = TruthOptions::Light::kOnce;
  two.samples = 1;
  EXPECT_TRUE(std::isnan(traced(model, scene, look, two).relative_error));
}

TEST(Paths, AreTheSameForAnyThreadsAndOthersForEachSeed) {
  const Model model = model_of({level(-1)}, lambert({.5, .5, .5}));
  const Scene scene = over_water(35);
  const Look look = murky({.1, .1, .1}, {1, 1, 1}, 0.5, true);
  TruthOptions options = with_paths(2, kTraceSize);
  const auto sum = [&](int threads) {
    const TruthPicture p = traced(model, scene, look, options, threads);
    std::vector<float> all;
    for_each_pixel(kTraceSize, [&](int x, int y) { all.push_back(p.target.color[1].at(x, y)); });
    return all;
  };
  const std::vector<float> one = sum(1);
  EXPECT_EQ(one, sum(2));
  options.seed = 1;
  EXPECT_NE(one, sum(1));
  options.paths = 0;
  EXPECT_THROW(sum(1), Error);
  options.paths = kMaxTruthPaths + 1;
  EXPECT_THROW(sum(1), Error);
}

}  // namespace
}  // namespace limpid::test
