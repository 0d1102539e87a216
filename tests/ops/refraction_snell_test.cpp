#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "limpid/ops/refraction.h"

#include "ops/tray.h"
#include "optics/water_index.h"

// Model `snell` against closed forms: a camera 2 above calm water, a bottom that is a plane.

namespace limpid {
namespace {

constexpr Size kSize{64, 48};
constexpr double kIor = 1.333;

/// The bottom is the plane y = -depth + slope z (z grows towards the camera).
struct Basin {
  Basin(double depth, double slope, double roll = 0)
      : buffers(rect_of(kSize)), scene(test::simple_scene(kSize)) {
    scene.camera->view = glm::rotate(glm::dmat4(1), roll, glm::dvec3(0, 0, 1)) * scene.camera->view;
    const Rays rays = rays_of(*scene.camera, {kSize.width, kSize.height});
    const glm::dvec3 eye = scene.camera->eye();
    for (int c = 0; c < 3; ++c) {
      buffers.set(plane_after(PlaneId::kColorR, c),
                  [](int x, int y) { return float(x + 100 * y); });
    }
    bottom = Plane(rect_of(kSize));
    buffers.set(PlaneId::kDepth, [&](int x, int y) {
      const glm::dvec3 ray = rays.ray_at(x + 0.5, y + 0.5);
      const double meets = (-depth + slope * eye.z - eye.y) / (ray.y - slope * ray.z);
      return bottom.view().at(x, y) = meets > 0 ? static_cast<float>(meets) : test::kInf;
    });
    look = test::still_look();
    Refraction::Params& p = look.of<Refraction>();
    p.model = Refraction::Model::kSnell;
    p.rejection = Refraction::Rejection::kNone;
    p.off_frame = Refraction::OffFrame::kClamp;
    look.of<DepthFog>().distance = DepthFog::Distance::kEye;
  }

  /// Where the refracted ray of a pixel ends, worked out in the world.
  struct Hit {
    glm::dvec2 uv;
    double path;
  };
  Hit hit(int x, int y, double depth, double slope, double ior = kIor) const {
    const Rays rays = rays_of(*scene.camera, {kSize.width, kSize.height});
    const glm::dvec3 eye = scene.camera->eye(), ray = rays.ray_at(x + 0.5, y + 0.5);
    const glm::dvec3 surface = eye + (-eye.y / ray.y) * ray;
    const glm::dvec3 in = glm::normalize(ray);
    const glm::dvec3 sideways = glm::dvec3(in.x, 0, in.z) / ior;
    const glm::dvec3 t = sideways - glm::dvec3(0, std::sqrt(1 - glm::dot(sideways, sideways)), 0);
    const double distance = (-depth + slope * surface.z) / (t.y - slope * t.z);
    const glm::dvec4 clip =
        scene.camera->projection * scene.camera->view * glm::dvec4(surface + distance * t, 1);
    return {{0.5 + 0.5 * clip.x / clip.w, 0.5 + 0.5 * clip.y / clip.w}, distance};
  }

  test::Picture wet() const { return test::reference(look, buffers.frame, scene); }

