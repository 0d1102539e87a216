#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "judge/trace/column.h"
#include "ops/tray.h"
#include "optics/fresnel.h"

// depth_fog.model = radiative_transfer beside random walks of light through the same water, over a
// level bottom, with and without a surface that reflects.

namespace limpid {
namespace {

using test::Picture;

constexpr double kDegree = std::numbers::pi / 180;

/// The chain's picture of level water: one pixel of an orthographic camera, whose dry picture is a
/// Lambert floor.
class Murk {
 public:
  explicit Murk(const Column& column)
      : column_(column), tray_({1, 1}), finite_(std::isfinite(column.depth)) {
    const double view = column.view * kDegree, sun = column.sun * kDegree;
    const double azimuth = column.azimuth * kDegree, away = 100;
    const glm::dvec3 to_eye(0, std::sin(view), std::cos(view));
    tray_.scene.camera->view =
        glm::lookAt(away * to_eye, glm::dvec3(0),
                    view < 89 * kDegree ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1));
    tray_.scene.camera->projection = orthographic(1e-3, 1e-3, 0.1, 1e6, ClipSpace::kGl);
    const Rgb<double> color = (1 / std::numbers::pi) * column.irradiance;
    if (column.sun > 0) {
      tray_.scene.sun =
          Sun{{std::cos(sun) * std::sin(azimuth), std::sin(sun), std::cos(sun) * std::cos(azimuth)},
              color};
    }
    tray_.scene.sky = SkyLight{column.sky};
    tray_.buffers.fill(PlaneId::kSurfaceDepth, static_cast<float>(away));
    tray_.buffers.fill(
        PlaneId::kDepth,
        finite_ ? static_cast<float>(away + column.depth / std::sin(view)) : HUGE_VALF);
    const Rgb<double> floor = column.bottom * (std::sin(sun) * color + column.sky);
    const double channels[] = {floor.r, floor.g, floor.b};
    for (int c = 0; c < 3; ++c) {
      tray_.buffers.fill(plane_after(PlaneId::kColorR, c), static_cast<float>(channels[c]));
    }
    tray_.look.water.ior = column.ior;
    DepthFog::Params& fog = tray_.look.of<DepthFog>();
    fog.model = DepthFog::Model::kRadiativeTransfer;
    fog.distance = DepthFog::Distance::kRefracted;
    fog.water_type = WaterType::kCustom;
    fog.absorption = column.absorption;
    fog.scattering = column.scattering;
    fog.anisotropy = column.anisotropy;
    fog.sunlight =
        column.real_surface ? DepthFog::Sunlight::kRefracted : DepthFog::Sunlight::kStraight;
    fog.crossing = column.real_surface ? DepthFog::Crossing::kRadiance : DepthFog::Crossing::kNone;
  }

  Rgb<double> light() const {
    const Picture wet = tray_.wet();
    const double passes = 1 - fresnel_exact(std::sin(column_.view * kDegree), column_.ior);
    return passes *
           (test::rgb_of(wet, Aov::kTransmitted, 0, 0) + test::rgb_of(wet, Aov::kInScatter, 0, 0));
  }

 private:
  Column column_;
  test::Tray tray_;
  bool finite_;
};

/// Each channel is within a share of the truth plus its noise.
void expect_near(const Column& column, double share, std::uint64_t paths = 20000) {
  const ColumnLight truth = trace_column(column, paths);
  const Rgb<double> got = Murk(column).light();
  const auto check = [&](double have, double mean, double error) {
    EXPECT_NEAR(have, mean, share * mean + 3 * error)
        << have / mean << " of it, view " << column.view << ", sun " << column.sun << ", azimuth "
        << column.azimuth << ", depth " << column.depth << ", bottom " << column.bottom.r << ", g "
        << column.anisotropy << (column.real_surface ? ", real surface" : ", no surface");
  };
  check(got.r, truth.mean.r, truth.error.r);
  check(got.g, truth.mean.g, truth.error.g);
  check(got.b, truth.mean.b, truth.error.b);
}

Column murky(bool real_surface) {
  Column column;
  column.absorption = {.22, .30, .70};
  column.scattering = {1.5, 1.3, .8};
  column.irradiance = {3.0, 2.79, 2.46};
  column.real_surface = real_surface;
  return column;
}

TEST(MurkyWater, EndlessWaterIsAsBrightAsPathTraced) {
  for (const bool real : {false, true}) {
    for (const double view : {20.0, 45.0, 80.0}) {
      for (const double sun : {20.0, 50.0, 80.0}) {
        Column column = murky(real);
        column.view = view, column.sun = sun;
        expect_near(column, 0.03);
      }
    }
  }
}

TEST(MurkyWater, BottomsOfAnyDepthAndAlbedo) {
  for (const bool real : {false, true}) {
    for (const double depth : {0.01, 0.1, 0.5, 1.0, 4.0}) {
      for (const double albedo : {0.0, 0.3, 0.8}) {
        Column column = murky(real);
        column.depth = depth;
        column.bottom = {albedo, albedo, albedo};
        expect_near(column, 0.03);
      }
    }
  }
}

TEST(MurkyWater, FromClearToNothingAbsorbed) {
  for (const bool real : {false, true}) {
    Column column = murky(real);
    column.absorption = {0.01, 0.1, 1};
    column.scattering = {1, 0.05, 10};
    column.depth = 2;
    column.bottom = {.4, .4, .4};
    expect_near(column, 0.03);
  }
}

TEST(MurkyWater, TheSkyLightsItToo) {
  for (const bool real : {false, true}) {
    for (const double depth : {0.5, 3.0}) {
      Column column = murky(real);
      column.sun = 0;
      column.sky = {.4, .6, 1};
      column.depth = depth;
      column.bottom = {.3, .3, .3};
      expect_near(column, 0.03);
    }
  }
}

TEST(MurkyWater, WaterThatScattersForwards) {
  for (const double anisotropy : {0.5, 0.8, 0.92}) {
    for (const double depth : {1.0, 20.0}) {
      for (const double azimuth : {0.0, 90.0, 180.0}) {
        Column column = murky(true);
        column.anisotropy = anisotropy;
        column.depth = depth;
        column.azimuth = azimuth;
        column.bottom = {.2, .2, .2};
        expect_near(column, 0.06, 100000);
      }
    }
  }
}

// Light that the surface reflects back to the bottom, in water without scattering.
TEST(MurkyWater, ClearWaterKeepsLightIn) {
  for (const double depth : {0.001, 0.3, 2.0}) {
    Column column = murky(true);
    column.scattering = {0, 0, 0};
    column.depth = depth;
    column.bottom = {.5, .5, .5};
    expect_near(column, 0.01);
  }
}

TEST(MurkyWater, GivesNoMoreThanItGets) {
  Column column;
  column.sun = 0;
  column.sky = {1, 1, 1};
  column.scattering = {0.1, 1, 10};
  column.bottom = {0.9, 0.9, 0.9};
  for (const bool real : {false, true}) {
    for (const double depth : {0.001, 1.0, 1e3, 1e6}) {
      column.real_surface = real;
      column.depth = depth;
      const Rgb<double> got = Murk(column).light();
      for (double channel : {got.r, got.g, got.b}) {
        EXPECT_LE(channel, 1.01) << depth;
        EXPECT_GE(channel, 0.2) << depth;
      }
    }
  }
}

}  // namespace
}  // namespace limpid
