#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "complete/completer.h"
#include "ops/depth_fog_kernel.h"
#include "ops/water_light.h"
#include "ops/water_shadow_kernel.h"
#include "optics/refract.h"
#include "optics/waves.h"
#include "sanitized.h"
#include "support.h"

// Shafts of light beside photons that are followed down through the waves and scattered once.

namespace limpid {
namespace {

constexpr double kIor = 1.333, kCell = 0.02;
constexpr int kSide = 96, kBorder = 12;  // pixels of a side; border pixels that are not judged
constexpr int kTexels = 320, kDepths = 24;

std::vector<SineWave> waves_of(double slope) {
  std::vector<SineWave> waves;
  const double lengths[] = {1.3, 0.9, 0.62, 0.43, 0.35, 0.27};
  for (int i = 0; i < 6; ++i) {
    const double k = 2 * std::numbers::pi / lengths[i], angle = 2.4 * i;
    waves.push_back({.amplitude = slope * std::sqrt(2.0 / 6) / k,
                     .k_x = k * std::cos(angle),
                     .k_y = k * std::sin(angle),
                     .phase = 1.7 * i,
                     .omega = std::sqrt(9.81 * k)});
  }
  return waves;
}

/// Murky water over a level bottom, under a sun 50 degrees high, seen by an orthographic camera
/// from `from`, a pixel 2 cm wide.
struct Murk {
  double slope = 0.06, deep = 3, scattering = 0.5;
  glm::dvec3 from{0, 1, 0};

  static glm::dvec3 sun() {
    const double rise = 50 * std::numbers::pi / 180;
    return {std::cos(rise), std::sin(rise), 0};
  }
  Scene scene() const {
    Scene scene;
    Camera camera;
    camera.view = glm::lookAt(9.0 * from, glm::dvec3(0), glm::dvec3(0, 0, -1));
    camera.projection = orthographic(kSide * kCell, kSide * kCell, 0.1, 50, ClipSpace::kGl);
    scene.camera = camera;
    scene.water = WaterPlane{.waves = waves_of(slope)};
    scene.sun = Sun{.direction = sun(), .color = {3, 3, 3}};
    return scene;
  }
  test::Buffers buffers() const {
    const Camera camera = *scene().camera;
    test::Buffers buffers(rect_of({kSide, kSide}));
    for (int c = 0; c < 3; ++c) buffers.fill(plane_after(PlaneId::kColorR, c), 0.0f);
    const Rays rays = rays_of(camera, {kSide, kSide});
    buffers.set(PlaneId::kDepth, [&](int x, int y) {
      const double above = 9 * from.y + rays.origin_at(x + 0.5, y + 0.5).y;
      return static_cast<float>((deep + above) / -rays.ray_at(x + 0.5, y + 0.5).y);
    });
    return buffers;
  }
  Look look(double shafts) const {
    Look look = test::still_look();
    look.of<WaveNormals>().model = WaveNormals::Model::kSines;
    look.of<WaveNormals>().strength = 1;
    look.of<Refraction>().model = Refraction::Model::kSnell;
    DepthFog::Params& fog = look.of<DepthFog>();
    fog = test::plain_fog(DepthFog::Model::kBeerLambert);
    fog.absorption = {0.3, 0.3, 0.3};
    fog.scattering = {scattering, scattering, scattering};
    fog.ambient = {0, 0, 0};
    fog.distance = DepthFog::Distance::kRefracted;
    fog.sunlight = DepthFog::Sunlight::kRefracted;
    look.of<WaterShadow>() = {
        .model = WaterShadow::Model::kScatter, .strength = 1, .shafts = shafts};
    return look;
  }
};

using Picture = std::vector<double>;  // kSide x kSide

/// The operator's scattered light over the scattered light without shafts.
Picture made(const Murk& murk) {
  const Scene scene = murk.scene();
  const test::Buffers buffers = murk.buffers();
  const test::Picture with = test::reference(murk.look(1), buffers.frame, scene);
  const test::Picture without = test::reference(murk.look(0), buffers.frame, scene);
  Picture ratio;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      ratio.push_back(with.aov(Aov::kInScatter, x, y, 1) / without.aov(Aov::kInScatter, x, y, 1));
    }
  }
  return ratio;
}