  test::Buffers buffers;
  Scene scene;
  Look look;
  Plane bottom;  ///< its depth
};

double inside(const glm::dvec2& uv) { return std::min({uv.x, uv.y, 1 - uv.x, 1 - uv.y}); }

/// Largest error of the map, in pixels, over the pixels whose ray ends well inside the picture.
double map_error(const Basin& basin, double depth, double slope) {
  const test::Picture got = basin.wet();
  double worst = 0;
  int seen = 0;
  for (int y = 20; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      const Basin::Hit expected = basin.hit(x, y, depth, slope);
      if (inside(expected.uv) < 0.05) continue;
      ++seen;
      worst =
          std::max(worst, std::abs(got.aov(Aov::kStmapG, x, y, 0) - expected.uv.x) * kSize.width);
      worst =
          std::max(worst, std::abs(got.aov(Aov::kStmapG, x, y, 1) - expected.uv.y) * kSize.height);
    }
  }
  EXPECT_GT(seen, 500);
  return worst;
}

TEST(Snell, FlatBottomIsExactForAnySteps) {
  for (int steps : {0, 1, 4, Refraction::kMarch}) {
    Basin basin(0.5, 0);
    basin.look.of<Refraction>().steps = steps;
    EXPECT_LT(map_error(basin, 0.5, 0), 1e-3) << steps;
  }
}

TEST(Snell, SlopingBottomTakesStepsOrAMarch) {
  std::vector<double> errors;
  for (int steps : {0, 1, 4, Refraction::kMarch}) {
    Basin basin(0.5, 0.12);
    basin.look.of<Refraction>().steps = steps;
    errors.push_back(map_error(basin, 0.5, 0.12));
  }
  EXPECT_GT(errors[0], 0.5) << "the depth at the pixel is not that where the ray ends";
  EXPECT_LT(errors[1], errors[0]);
  EXPECT_LT(errors[2], 0.1);
  EXPECT_LT(errors[3], 0.2);
}

/// The beach, which the shore becomes towards the viewer, stands before the water further down, and
/// must not count as an object that hides the bottom.
TEST(Snell, RolledViewsFindTheSameEnd) {
  for (int steps : {4, Refraction::kMarch}) {
    Basin basin(0.5, 0.12, 0.3);
    basin.look.of<Refraction>().steps = steps;
    EXPECT_LT(map_error(basin, 0.5, 0.12), 0.2) << steps;
  }
}

TEST(Snell, AShoreIsMetBeforeItRisesOutOfTheWater) {
  for (const double slope : {0.1, 0.2, 0.3}) {
    const double depth = -2 * slope;  // the waterline is at z = -2
    Basin basin(depth, slope);
    basin.look.of<Refraction>().steps = Refraction::kMarch;
    const test::Picture got = basin.wet();
    int seen = 0, shallow = 0;
    each_wet(got, kSize, [&](int x, int y) {
      const Basin::Hit expected = basin.hit(x, y, depth, slope);
      if (inside(expected.uv) < 0.02 || !(expected.path > 0 && expected.path < 0.3)) return;
      ++seen;
      shallow += expected.path < 0.05;
      EXPECT_NEAR(got.aov(Aov::kPath, x, y), expected.path, 0.1)
          << "a texel is as long" << slope << ": " << x << ", " << y;
    });
    EXPECT_GT(seen, 100) << slope;
    EXPECT_GT(shallow, 10) << slope;
  }
}

TEST(Snell, StraightDownNothingShifts) {
  test::Tray tray({9, 9});
  Refraction::Params& p = tray.look.of<Refraction>();
  p.model = Refraction::Model::kSnell;
  for (int steps : {0, 2, Refraction::kMarch}) {
    p.steps = steps;
    const test::Picture got = tray.wet();
    EXPECT_NEAR(got.aov(Aov::kStmapG, 4, 4, 0), 0.5, 1e-6);
    EXPECT_NEAR(got.aov(Aov::kStmapG, 4, 4, 1), 0.5, 1e-6);
  }
}

// Seen from straight above, a facet tilted by a turns the ray by a - asin(sin a / n).
TEST(Snell, ATiltedFacetBendsByItsAngle) {
  test::Tray tray({60, 3});
  tray.buffers.fill(PlaneId::kDepth, 20);  // 10 below the surface
  const double a = 0.3;
  tray.buffers.normal({std::sin(a), std::cos(a), 0});
  Refraction::Params& p = tray.look.of<Refraction>();
  p.model = Refraction::Model::kSnell;
  const double turn = a - std::asin(std::sin(a) / kIor);
  for (int steps : {0, 3, Refraction::kMarch}) {
    p.steps = steps;
    const double shift = tray.wet().aov(Aov::kStmapG, 30, 1, 0) * 60 - 30.5;
    // The facet leans right, so its ray goes left.
    EXPECT_NEAR(shift, -10 * std::tan(turn), 1e-2) << steps;
  }
}

TEST(Snell, SkyUnderWaterHasNoEnd) {
  Basin basin(0.5, 0);
  basin.buffers.fill(PlaneId::kDepth, test::kInf);
  for (int steps : {0, 2, Refraction::kMarch}) {
    basin.look.of<Refraction>().steps = steps;
    for (float v : basin.wet().values()) EXPECT_FALSE(std::isnan(v)) << steps;
  }
}

// A block that reaches almost up to the surface: rays from behind the block end on the bottom that
// the block hides. These rays must not show the block's face, which they never meet.
TEST(Snell, WhatStandsUnderWaterHidesTheBottomAndIsNotSmeared) {
  const auto block = [](int x, int y) { return x >= 20 && x < 44 && y >= 34 && y < 40; };
  Basin basin(0.5, 0), face(0.1, 0);
  basin.buffers.set(PlaneId::kDepth, [&](int x, int y) {
    const Basin& seen = block(x, y) ? face : basin;
    return seen.bottom.view().at(x, y);
  });
  for (int c = 0; c < 3; ++c) {
    basin.buffers.set(plane_after(PlaneId::kColorR, c),
                      [&](int x, int y) { return block(x, y) ? 1e4f : 1.0f; });
  }
  basin.look.of<Refraction>().rejection = Refraction::Rejection::kShorten;
  const test::Picture got = basin.wet();
  int hidden = 0;
  for (int y = 24; y < 34; ++y) {
    for (int x = 24; x < 40; ++x) {
      const glm::dvec2 uv = basin.hit(x, y, 0.5, 0).uv;
      const int row = static_cast<int>((1 - uv.y) * kSize.height);
      if (!block(x, row - 1) || !block(x, row + 1)) continue;
      ++hidden;
      EXPECT_LT(got.aov(Aov::kTransmitted, x, y), 1.1) << x << ", " << y;
      EXPECT_LT(got.aov(Aov::kConfidence, x, y), 0.01) << x << ", " << y;
    }
  }
  EXPECT_GT(hidden, 10);
}

TEST(Snell, OffTheFrameIsInventedAndSaidSo) {
  Basin basin(3, 0);  // so deep that the lowest rows look below the picture
  for (auto policy : {Refraction::OffFrame::kClamp, Refraction::OffFrame::kShorten,
                      Refraction::OffFrame::kFog, Refraction::OffFrame::kContinue}) {
    basin.look.of<Refraction>().off_frame = policy;
    const test::Picture got = basin.wet();
    EXPECT_EQ(got.aov(Aov::kConfidence, 32, 47), 0);
    EXPECT_EQ(got.aov(Aov::kConfidence, 32, 24), 1);
    if (policy == Refraction::OffFrame::kFog) {
      EXPECT_EQ(got.aov(Aov::kTransmitted, 32, 47), 0);
    } else {
      EXPECT_NEAR(got.aov(Aov::kTransmitted, 32, 47), 32 + 4700, 40);
    }
  }
}

// The share of the light that is kept is the share by which the path is shortened.
TEST(Snell, FogOffTheFrameComesGradually) {
  Basin basin(3, 0);
  for (int c = 0; c < 3; ++c) basin.buffers.fill(plane_after(PlaneId::kColorR, c), 1);
  basin.look.of<DepthFog>().distance = DepthFog::Distance::kRefracted;
  const test::Picture clear = basin.wet();
  basin.look.of<Refraction>().off_frame = Refraction::OffFrame::kFog;
  const test::Picture fog = basin.wet();
  int between = 0;
  for (int y = 20; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      const double kept = fog.aov(Aov::kTransmitted, x, y), distance = clear.aov(Aov::kPath, x, y);
      if (kept < 0.01 || kept > 0.99) continue;
      ++between;
      EXPECT_NEAR(kept * fog.aov(Aov::kPath, x, y), distance, 1e-5 * distance) << x << " " << y;
    }
  }
  EXPECT_GT(between, 20);
}

