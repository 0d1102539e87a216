#include <gtest/gtest.h>

#include "judge/trace/trace_scenes.h"

/// The sun's shadow on the bottom, in the water and on the surface.

namespace limpid::test {
namespace {

constexpr double kPi = std::numbers::pi, kDepth = 2, kSlabHeight = 0.5;

/// A floor under the water and a slab over it that covers all x < 0.
Model half_covered(Rgb<double> color = {0.5, 0.5, 0.5}) {
  const float h = kSlabHeight, r = 100;
  Mesh slab = quad({-r, h, r}, {0, h, r}, {0, h, -r}, {-r, h, -r});
  slab.material = 0;
  // The slab is visible from below only; both sides cast shadows.
  return model_of({level(-kDepth), slab}, lambert(color));
}

/// Looks straight down from position x, from under the slab, so that the slab hides nothing.
Scene beside_slab(const glm::dvec3& to_sun, double x) {
  Scene scene = over_water(90);
  scene.camera->view =
      glm::lookAt(glm::dvec3(x, 0.4, 0), glm::dvec3(x, -1, 0), glm::dvec3(0, 0, -1));
  scene.sun = Sun{glm::normalize(to_sun), {2, 2, 2}};
  return scene;
}

Look with_medium(DepthFog::Sunlight sunlight, Rgb<double> scattering) {
  Look look = calm_look();
  DepthFog::Params& fog = look.of<DepthFog>();
  fog.water_type = WaterType::kCustom;
  fog.absorption = {0.3, 0.2, 0.1};
  fog.scattering = scattering;
  fog.ambient = {0, 0, 0};
  fog.anisotropy = 0;
  fog.sunlight = sunlight;
  fog.crossing = DepthFog::Crossing::kNone;
  return look;
}

TEST(TracedShadow, LiesOnTheBottomWhereTheSunsRefractedWayPutsIt) {
  const glm::dvec3 to_sun = glm::normalize(glm::dvec3(-0.6, 1, 0));
  const Scene scene = beside_slab(to_sun, 1.3);
  const double sine = -to_sun.x, inside = std::sqrt(1 - sine * sine / (kTraceIor * kTraceIor));
  const double in_air = kSlabHeight * sine / to_sun.y;
  const struct {
    DepthFog::Sunlight sunlight;
    double edge;
  } cases[] = {{DepthFog::Sunlight::kStraight, in_air + kDepth * sine / to_sun.y},
               {DepthFog::Sunlight::kRefracted, in_air + kDepth * sine / kTraceIor / inside}};
  for (const auto& c : cases) {
    const TruthPicture p = traced(half_covered(), scene, with_medium(c.sunlight, {0, 0, 0}));
    int lit = 0, dark = 0;
    for_each_pixel(kTraceSize, [&](int x, int y) {
      const glm::dvec3 d = view_through(scene, x, y);
      const double ratio = std::sqrt((1 - (1 - d.y * d.y) / (kTraceIor * kTraceIor)));
      const double at = 1.3 + d.x * (0.4 / -d.y + kDepth / kTraceIor / ratio);
      if (std::abs(at - c.edge) < 1e-4) return;
      // The light without the losses on the paths: red divided by transmittance and reflection.
      const double f = value(p, Aov::kFresnel, x, y);
      const double seen =
          value(p, Aov::kTransmitted, x, y) / value(p, Aov::kTransmittance, x, y) / (1 - f);
      const double cosine = c.sunlight == DepthFog::Sunlight::kRefracted ? inside : to_sun.y;
      const double down = std::exp(-0.3 * kDepth / cosine);
      const bool in_sun = at > c.edge;
      EXPECT_NEAR(seen, down * 0.5 * (0.2 + (in_sun ? 2 * to_sun.y : 0)), 1e-6);
      (in_sun ? lit : dark) += 1;
    });
    EXPECT_GT(lit, 50);
    EXPECT_GT(dark, 50);
  }
}

/// A vertical sun: the water scatters light at x > 0 only, and only that part of a slanting view
/// counts.
TEST(TracedShadow, TheGlowOfTheWaterIsThatOfItsSunlitPart) {
  Scene scene = beside_slab({0, 1, 0}, 0.2);
  scene.camera->view =
      glm::lookAt(glm::dvec3(0.5, 0.3, 0), glm::dvec3(0, -0.3, 0), glm::dvec3(0, 1, 0));
  const Rgb<double> b{0.2, 0.2, 0.2};
  const TruthPicture p =
      traced(half_covered(), scene, with_medium(DepthFog::Sunlight::kStraight, b));
  int partly = 0;
  double sum = 0, expected = 0;
  for_each_pixel(kTraceSize, [&](int x, int y) {
    const glm::dvec3 d = view_through(scene, x, y);
    if (d.y > -0.3) return;
    const double entry = 0.5 + d.x * (0.3 / -d.y);
    if (entry < 0) return;
    const double inside = std::sqrt(1 - (1 - d.y * d.y) / (kTraceIor * kTraceIor));
    const double distance = kDepth / inside;
    const double sunlit = d.x < 0 ? std::min(distance, entry * kTraceIor / -d.x) : distance;
    const double rate = 0.3 + 0.2, total = rate + rate * inside;
    const double f = value(p, Aov::kFresnel, x, y);
    const auto glow = [&](double length) {
      return (1 - f) * kPi * 2 * 0.2 / (4 * kPi) * (1 - std::exp(-total * length)) / total;
    };
    // 32 positions on each path, of equal light: half of the light of one position may be missed.
    EXPECT_NEAR(value(p, Aov::kInScatter, x, y), glow(sunlit), glow(distance) / 63);
    partly += sunlit < distance;
    sum += value(p, Aov::kInScatter, x, y);
    expected += glow(sunlit);
  });
  EXPECT_GT(partly, 200);
  EXPECT_NEAR(sum, expected, 2e-3 * expected);
}

TEST(TracedShadow, NoGlintOnTheSurfaceInShadow) {
  const glm::dvec3 to_sun = glm::normalize(glm::dvec3(-0.3, 1, 0));
  const Scene scene = beside_slab(to_sun, 0.2);
  Look look = with_medium(DepthFog::Sunlight::kStraight, {0, 0, 0});
  look.of<SunHighlight>().strength = 1;
  look.of<SunHighlight>().roughness = 0.5;
  const TruthPicture p = traced(half_covered(), scene, look);
  const double edge = kSlabHeight * 0.3;
  int lit = 0, dark = 0;
  for_each_pixel(kTraceSize, [&](int x, int y) {
    const glm::dvec3 d = view_through(scene, x, y);
    const double at = 0.2 + 0.4 * d.x / -d.y;
    if (std::abs(at - edge) < 1e-4) return;
    const double glint = value(p, Aov::kHighlight, x, y);
    EXPECT_EQ(glint > 0, at > edge);
    (glint > 0 ? lit : dark) += 1;
  });
  EXPECT_GT(lit, 50);
  EXPECT_GT(dark, 50);
}

}  // namespace
}  // namespace limpid::test