/// The same ratio by photons, 6 mm apart, that are counted at many depths.
Picture followed(const Murk& murk) {
  const Scene scene = murk.scene();
  test::Buffers buffers(rect_of({kSide, kSide}));
  const Look look = murk.look(1);
  const DepthFog::Params& fog = look.of<DepthFog>();
  const Pass pass(scene, buffers.frame, kIor, kWholeState, {true, scene.water->waves, 1});
  const double down = water_light(fog, pass, kIor).down.g;
  const double rate = Kernel<DepthFog>::extinction(fog).g;
  const auto in_map = [&](const glm::dvec3& v) {
    return glm::dvec2(glm::dot(pass.map_x, v), glm::dot(pass.map_y, v));
  };
  const glm::dvec2 level = in_map(murk.sun());
  const double rise = murk.sun().y, sink = refracted_cosine(rise, 1 / kIor);
  const glm::dvec2 aside = level * (-1 / (kIor * sink));
  const double view_sink = refracted_cosine(murk.from.y, 1 / kIor);
  const glm::dvec2 view = in_map(murk.from) * (-1 / (kIor * view_sink));
  // The point at which the eye's axis meets the calm surface, in coordinates of the waves.
  const glm::dvec2 eye = in_map(9.0 * murk.from);

  const double fades = rate / view_sink + down, most = std::min(murk.deep, 4 / fades);
  std::vector<Picture> light(kDepths, Picture(kTexels * kTexels));
  constexpr double kStep = 0.006;
  const double side = kTexels * kCell;
  const int count = static_cast<int>((side + 1) / kStep);
  const auto depth_of = [&](int k) { return (k + 0.5) / kDepths * most; };
  for (int row = 0; row < count; ++row) {
    for (int column = 0; column < count; ++column) {
      const double x = (column + 0.5) * kStep - (side + 1) / 2,
                   y = (row + 0.5) * kStep - (side + 1) / 2;
      const WaveHeight w = wave_height(scene.water->waves, x, y, scene.time);
      const double length = std::sqrt(1 + w.slope_x * w.slope_x + w.slope_y * w.slope_y);
      const Vec3<double> normal{-w.slope_x / length, -w.slope_y / length, 1 / length};
      const Vec3<double> from{level.x, level.y, rise};
      const Vec3<double> in = refract(from, normal, 1 / kIor).direction;
      const double power = dot(from, normal) * length / rise * kStep * kStep / (kCell * kCell);
      for (int k = 0; k < kDepths; ++k) {
        const double depth = depth_of(k), far = -(depth + w.height) / in.z;
        const double at_x = (x + far * in.x - depth * aside.x) / kCell + kTexels / 2;
        const double at_y = (y + far * in.y - depth * aside.y) / kCell + kTexels / 2;
        if (!(at_x >= 0 && at_y >= 0 && at_x < kTexels && at_y < kTexels)) continue;
        light[k][static_cast<int>(at_y) * kTexels + static_cast<int>(at_x)] += power;
      }
    }
  }
  Picture seen;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const glm::dvec3 origin = pass.rays.origin_at(x + 0.5, y + 0.5);
      const glm::dvec3 ray = pass.rays.ray_at(x + 0.5, y + 0.5);
      const double begin = (9 * murk.from.y + origin.y) / -ray.y;
      const glm::dvec2 enters = eye + in_map(origin + begin * ray);
      double sum = 0, weights = 0;
      for (int k = 0; k < kDepths; ++k) {
        const double depth = depth_of(k), weight = std::exp(-fades * depth);
        const glm::dvec2 at = (enters + depth * (view - aside)) / kCell + kTexels / 2.0 - 0.5;
        const auto texel_x = static_cast<int>(std::floor(at.x)),
                   texel_y = static_cast<int>(std::floor(at.y));
        const double u = at.x - texel_x, v = at.y - texel_y;
        const double* texel = light[k].data() + texel_y * kTexels + texel_x;
        const double here = (1 - v) * ((1 - u) * texel[0] + u * texel[1]) +
                            v * ((1 - u) * texel[kTexels] + u * texel[kTexels + 1]);
        sum += weight * (1 + std::exp(-murk.scattering / sink * depth) * (here - 1));
        weights += weight;
      }
      seen.push_back(sum / weights);
    }
  }
  return seen;
}