// From below, 30 degrees over the horizon: beyond the critical angle the operator does no lookup.
TEST(Snell, WhereAllIsMirroredNothingIsUnsure) {
  Basin basin(3, 0);
  const glm::dmat4 upside_down = glm::scale(glm::dmat4(1), glm::dvec3(1, -1, 1));
  basin.scene.camera->view = upside_down * basin.scene.camera->view * upside_down;
  basin.buffers.fill(PlaneId::kDepth, 1000);
  const test::Picture got = basin.wet();
  EXPECT_EQ(got.aov(Aov::kConfidence, 32, 24), 1);
  EXPECT_EQ(got.aov(Aov::kStmapG, 32, 24, 0), 32.5 / kSize.width);
}

/// A bottom 3 deep, whose color and depth go on far beyond the picture.
Basin wide_basin() {
  Basin basin(3, 0);
  const Rect wide{-16, -16, kSize.width + 16, kSize.height + 60};
  const Rays rays = rays_of(*basin.scene.camera, {kSize.width, kSize.height});
  const glm::dvec3 eye = basin.scene.camera->eye();
  for (int c = 0; c < 3; ++c) {
    basin.buffers.set(
        plane_after(PlaneId::kColorR, c), [](int x, int y) { return float(x + 100 * y); }, wide);
  }
  basin.buffers.set(
      PlaneId::kDepth,
      [&](int x, int y) {
        const double meets = (-3 - eye.y) / rays.ray_at(x + 0.5, y + 0.5).y;
        return meets > 0 ? static_cast<float>(meets) : test::kInf;
      },
      wide);
  return basin;
}

