#include "optics/wind.h"

#include <cmath>

#include <gtest/gtest.h>

#include "limpid/plate/texture.h"

#include "ops/tray.h"
#include "ops/wave_normals_kernel.h"
#include "paths.h"

// The effect of a wind on the looks' map.

namespace limpid {
namespace {

using Model = WaveNormals::Model;
using test::Picture;
using test::Tray;

constexpr Model kMapModels[] = {Model::kFourMaps, Model::kTwoFlows, Model::kDudv, Model::kSlopes};
constexpr int kSide = 128;
constexpr double kTile = 4;

/// A square of open water `tiles` tiles wide, whose middle lies at (x, y) along the map's axes.
struct Sea {
  Sea(Model model, double wind, double degrees, double tiles)
      : map(load_texture(LIMPID_DATA "/maps/water_normals.png")), tray({kSide, kSide}) {
    tray.buffers.frame.wave_map = map.texture;
    tray.scene.camera->projection =
        orthographic(tiles * kTile, tiles * kTile, 0.1, 100, ClipSpace::kGl);
    WaveNormals::Params& params = waves();
    params.model = model;
    params.strength = 1;
    params.tile_size = kTile;
    params.wind = wind;
    params.direction = degrees;
  }
  WaveNormals::Params& waves() { return tray.look.of<WaveNormals>(); }

  Picture at(double time, double x = 0, double y = 0) {
    tray.scene.time = time;
    const glm::dvec3 below(x, 0, -y);
    tray.scene.camera->view =
        glm::lookAt(below + glm::dvec3(0, 10, 0), below, glm::dvec3(0, 0, -1));
    return tray.wet();
  }