/// Blurred by a Gaussian of a pixel and a half: photons are grainy.
Picture blurred(const Picture& picture) {
  const auto along = [](const Picture& from, int step_x, int step_y) {
    Picture to(from.size());
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        double sum = 0, weights = 0;
        for (int k = -5; k <= 5; ++k) {
          const int column = x + k * step_x, row = y + k * step_y;
          if (column < 0 || row < 0 || column >= kSide || row >= kSide) continue;
          const double weight = std::exp(-k * k / 4.5);
          sum += weight * from[row * kSide + column], weights += weight;
        }
        to[y * kSide + x] = sum / weights;
      }
    }
    return to;
  };
  return along(along(picture, 1, 0), 0, 1);
}

struct Beside {
  double error = 0, contrast = 0, made_contrast = 0, likeness = 0, energy = 0;
};

/// Root mean squares, over calm light; the correlation; the operator's energy over that of the
/// truth.
Beside beside(const Murk& murk) {
  const Picture truth = blurred(followed(murk)), got = blurred(made(murk));
  double count = 0, mean = 0, got_mean = 0;
  const auto each = [&](auto&& visit) {
    for (int y = kBorder; y < kSide - kBorder; ++y) {
      for (int x = kBorder; x < kSide - kBorder; ++x)
        visit(truth[y * kSide + x], got[y * kSide + x]);
    }
  };
  each([&](double a, double b) { mean += a, got_mean += b, count += 1; });
  mean /= count, got_mean /= count;
  Beside sums;
  each([&](double a, double b) {
    sums.error += (a - b) * (a - b);
    sums.contrast += (a - mean) * (a - mean);
    sums.made_contrast += (b - got_mean) * (b - got_mean);
    sums.likeness += (a - mean) * (b - got_mean);
  });
  return {std::sqrt(sums.error / count), std::sqrt(sums.contrast / count),
          std::sqrt(sums.made_contrast / count),
          sums.likeness / std::sqrt(sums.contrast * sums.made_contrast), got_mean / mean};
}

std::string text_of(const Murk& murk, const Beside& b) {
  std::ostringstream text;
  text << "from " << murk.from.x << ", slope " << murk.slope << ", deep " << murk.deep
       << ", scattering " << murk.scattering << ": error " << b.error << ", contrast " << b.contrast
       << " and " << b.made_contrast << ", likeness " << b.likeness << ", energy " << b.energy;
  return text.str();
}

// A view along the light sees whole shafts: they are as uneven as the caustics on the bottom.
TEST(Shafts, AlongSunlightAreLightThatIsFollowed) {
  for (const double slope : {0.04, 0.12}) {
    for (const double deep : {1.0, 4.0}) {
      for (const double scattering : {0.2, 1.5}) {
        if (test::kSanitized && (deep != 4 || scattering != 0.2)) continue;
        const Murk murk{slope, deep, scattering, Murk::sun()};
        const Beside b = beside(murk);
        EXPECT_LE(b.error, 0.4 * b.contrast) << text_of(murk, b);
        EXPECT_GE(b.likeness, 0.92) << text_of(murk, b);
        EXPECT_NEAR(b.made_contrast / b.contrast, 1, 0.15) << text_of(murk, b);
        EXPECT_NEAR(b.energy, 1, 0.006) << text_of(murk, b);
      }
    }
  }
}