TEST(Snell, OverscanIsUsedWhereThereIsSome) {
  const Basin basin = wide_basin();
  const Basin::Hit expected = basin.hit(32, 47, 3, 0);
  ASSERT_LT(expected.uv.y, 0);
  const test::Picture got = basin.wet();
  EXPECT_EQ(got.aov(Aov::kConfidence, 32, 47), 1);
  EXPECT_NEAR(got.aov(Aov::kStmapG, 32, 47, 1), expected.uv.y, 2e-3);
}

/// Renderers often give overscan to color and depth, and never to passes of the water.
TEST(Snell, OverscanOfColorAndDepthCountsWhateverOtherPlanesHave) {
  Basin basin = wide_basin();
  const Rays rays = rays_of(*basin.scene.camera, {kSize.width, kSize.height});
  basin.buffers.normal({0, 1, 0}).fill(PlaneId::kShadow, 1);
  for (int c = 0; c < 3; ++c) basin.buffers.fill(plane_after(PlaneId::kReflectionR, c), 0.1f);
  basin.buffers.set(PlaneId::kSurfaceDepth, [&](int x, int y) {
    const double meets = -2 / rays.ray_at(x + 0.5, y + 0.5).y;
    return meets > 0 ? static_cast<float>(meets) : test::kInf;
  });
  for (const auto rejection : {Refraction::Rejection::kNone, Refraction::Rejection::kSnap,
                               Refraction::Rejection::kShorten}) {
    basin.look.of<Refraction>().rejection = rejection;
    const test::Picture judge = basin.wet(),
                        fast = test::fused(basin.look, basin.buffers.frame, basin.scene);
    for (const int x : {2, 32, 61}) {
      const Basin::Hit expected = basin.hit(x, 47, 3, 0);
      ASSERT_LT(expected.uv.y, 0);
      for (const test::Picture* got : {&judge, &fast}) {
        EXPECT_EQ(got->aov(Aov::kConfidence, x, 47), 1) << x;
        EXPECT_NEAR(got->aov(Aov::kStmapG, x, 47, 1), expected.uv.y, 2e-3) << x;
        const double row = (1 - expected.uv.y) * kSize.height - 0.5;
        const double passes = 1 - got->aov(Aov::kFresnel, x, 47);
        EXPECT_NEAR(got->aov(Aov::kTransmitted, x, 47) / passes,
                    expected.uv.x * kSize.width - 0.5 + 100 * row, 10)
            << x;
      }
    }
  }
}