  LoadedTexture map;
  Tray tray;
};

/// Downhill along the axes of the map.
Vec2<double> slope_of(const Picture& picture, int x, int y) {
  const auto n = [&](int c) { return picture.aov(Aov::kNormal, x, y, c); };
  return {n(0) / n(1), -n(2) / n(1)};
}

Vec2<double> towards(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  return {std::cos(angle), std::sin(angle)};
}

/// Mean squares of the slopes along a direction and across it.
WindSlopes mean_squares(const Picture& picture, double degrees) {
  const Vec2<double> ahead = towards(degrees);
  WindSlopes mean;
  for (int i = 0; i < kSide * kSide; ++i) {
    const Vec2<double> slope = slope_of(picture, i % kSide, i / kSide);
    const double along = slope.x * ahead.x + slope.y * ahead.y;
    const double across = slope.y * ahead.x - slope.x * ahead.y;
    mean.along += along * along / (kSide * kSide);
    mean.across += across * across / (kSide * kSide);
  }
  return mean;
}

/// Over a tile, or the two tiles of the second of two flows.
TEST(WindOnMaps, SlopesAreThoseOfCoxAndMunk) {
  for (const Model model : kMapModels) {
    // Two flows of one map are not quite independent of each other.
    const double off = model == Model::kSlopes ? 0.02 : model == Model::kTwoFlows ? 0.1 : 0.04;
    for (const double wind : {1.0, 4.0, 10.0, 20.0}) {
      for (const double degrees : {0.0, 35.0, 250.0}) {
        for (const double time : {0.0, 7.3}) {
          Sea sea(model, wind, degrees, model == Model::kTwoFlows ? 2 : 1);
          const WindSlopes wanted = wind_slopes(wind), got = mean_squares(sea.at(time), degrees);
          EXPECT_NEAR(got.along / wanted.along, 1, off) << int(model) << " " << wind << " " << time;
          EXPECT_NEAR(got.across / wanted.across, 1, off)
              << int(model) << " " << wind << " " << time;
        }
      }
    }
  }
}

TEST(WindOnMaps, StrengthScalesSlopes) {
  const WindSlopes wanted = wind_slopes(6);
  for (const double strength : {0.5, 2.0}) {
    Sea sea(Model::kSlopes, 6, 20, 1);
    sea.waves().strength = strength;
    const WindSlopes got = mean_squares(sea.at(2), 20);
    EXPECT_NEAR(got.along, strength * strength * wanted.along, 0.02 * got.along);
    EXPECT_NEAR(got.across, strength * strength * wanted.across, 0.02 * got.across);
  }
}

/// Mean square difference of normals.
double apart(const Picture& a, const Picture& b) {
  double sum = 0;
  for (int i = 0; i < kSide * kSide; ++i) {
    const Vec2<double> d = slope_of(a, i % kSide, i / kSide) - slope_of(b, i % kSide, i / kSide);
    sum += (d.x * d.x + d.y * d.y) / (kSide * kSide);
  }
  return sum;
}

/// A moment later the waves lie a little farther downwind.
TEST(WindOnMaps, WavesRunWithTheWind) {
  constexpr double kMoment = 0.05, kWind = 5;
  for (const Model model : kMapModels) {
    for (const double degrees : {0.0, 90.0, 200.0}) {
      Sea sea(model, kWind, degrees, 1);
      const double distance = kMoment * (phase_speed(kTile / 8) + skin_drift(kWind));
      const Picture now = sea.at(3);
      const auto moved = [&](double angle) {
        const Vec2<double> d = distance * towards(angle);
        return apart(now, sea.at(3 + kMoment, d.x, d.y));
      };
      const double downwind = moved(degrees);
      EXPECT_LT(downwind, 0.3 * apart(now, sea.at(3 + kMoment))) << int(model) << " " << degrees;
      for (const double aside : {-90.0, 90.0, 180.0}) {
        EXPECT_LT(downwind, 0.3 * moved(degrees + aside)) << int(model) << " " << degrees;
      }
    }
  }
}

/// Each lookup has the speed of waves of its own length, near the wind.
TEST(WindOnMaps, WavesRunAsFastAsTheirLength) {
  for (const double wind : {2.0, 9.0}) {
    for (const double tile : {0.5, 4.0, 100.0}) {
      WaveNormals::Params params;
      params.wind = wind;
      params.tile_size = tile;
      params.direction = 60;
      const FourShifts begin = Kernel<WaveNormals>::four_shifts(params, 0);
      const FourShifts later = Kernel<WaveNormals>::four_shifts(params, 2);
      const Vec2<double> ahead = towards(60);
      double aside_of_all = 0, ahead_of_all = 0;
      for (int i = 0; i < 4; ++i) {
        // Coordinates of a lookup that move backwards show waves that move forwards.
        const Vec2<double> moved = tile / 2 * (begin.of[i] - later.of[i]);
        const double along = moved.x * ahead.x + moved.y * ahead.y - skin_drift(wind);
        const double across = moved.y * ahead.x - moved.x * ahead.y;
        const double length = tile / 4 * std::pow(0.5, i * 0.5);
        EXPECT_NEAR(std::hypot(along, across), phase_speed(length), 1e-4 * phase_speed(length));
        EXPECT_GT(along, std::abs(across)) << "within 45 degrees";
        aside_of_all += across, ahead_of_all += along;
        for (int j = 0; j < i; ++j) {  // no two have the same offset
          const Vec2<double> d = begin.of[i] - begin.of[j];
          EXPECT_GT(std::hypot(std::remainder(d.x, 1), std::remainder(d.y, 1)), 0.2);
        }
      }
      EXPECT_LT(std::abs(aside_of_all), 0.02 * ahead_of_all) << "about a degree";
    }
  }
}

/// A map of flat water, to within its bytes, stays flat.
TEST(WindOnMaps, AFlatMapIsCalm) {
  for (const Model model : kMapModels) {
    Sea sea(model, 15, 30, 1);
    std::array<Plane, 3> planes;
    Texture& flat = sea.tray.buffers.frame.wave_map = {};
    for (std::size_t c = 0; c < 3; ++c) {
      planes[c] = Plane(Rect{0, 0, 4, 4});
      for (int i = 0; i < 16; ++i) {
        planes[c].view().at(i % 4, i / 4) = c == 2 ? 1.f : (127.f + float(i % 2)) / 255;
      }
      flat.channels[c] = planes[c].view();
    }
    const Picture got = sea.at(1);
    for (int i = 0; i < kSide; ++i) {
      const Vec2<double> slope = slope_of(got, i, i);
      EXPECT_LT(std::hypot(slope.x, slope.y), 0.006) << int(model);
    }
  }
}

}  // namespace
}  // namespace limpid