// Other views see the mean over many shafts, so contrast is small: the operator adds no more than
// the truth has.
TEST(Shafts, AcrossSunlightAreNoMoreThanThereAre) {
  for (const double from : {-0.5, 0.0, 0.4}) {
    for (const double slope : {0.04, 0.12}) {
      for (const double deep : {1.0, 4.0}) {
        if (test::kSanitized && (from != 0 || deep != 4)) continue;
        const Murk murk{slope, deep, 0.5, {from, std::sqrt(1 - from * from), 0}};
        const Beside b = beside(murk);
        EXPECT_LE(b.error, 0.8 * b.contrast) << text_of(murk, b);
        EXPECT_GE(b.likeness, 0.65) << text_of(murk, b);
        EXPECT_LE(b.made_contrast, 1.25 * b.contrast) << text_of(murk, b);
        EXPECT_NEAR(b.energy, 1, 0.006) << text_of(murk, b);
      }
    }
  }
}

/// The gain of each pixel's water by shafts, under a shadow on the bottom.
Picture more_of(const Murk& murk, double shafts, double strength, float shadow) {
  const Scene scene = murk.scene();
  test::Buffers buffers = murk.buffers();
  buffers.fill(PlaneId::kShadow, shadow);
  Look with = murk.look(shafts), without = murk.look(0);
  with.of<WaterShadow>().strength = without.of<WaterShadow>().strength = strength;
  const test::Picture a = test::reference(with, buffers.frame, scene);
  const test::Picture b = test::reference(without, buffers.frame, scene);
  Picture more;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      more.push_back(a.aov(Aov::kInScatter, x, y, 1) - b.aov(Aov::kInScatter, x, y, 1));
    }
  }
  return more;
}

TEST(Shafts, AreOfTheLightThatIsNotShaded) {
  const Murk murk{0.06, 2, 0.5, Murk::sun()};
  const Picture lit = more_of(murk, 1, 1, 1), half = more_of(murk, 0.5, 1, 1),
                shaded = more_of(murk, 1, 0.75, 0.5), dark = more_of(murk, 1, 1, 0),
                bare = more_of(murk, 1, 0, 0);
  for (std::size_t i = 0; i < lit.size(); ++i) {
    EXPECT_NEAR(half[i], 0.5 * lit[i], 1e-6);
    EXPECT_NEAR(shaded[i], (1 - 0.75 * 0.5) * lit[i], 1e-6);
    EXPECT_EQ(dark[i], 0);
    EXPECT_NEAR(bare[i], lit[i], 1e-6);
  }
}

// The planner leaves shafts out by this bound.
TEST(Shafts, ChangeNoMoreThanTheirBound) {
  const Murk murk{0.12, 4, 0.5, Murk::sun()};
  const Scene scene = murk.scene();
  const test::Buffers buffers = murk.buffers();
  const Look look = murk.look(1);
  const Plan plan = make_plan(look, test::inputs_of(buffers.frame, scene));
  Pass pass(scene, buffers.frame, kIor, plan.made);
  Completer completer;
  pass.caustics = completer.complete(plan, buffers.frame, pass, *make_executor(1)).caustics;
  ASSERT_TRUE(pass.caustics && pass.caustics->in_water);
  Ranges ranges;
  ranges.color = {{{0, 0}, {0, 0}, {0, 0}}};
  ranges.shadow = ranges.shadow_of_water = {1, 1};
  Kernel<DepthFog>::propagate_ranges(look.of<DepthFog>(), pass, ranges);
  const double bound = Kernel<WaterShadow>::bound(look.of<WaterShadow>(), pass, ranges);
  double most = 0;
  for (const double more : more_of(murk, 1, 1, 1)) most = std::max(most, std::abs(more));
  EXPECT_LE(most, bound);
  EXPECT_GE(most, 0.05 * bound);  // no path has four times the brightest texel
  const double light = ranges.light;
  Kernel<WaterShadow>::propagate_ranges(look.of<WaterShadow>(), pass, ranges);
  EXPECT_GE(ranges.light, light + most);
}

}  // namespace
}  // namespace limpid