/// Also with a layer below the water, which was rendered for the picture alone.
TEST(Snell, OverscanGoesOnWhereTheLayerBelowEnds) {
  Basin basin = wide_basin();
  for (int c = 0; c < 3; ++c) {
    basin.buffers.set(plane_after(PlaneId::kBelowR, c),
                      [](int x, int y) { return float(x + 100 * y); });
  }
  const View<const float> depth = basin.buffers.frame.plane(PlaneId::kDepth);
  basin.buffers.set(PlaneId::kBelowDepth, [&](int x, int y) { return depth.at(x, y); });
  const Basin::Hit expected = basin.hit(32, 47, 3, 0);
  ASSERT_LT(expected.uv.y, 0);
  const test::Picture judge = basin.wet();
  const test::Picture fast = test::fused(basin.look, basin.buffers.frame, basin.scene);
  for (const test::Picture* got : {&judge, &fast}) {
    EXPECT_EQ(got->aov(Aov::kConfidence, 32, 47), 1);
    EXPECT_NEAR(got->aov(Aov::kStmapG, 32, 47, 1), expected.uv.y, 2e-3);
  }
}

// --- dispersion ---------------------------------------------------------------------------------

TEST(Dispersion, ChannelsGoWhereTheirIndexSendsThem) {
  Basin basin(0.5, 0);
  basin.look.water.ior = water_index(kGreenWavelength);
  basin.look.of<PrismSplit>().model = PrismSplit::Model::kDispersion;
  const test::Picture got = basin.wet();
  const struct {
    Aov map;
    double wavelength;
  } channels[] = {{Aov::kStmapR, kRedWavelength},
                  {Aov::kStmapG, kGreenWavelength},
                  {Aov::kStmapB, kBlueWavelength}};
  for (const auto& [map, wavelength] : channels) {
    const Basin::Hit expected = basin.hit(30, 30, 0.5, 0, water_index(wavelength));
    EXPECT_NEAR(got.aov(map, 30, 30, 0), expected.uv.x, 1e-6);
    EXPECT_NEAR(got.aov(map, 30, 30, 1), expected.uv.y, 1e-6);
  }
}

TEST(Dispersion, IsCollinearWithRefractionAndBendsBlueMost) {
  Basin basin(0.5, 0);
  basin.look.of<PrismSplit>().model = PrismSplit::Model::kDispersion;
  const test::Picture got = basin.wet();
  for (int y = 24; y < 40; ++y) {
    const auto map = [&](Aov which) {
      return glm::dvec2(got.aov(which, 20, y, 0), got.aov(which, 20, y, 1));
    };
    const glm::dvec2 own((20 + 0.5) / kSize.width, 1 - (y + 0.5) / kSize.height);
    const glm::dvec2 red = map(Aov::kStmapR) - own, blue = map(Aov::kStmapB) - own;
    EXPECT_GT(glm::length(blue), glm::length(red));
    EXPECT_NEAR(red.x * blue.y - red.y * blue.x, 0, 2e-7);
  }
}

TEST(Dispersion, WithoutGainItIsNoPrismBitForBit) {
  Basin basin(0.5, 0.1);
  basin.look.of<PrismSplit>().model = PrismSplit::Model::kDispersion;
  basin.look.of<PrismSplit>().gain = 0;
  const std::vector<float> without = basin.wet().values();
  basin.look.of<PrismSplit>().model = PrismSplit::Model::kAxis;
  basin.look.of<PrismSplit>().strength = 0;
  EXPECT_EQ(without, basin.wet().values());
}

}  // namespace
}  // namespace limpid
