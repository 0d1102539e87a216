#include <array>

#include <gtest/gtest.h>

#include "judge/trace/trace_scenes.h"
#include "optics/water_index.h"

/// Calm water over a level floor, where all values have closed forms, computed here by hand.

namespace limpid::test {
namespace {

constexpr double kPi = std::numbers::pi;

/// Fresnel's own two formulas.
double reflectance(double cosine, double n) {
  const double inside = std::sqrt(1 - (1 - cosine * cosine) / (n * n));
  const double s = (cosine - n * inside) / (cosine + n * inside);
  const double p = (n * cosine - inside) / (n * cosine + inside);
  return 0.5 * (s * s + p * p);
}

/// The point on the floor where the ray of a pixel ends.
glm::dvec3 bottom_point(const Scene& scene, int x, int y, double depth, double n) {
  const glm::dvec3 eye = scene.camera->eye(), d = view_through(scene, x, y);
  const glm::dvec3 surface = eye - (eye.y / d.y) * d;
  const double sine = std::sqrt(1 - d.y * d.y) / n, cosine = std::sqrt(1 - sine * sine);
  const glm::dvec3 flat(d.x, 0, d.z);
  const double level = glm::length(flat);
  return surface + glm::dvec3(0, -depth, 0) +
         (level > 0 ? depth * sine / cosine / level : 0) * flat;
}

TEST(FlatWater, LooksThreeQuartersAsDeepFromStraightAbove) {
  const Model model = model_of({level(-1)});
  const Scene scene = over_water(90);
  const TruthPicture p = traced(model, scene, calm_look());
  // Beside the middle pixel: the view meets the floor at a smaller angle than without water.
  const double u = value(p, Aov::kStmapG, 17, 12),
               tangent = view_through(scene, 17, 12).x / -view_through(scene, 17, 12).y;
  const double half_width = 1 / scene.camera->projection[0][0];
  const double to_floor = (2 * u - 1) * half_width * 3;  // from the middle, 2 + 1 below the eye
  EXPECT_NEAR(to_floor / tangent - 2, 0.750, 5e-4);
  EXPECT_NEAR(value(p, Aov::kPath, 16, 12), 1, 1e-6);
  EXPECT_NEAR(value(p, Aov::kFresnel, 16, 12), 0.0204, 5e-5);
}

TEST(FlatWater, RaysEndWhereSnellSaysAtEveryPixel) {
  const Model model = model_of({level(-1.5)});
  for (double degrees : {90.0, 50.0, 25.0}) {
    const Scene scene = over_water(degrees);
    const TruthPicture p = traced(model, scene, calm_look());
    int inside = 0;
    for_each_pixel(kTraceSize, [&](int x, int y) {
      if (view_through(scene, x, y).y > -0.05) return;
      const glm::dvec3 end = bottom_point(scene, x, y, 1.5, kTraceIor);
      const glm::dvec2 at = place_of(scene, end);
      EXPECT_NEAR(value(p, Aov::kStmapG, x, y, 0), at.x, 2e-6);
      EXPECT_NEAR(value(p, Aov::kStmapG, x, y, 1), at.y, 2e-6);
      const bool in_frame = at.x >= 0 && at.x <= 1 && at.y >= 0 && at.y <= 1;
      EXPECT_EQ(p.visible[1].at(x, y), in_frame);
      inside += in_frame;
      const glm::dvec3 eye = scene.camera->eye(), d = view_through(scene, x, y);
      const glm::dvec3 surface = eye - (eye.y / d.y) * d;
      EXPECT_NEAR(value(p, Aov::kPath, x, y), glm::length(end - surface), 2e-5);
    });
    EXPECT_GT(inside, 100) << degrees;
  }
}

/// The check numbers of the optics: per metre of depth, at these angles of view.
TEST(FlatWater, ObliqueShiftsAndPathsAreTheKnownOnes) {
  const struct {
    double degrees, straight_error, path_ratio, red_to_blue_mm;
  } rows[] = {
      {30, .173, 1.07, 2.8}, {45, .375, 1.20, 5.2}, {60, .879, 1.52, 8.7}, {75, 2.68, 2.66, 13.1}};
  const Model model = model_of({level(-1)});
  Look look = calm_look();
  look.of<PrismSplit>().gain = 1;
  look.water.ior = water_index_rgb().g;
  for (const auto& row : rows) {
    const Scene scene = over_water(90 - row.degrees);
    const TruthPicture p = traced(model, scene, look);
    const glm::dvec3 d = view_through(scene, 16, 12);
    ASSERT_NEAR(std::acos(-d.y) * 180 / kPi, row.degrees, 1e-6);
    // From a position in the picture back to the floor.
    const auto floor_at = [&](Aov map) {
      const double v = value(p, map, 16, 12, 1), u = value(p, map, 16, 12, 0);
      const Rays rays = rays_of(*scene.camera, {kTraceSize.width, kTraceSize.height});
      const glm::dvec3 ray = rays.ray_at(u * kTraceSize.width, (1 - v) * kTraceSize.height);
      return scene.camera->eye() - (3 / ray.y) * ray;
    };
    const double tangent = std::tan(row.degrees * kPi / 180);
    const double straight_end = scene.camera->eye().z - 3 * tangent;
    const double bent_end = floor_at(Aov::kStmapG).z;
    EXPECT_NEAR(bent_end - straight_end, row.straight_error, 0.005 * row.straight_error);
    EXPECT_NEAR(std::sqrt(1 + tangent * tangent) / value(p, Aov::kPath, 16, 12), row.path_ratio,
                0.008);  // known for the index 1.333
    const double apart = floor_at(Aov::kStmapB).z - floor_at(Aov::kStmapR).z;
    EXPECT_NEAR(1e3 * apart, row.red_to_blue_mm, 0.06);
  }
}

struct Water {
  DepthFog::Sunlight sunlight;
  DepthFog::Crossing crossing;
};

class FlatWaterLight : public testing::TestWithParam<Water> {};

INSTANTIATE_TEST_SUITE_P(
    Switches, FlatWaterLight,
    testing::Values(Water{DepthFog::Sunlight::kNone, DepthFog::Crossing::kNone},
                    Water{DepthFog::Sunlight::kStraight, DepthFog::Crossing::kNone},
                    Water{DepthFog::Sunlight::kRefracted, DepthFog::Crossing::kNone},
                    Water{DepthFog::Sunlight::kRefracted, DepthFog::Crossing::kRadiance}));

TEST_P(FlatWaterLight, IsTheClosedForm) {
  const Rgb<double> base{0.8, 0.6, 0.4}, a{0.42, 0.085, 0.055}, b{0.1, 0.12, 0.14},
      sky{0.3, 0.4, 0.5}, around{0.1, 0.2, 0.3};
  constexpr double kDepth = 1.5, g = 0.6, n = kTraceIor;
  Look look = calm_look();
  look.of<FresnelReflection>().color = sky;
  DepthFog::Params& fog = look.of<DepthFog>();
  fog.water_type = WaterType::kCustom;
  fog.absorption = a;
  fog.scattering = b;
  fog.ambient = around;
  fog.anisotropy = g;
  fog.sunlight = GetParam().sunlight;
  fog.crossing = GetParam().crossing;
  const bool refracts = fog.sunlight == DepthFog::Sunlight::kRefracted;
  const bool crosses = fog.crossing == DepthFog::Crossing::kRadiance;

  const Scene scene = over_water(40);
  const TruthPicture p = traced(model_of({level(-kDepth)}, lambert(base)), scene, look);
  const glm::dvec3 sun = scene.sun->direction;
  const double sun_cosine = sun.y, sun_inside = std::sqrt(1 - (1 - sun.y * sun.y) / (n * n));
  const double sun_lost = reflectance(sun_cosine, n);
  const glm::dvec3 in_water = refracts ? glm::dvec3(sun.x / n, sun_inside, sun.z / n) : sun;
  for_each_pixel(kTraceSize, [&](int x, int y) {
    const glm::dvec3 d = view_through(scene, x, y);
    if (d.y > -0.1) return;
    const double cosine = -d.y, inside = std::sqrt(1 - (1 - cosine * cosine) / (n * n));
    const double path = kDepth / inside, f = reflectance(cosine, n);
    const glm::dvec3 bent(d.x / n, -inside, d.z / n);
    const double turned = glm::dot(bent, in_water);
    const double phase = (1 - g * g) / (4 * kPi * std::pow(1 + g * g - 2 * g * turned, 1.5));
    for (int c = 0; c < 3; ++c) {
      const double rate = channel(a, c) + channel(b, c);
      const double falling = channel(a, c) + (1 - g) * channel(b, c);
      const double down = fog.sunlight == DepthFog::Sunlight::kNone ? 0
                          : refracts                                ? falling / sun_inside
                                                                    : falling / sun_cosine;
      const double color = channel(scene.sun->color, c);
      const double dry = channel(base, c) * (0.2 + sun_cosine * color);
      const double bottom = crosses ? (1 - sun_lost) / (n * n) : 1;
      const double through = (1 - f) * bottom * std::exp(-rate * path - down * kDepth) * dry;
      const double total = rate + down * inside;
      double sunlight = kPi * color * channel(b, c) * phase;
      if (refracts) sunlight *= (1 - sun_lost) * sun_cosine / sun_inside;
      if (crosses) sunlight /= n * n;
      const double glow =
          (1 - f) * (sunlight * (1 - std::exp(-total * path)) / total +
                     channel(b, c) * channel(around, c) * (1 - std::exp(-rate * path)) / rate);
      EXPECT_NEAR(value(p, Aov::kTransmitted, x, y, c), through, 1e-6);
      EXPECT_NEAR(value(p, Aov::kInScatter, x, y, c), glow, 1e-6);
      EXPECT_NEAR(value(p, Aov::kReflected, x, y, c), f * channel(sky, c), 1e-6);
      EXPECT_NEAR(value(p, Aov::kTransmittance, x, y, c), std::exp(-rate * path), 1e-6);
      EXPECT_NEAR(p.target.color[static_cast<std::size_t>(c)].at(x, y),
                  through + glow + f * channel(sky, c), 2e-6);
    }
  });
}

/// The water of the path-traced pictures in data/plates/lagoon (its README): absorption .42 .085
/// .055, no scattering, the sun's path down straight and without loss at the surface, radiance not
/// scaled at the exit. Seen at 60 degrees, a sun 27 degrees high, a metre of water, by hand: .9403
/// of the light passes the surface, 1.3155 m is the view's path, 2.2027 m that of the sun.
TEST(FlatWater, HasTheConventionsOfTheLagoonsTruth) {
  Look look = calm_look();
  DepthFog::Params& fog = look.of<DepthFog>();
  fog.water_type = WaterType::kCustom;
  fog.absorption = {0.42, 0.085, 0.055};
  fog.scattering = fog.ambient = {0, 0, 0};
  fog.sunlight = DepthFog::Sunlight::kStraight;
  fog.crossing = DepthFog::Crossing::kNone;
  Scene scene = over_water(30);
  scene.sun = Sun{{0, 0.453990, 0.891007}, {1, 0.93, 0.82}};
  const TruthPicture p = traced(model_of({level(-1)}, lambert({0.8, 0.8, 0.8})), scene, look);
  EXPECT_NEAR(value(p, Aov::kPath, 16, 12), 1.3155, 1e-4);
  EXPECT_NEAR(value(p, Aov::kTransmitted, 16, 12, 0), 0.1123, 1e-4);
  EXPECT_NEAR(value(p, Aov::kTransmitted, 16, 12, 1), 0.3471, 1e-4);
  EXPECT_NEAR(value(p, Aov::kTransmitted, 16, 12, 2), 0.3548, 1e-4);
}

TEST(FlatWater, MirrorsTheEnvironmentThatTheLookAsksFor) {
  std::array<Plane, 3> planes;
  TruthOptions options = every_aov();
  for (std::size_t c = 0; c < 3; ++c) {  // brighter towards straight up, which is row 0
    planes[c] = Plane(Rect{0, 0, 8, 64});
    for_each_pixel({8, 64}, [&](int x, int y) {
      planes[c].view().at(x, y) = static_cast<float>((64 - y - 0.5) / 64 + double(c));
    });
    options.environment.channels[c] = planes[c].view();
  }
  Look look = calm_look();
  look.of<FresnelReflection>().source = FresnelReflection::Source::kEnvironment;
  const Scene scene = over_water(40);
  const TruthPicture p = traced(model_of({level(-1)}), scene, look, options);
  for_each_pixel(kTraceSize, [&](int x, int y) {
    const glm::dvec3 d = view_through(scene, x, y);
    const double turns = std::acos(-d.y) / kPi, f = value(p, Aov::kFresnel, x, y);
    EXPECT_NEAR(value(p, Aov::kReflected, x, y, 0), f * (1 - turns), 1e-6);
    EXPECT_NEAR(value(p, Aov::kReflected, x, y, 2), f * (3 - turns), 1e-6);
  });
}

/// Murky water with in-scatter of sunlight only; sunlight travels straight down from any point
/// under the calm plane.
Look murky_look(const Rgb<double>& rate) {
  Look look = calm_look();
  DepthFog::Params& fog = look.of<DepthFog>();
  fog.water_type = WaterType::kCustom;
  fog.absorption = 0.5 * rate;
  fog.scattering = 0.5 * rate;
  fog.ambient = {0, 0, 0};
  fog.anisotropy = 0;
  fog.sunlight = DepthFog::Sunlight::kStraight;
  fog.crossing = DepthFog::Crossing::kNone;
  return look;
}

/// Under a crest sunlight has no loss above the level of the calm plane. Seen from above, and from
/// the water, on rays that go down, and on rays that rise into the crest.
TEST(FlatWater, LosesNoSunlightAboveTheCalmPlane) {
  constexpr double kCrest = 0.5, kDepth = 1.5;
  const Rgb<double> rate{0.8, 0.4, 0.2};
  Model model = model_of({level(-kDepth), level(kCrest)});
  model.instances[1].water = true;
  for (const double degrees : {60.0, -40.0}) {
    Scene scene = over_water(degrees);
    scene.sun->direction = {0, 1, 0};
    const double eye = degrees < 0 ? -1 : 2;
    scene.camera->view = glm::translate(scene.camera->view, glm::dvec3(0, 2 - eye, 0));
    const TruthPicture p = traced(model, scene, murky_look(rate));
    int seen = 0;
    for_each_pixel(kTraceSize, [&](int x, int y) {
      const glm::dvec3 d = view_through(scene, x, y);
      if (d.y * degrees > -0.2 * std::abs(degrees)) return;
      ++seen;
      const double n = kTraceIor, f = eye > 0 ? reflectance(-d.y, n) : 0;
      const double slope = eye > 0 ? std::sqrt(1 - (1 - d.y * d.y) / (n * n)) : d.y;
      for (int c = 0; c < 3; ++c) {
        const double r = channel(rate, c);
        double column = 0;  // length of a lossless path with the same in-scatter
        if (eye > 0) {
          const double above = kCrest / slope, below = kDepth / slope, total = r + r * slope;
          column = (1 - std::exp(-r * above)) / r +
                   std::exp(-r * above) * (1 - std::exp(-total * below)) / total;
        } else {
          // Sunlight at depth 1 - slope s: e^-r of it is left at the eye.
          const double below = 1 / slope, above = kCrest / slope, total = r - r * slope;
          column = std::exp(-r) * (1 - std::exp(-total * below)) / total +
                   std::exp(-r * below) * (1 - std::exp(-r * above)) / r;
        }
        const double sun = kPi * channel(scene.sun->color, c) * 0.5 * r / (4 * kPi);
        EXPECT_NEAR(value(p, Aov::kInScatter, x, y, c), (1 - f) * sun * column, 1e-6);
      }
    });
    EXPECT_GT(seen, 300) << degrees;
  }
}

/// Index 1 and a gain that makes the index of red 0.6: no red light of a low sun enters the water,
/// and none leaves towards a low view.
TEST(FlatWater, LetsNoLightInBeyondTheCriticalAngleOfABand) {
  Look look = murky_look({0.5, 0.5, 0.5});
  look.water.ior = 1;
  look.of<PrismSplit>().gain = 100;
  look.of<DepthFog>().sunlight = DepthFog::Sunlight::kRefracted;
  for (const auto crossing : {DepthFog::Crossing::kNone, DepthFog::Crossing::kRadiance}) {
    look.of<DepthFog>().crossing = crossing;
    for (const double degrees : {80.0, 15.0}) {
      Scene scene = over_water(degrees);
      scene.sun->direction = glm::normalize(glm::dvec3(0.3, 0.1, -0.9));
      const TruthPicture p = traced(model_of({level(-1)}, lambert({0.5, 0.5, 0.5})), scene, look);
      int green = 0;
      for_each_pixel(kTraceSize, [&](int x, int y) {
        for (const Plane& plane : p.planes) EXPECT_FALSE(std::isnan(plane.view().at(x, y)));
        if (view_through(scene, x, y).y > -0.05) return;
        EXPECT_EQ(value(p, Aov::kInScatter, x, y, 0), 0);
        EXPECT_LT(value(p, Aov::kTransmitted, x, y, 0), 1e-6);
        green += value(p, Aov::kInScatter, x, y, 1) > 0 && value(p, Aov::kTransmitted, x, y, 1) > 0;
      });
      EXPECT_GT(green, 300) << degrees;
    }
  }
}

/// As in the chain, a sun just above the horizon gives no light: no division by zero.
TEST(FlatWater, ASunOnTheHorizonCountsAsNone) {
  Scene scene = over_water(40);
  scene.sun->direction = glm::normalize(glm::dvec3(0, 5e-7, -1));
  const Look look = murky_look({0.5, 0.5, 0.5});
  const TruthPicture p = traced(model_of({level(-1)}, lambert({0.5, 0.5, 0.5})), scene, look);
  scene.sun.reset();
  const TruthPicture night = traced(model_of({level(-1)}, lambert({0.5, 0.5, 0.5})), scene, look);
  for_each_pixel(kTraceSize, [&](int x, int y) {
    EXPECT_EQ(value(p, Aov::kInScatter, x, y), 0);
    EXPECT_NEAR(value(p, Aov::kTransmitted, x, y), value(night, Aov::kTransmitted, x, y), 1e-6);
  });
}

/// White surroundings and no absorption: the picture is white.
TEST(FlatWater, KeepsAllLightOfAWhiteFurnace) {
  Model model = model_of({level(-1)}, white(Shading::kFlat));
  model.background = {1, 1, 1};
  Look look = calm_look();
  look.of<PrismSplit>().gain = 1;
  look.of<FresnelReflection>().source = FresnelReflection::Source::kPlanar;
  DepthFog::Params& fog = look.of<DepthFog>();
  fog.water_type = WaterType::kCustom;
  fog.absorption = fog.scattering = {0, 0, 0};
  fog.crossing = DepthFog::Crossing::kNone;
  for (double height : {2.0, -0.5}) {  // from the air and from the water
    Scene scene = over_water(20);
    scene.water->height = 2 - height;
    model.meshes[0] = level(1 - height);
    const TruthPicture p = traced(model, scene, look);
    for_each_pixel(kTraceSize, [&](int x, int y) {
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(p.target.color[c].at(x, y), 1, 1e-6);
    });
  }
}

/// From below: inside the critical angle the view is refracted into the air; outside of it the
/// surface reflects all light of the floor.
TEST(FlatWater, MirrorsTotallyBeyondTheCriticalAngle) {
  Model model = model_of({level(-3)}, white(Shading::kFlat));
  model.background = {0, 0, 1};
  Look look = calm_look();
  look.of<FresnelReflection>().source = FresnelReflection::Source::kPlanar;
  DepthFog::Params& fog = look.of<DepthFog>();
  fog.water_type = WaterType::kCustom;
  fog.absorption = {0.1, 0.2, 0};
  fog.scattering = {0, 0, 0};
  fog.sunlight = DepthFog::Sunlight::kNone;
  Scene scene = over_water(-45);
  scene.camera->view = glm::translate(scene.camera->view, glm::dvec3(0, 3, 0));  // 1 below
  const TruthPicture p = traced(model, scene, look);
  int total = 0, through = 0;
  for_each_pixel(kTraceSize, [&](int x, int y) {
    const glm::dvec3 d = view_through(scene, x, y);
    if (d.y < 0.1) return;
    const double degrees = std::acos(d.y) * 180 / kPi;
    if (std::abs(degrees - 48.61) < 0.05) return;
    if (degrees > 48.61) {
      ++total;
      EXPECT_EQ(value(p, Aov::kFresnel, x, y), 1);
      EXPECT_EQ(value(p, Aov::kTransmitted, x, y, 2), 0);
      // 1 up to the surface, 3 down to the floor.
      EXPECT_NEAR(value(p, Aov::kReflected, x, y, 0), std::exp(-0.1 * 4 / d.y), 1e-6);
      EXPECT_NEAR(value(p, Aov::kReflected, x, y, 2), 1, 1e-6);
      EXPECT_NEAR(value(p, Aov::kStmapG, x, y, 0), (x + 0.5) / kTraceSize.width, 1e-6);
    } else {
      ++through;
      const double out = std::sqrt(1 - (1 - d.y * d.y) * kTraceIor * kTraceIor);
      const double f = reflectance(out, kTraceIor);
      EXPECT_NEAR(value(p, Aov::kFresnel, x, y), f, 1e-6);
      EXPECT_NEAR(value(p, Aov::kTransmitted, x, y, 2), 1 - f, 1e-6);
      EXPECT_NEAR(value(p, Aov::kReflected, x, y, 1), f * std::exp(-0.2 * 4 / d.y), 1e-6);
    }
    EXPECT_NEAR(value(p, Aov::kPath, x, y), 1 / d.y, 1e-5);
  });
  EXPECT_GT(total, 100);
  EXPECT_GT(through, 100);
}

}  // namespace
}  // namespace limpid::test
