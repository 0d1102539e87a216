#include "complete/caustics.h"

#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "op/plain_texture.h"
#include "optics/refract.h"
#include "optics/waves.h"
#include "sanitized.h"
#include "support.h"

// The table beside light that is followed as finely as it takes.

namespace limpid {
namespace {

constexpr double kIor = 1.333, kCell = 0.01;
constexpr int kSide = 192, kBorder = 24;  // pixels of a cell; those not judged

/// Short waves in all directions, the root mean square of whose slopes is this.
std::vector<SineWave> waves_of(double slope) {
  std::vector<SineWave> waves;
  const double lengths[] = {1.3, 0.9, 0.62, 0.43, 0.35, 0.27, 0.22, 0.18};
  for (int i = 0; i < 8; ++i) {
    const double k = 2 * std::numbers::pi / lengths[i], angle = 2.4 * i;
    waves.push_back({.amplitude = slope * std::sqrt(2.0 / 8) / k,
                     .k_x = k * std::cos(angle),
                     .k_y = k * std::sin(angle),
                     .phase = 1.7 * i,
                     .omega = std::sqrt(9.81 * k)});
  }
  return waves;
}

/// A basin that an orthographic camera looks straight down on: a pixel is 1 cm of it. x to the
/// right, y up in the picture, from its middle; `deep` is how deep the bottom lies there.
struct Basin {
  std::function<double(double x, double y)> deep;
  double sun_height = 40, sun_turn = 30;  ///< degrees, from x towards y
  double slope = 0.12, time = 0;
  bool cliff = false;  ///< along x = 0, between two levels
  Scene scene;
  test::Buffers buffers{rect_of({kSide, kSide})};

  void make() {
    Camera camera;
    camera.view = glm::lookAt(glm::dvec3(0, 4, 0), glm::dvec3(0, 0, 0), glm::dvec3(0, 0, -1));
    camera.projection = orthographic(kSide * kCell, kSide * kCell, 0.1, 50, ClipSpace::kGl);
    scene.camera = camera;
    scene.water = WaterPlane{.waves = waves_of(slope)};
    scene.time = time;
    const double rise = sun_height * std::numbers::pi / 180,
                 turn = sun_turn * std::numbers::pi / 180;
    scene.sun = Sun{.direction = {std::cos(rise) * std::cos(turn), std::sin(rise),
                                  -std::cos(rise) * std::sin(turn)}};
    buffers.set(PlaneId::kDepth,
                [&](int x, int y) { return static_cast<float>(4 + deep(at(x), -at(y))); });
    for (int c = 0; c < 3; ++c) buffers.fill(plane_after(PlaneId::kColorR, c), 0.5f);
  }
  static double at(int pixel) { return (pixel + 0.5 - kSide / 2) * kCell; }
  Swell swell() const { return {true, scene.water->waves, 1}; }
};

using Picture = std::vector<double>;  // kSide x kSide, a value a cell of the bottom

/// Calm light that goes aside, for each unit that it sinks.
glm::dvec2 aside_of(const glm::dvec3& to_sun) {
  return glm::dvec2(to_sun) * (-1 / std::sqrt(kIor * kIor - 1 + to_sun.z * to_sun.z));
}

/// Photons from a grid of 4 mm, over the sun's disc, each to where it meets the bottom; over the
/// light of calm water there.
Picture followed(const Basin& basin) {
  const Pass pass(basin.scene, basin.buffers.frame, kIor, kWholeState, basin.swell());
  const glm::dvec3 mid = basin.scene.sun->direction;
  const glm::dvec3 side = glm::normalize(glm::cross(mid, pass.up)), rise = glm::cross(side, mid);
  constexpr double kStep = 0.004;
  constexpr std::array<glm::dvec2, 7> kDisc{
      {{0, 0}, {1, 0}, {.5, .866}, {-.5, .866}, {-1, 0}, {-.5, -.866}, {.5, -.866}}};
  const double radius = 0.76 * basin.scene.sun->radius();  // the same variance as all of the disc
  std::array<Vec3<double>, 7> suns;
  for (std::size_t i = 0; i < kDisc.size(); ++i) {
    const glm::dvec3 to = glm::normalize(mid + radius * (kDisc[i].x * side + kDisc[i].y * rise));
    suns[i] = {glm::dot(to, pass.map_x), glm::dot(to, pass.map_y), glm::dot(to, pass.up)};
  }
  const double middle = basin.deep(0, 0);
  const glm::dvec2 aside = aside_of({suns[0].x, suns[0].y, suns[0].z});
  const double cosine = std::sqrt(1 / (1 + glm::dot(aside, aside)));
  const double focus = (kIor * cosine - suns[0].z) / (kIor * cosine * cosine * cosine);
  const double around = 0.3 + 4 * middle * focus * basin.slope + std::abs(0.8 * aside.x);
  const int count = static_cast<int>((kSide * kCell + 2 * around) / kStep);
  Picture light(kSide * kSide);
  for (int row = 0; row < count; ++row) {
    const double y = (row + 0.5) * kStep - around - kSide * kCell / 2 - middle * aside.y;
    for (int column = 0; column < count; ++column) {
      const double x = (column + 0.5) * kStep - around - kSide * kCell / 2 - middle * aside.x;
      const WaveHeight w = wave_height(basin.scene.water->waves, x, y, basin.time);
      const double length = std::sqrt(1 + w.slope_x * w.slope_x + w.slope_y * w.slope_y);
      const Vec3<double> normal{-w.slope_x / length, -w.slope_y / length, 1 / length};
      for (const Vec3<double>& from : suns) {
        const Vec3<double> in = refract(from, normal, 1 / kIor).direction;
        double depth = middle, bottom_x = 0, bottom_y = 0;
        const auto go = [&] {
          bottom_x = x - (depth + w.height) * in.x / in.z;
          bottom_y = y - (depth + w.height) * in.y / in.z;
        };
        if (basin.cliff) {  // the upper bottom, the lower one, or the wall between them
          depth = basin.deep(-1, 0), go();
          if (bottom_x >= 0) depth = basin.deep(1, 0), go();
          if (depth != basin.deep(bottom_x, bottom_y)) continue;
        }
        for (int k = 0; k < 5 && !basin.cliff; ++k) go(), depth = basin.deep(bottom_x, bottom_y);
        const int cell_x = static_cast<int>(std::floor(bottom_x / kCell + kSide / 2));
        const int cell_y = static_cast<int>(std::floor(-bottom_y / kCell + kSide / 2));
        if (cell_x < 0 || cell_y < 0 || cell_x >= kSide || cell_y >= kSide) continue;
        const double power = dot(from, normal) * length / suns[0].z;
        light[cell_y * kSide + cell_x] += power * kStep * kStep / (kCell * kCell) / kDisc.size();
      }
    }
  }
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      constexpr double kNear = 1e-4;
      const double at_x = Basin::at(x), at_y = -Basin::at(y);
      const double falls_x = basin.deep(at_x + kNear, at_y) - basin.deep(at_x - kNear, at_y);
      const double falls_y = basin.deep(at_x, at_y + kNear) - basin.deep(at_x, at_y - kNear);
      light[y * kSide + x] /= 1 - (falls_x * aside.x + falls_y * aside.y) / (2 * kNear);
    }
  }
  return light;
}

struct Grid {
  double grid(const View<const float>& table, Vec2<double> at) const { return grid_at(table, at); }
};

Picture of_table(const Basin& basin, const CausticsTable& table) {
  const Pass pass(basin.scene, basin.buffers.frame, kIor, kWholeState, basin.swell());
  const glm::dvec3& sun = basin.scene.sun->direction;
  const glm::dvec2 aside =
      aside_of({glm::dot(sun, pass.map_x), glm::dot(sun, pass.map_y), glm::dot(sun, pass.up)});
  Picture light(kSide * kSide);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double deep = basin.deep(Basin::at(x), -Basin::at(y));
      const Vec2<double> entry{Basin::at(x) - deep * aside.x, -Basin::at(y) - deep * aside.y};
      light[y * kSide + x] = caustics_at(table, Grid{}, entry, kCell);
    }
  }
  return light;
}

/// Blurred by a Gaussian of two cells.
Picture blurred(const Picture& picture) {
  const auto along = [](const Picture& from, int step_x, int step_y) {
    Picture to(from.size());
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        double sum = 0, weights = 0;
        for (int k = -6; k <= 6; ++k) {
          const int column = x + k * step_x, row = y + k * step_y;
          if (column < 0 || row < 0 || column >= kSide || row >= kSide) continue;
          const double weight = std::exp(-k * k / 8.0);
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
  double error, contrast, energy, table_energy;
};

/// Where `judged(x, y)` holds.
Beside beside(const Picture& truth, const Picture& table,
              const std::function<bool(double, double)>& judged) {
  const Picture a = blurred(truth), b = blurred(table);
  double error = 0, contrast = 0, energy = 0, table_energy = 0, count = 0;
  for (int y = kBorder; y < kSide - kBorder; ++y) {
    for (int x = kBorder; x < kSide - kBorder; ++x) {
      if (!judged(Basin::at(x), -Basin::at(y))) continue;
      const double want = a[y * kSide + x], got = b[y * kSide + x];
      error += (got - want) * (got - want), contrast += (want - 1) * (want - 1);
      energy += want, table_energy += got, count += 1;
    }
  }
  return {std::sqrt(error / count), std::sqrt(contrast / count), energy / count,
          table_energy / count};
}

Beside judge(Basin& basin, const std::function<bool(double, double)>& judged) {
  basin.make();
  const Pass pass(basin.scene, basin.buffers.frame, kIor, kWholeState, basin.swell());
  WaveNormals::Params waves;
  waves.model = WaveNormals::Model::kSines;
  waves.strength = 1;
  CausticsMaker maker;
  const auto executor = make_executor(1);
  const CausticsTable* table = maker.make(waves, {0, 0, 0}, basin.buffers.frame, pass, *executor);
  EXPECT_GT(table->count, 0);
  return beside(followed(basin), of_table(basin, *table), judged);
}

const auto kAll = [](double, double) { return true; };

// Of the light of calm water, root mean square, after both are blurred by two pixels.

TEST(Caustics, OnAFlatBottomAreLightThatIsFollowed) {
  for (const double deep : {0.3, 1.0, 5.0}) {
    for (const double sun : {20.0, 40.0, 60.0}) {
      if (test::kSanitized && (deep != 1 || sun != 40)) continue;  // it takes minutes
      for (const double slope : {0.035, 0.12}) {
        Basin basin;
        basin.deep = [=](double, double) { return deep; };
        basin.sun_height = sun, basin.slope = slope;
        const Beside b = judge(basin, kAll);
        EXPECT_LE(b.error, 0.08) << deep << " " << sun << " " << slope;
        EXPECT_LE(b.error, 0.2 * b.contrast) << deep << " " << sun << " " << slope;
        EXPECT_NEAR(b.table_energy / b.energy, 1, 0.005) << deep << " " << sun << " " << slope;
      }
    }
  }
}

TEST(Caustics, OnASlopeAreLightThatIsFollowed) {
  for (const double sun : {20.0, 40.0, 60.0}) {
    if (test::kSanitized && sun != 40) continue;
    Basin basin;
    basin.deep = [](double x, double y) { return 1.2 + 0.4 * x - 0.2 * y; };
    basin.sun_height = sun;
    const Beside b = judge(basin, kAll);
    EXPECT_LE(b.error, 0.12) << sun;
    EXPECT_NEAR(b.table_energy / b.energy, 1, 0.005) << sun;
  }
}

// Within 15 cm of it, where it casts no shadow.
TEST(Caustics, BesideACliffAreLightThatIsFollowed) {
  const double upper = 0.8, lower = 1.6;
  for (const double sun : {20.0, 40.0, 60.0}) {
    if (test::kSanitized && sun != 40) continue;
    for (const double turn : {60.0, 120.0}) {  // onto its wall, and from behind
      const double rise = std::sin(sun * std::numbers::pi / 180);
      const double level = std::sqrt(1 - rise * rise) * std::cos(turn * std::numbers::pi / 180);
      const double shadow = (lower - upper) * aside_of({level, 0, rise}).x;
      Basin basin;
      basin.deep = [=](double x, double) { return x < 0 ? upper : lower; };
      basin.sun_height = sun, basin.sun_turn = turn, basin.cliff = true;
      const Beside b = judge(basin, [=](double x, double) {
        return std::abs(x) < 0.15 && (x < 0 || x > shadow + 0.05);
      });
      EXPECT_LE(b.error, 0.2) << sun << " " << turn;
    }
  }
}

/// The table of a basin a metre deep.
CausticsTable table_of(Basin& basin, CausticsMaker& maker, int threads = 1) {
  if (!basin.deep) basin.deep = [](double, double) { return 1.0; };
  basin.make();
  const Pass pass(basin.scene, basin.buffers.frame, kIor, kWholeState, basin.swell());
  WaveNormals::Params waves;
  waves.model = WaveNormals::Model::kSines;
  waves.strength = 1;
  return *maker.make(waves, {0, 0, 0}, basin.buffers.frame, pass, *make_executor(threads));
}

// What stands still in a picture of moving light would be seen, and so would what jumps.
TEST(Caustics, MoveAsLightDoes) {
  Picture last_truth, last_table;
  double moved = 0, table_moved = 0;
  for (int frame = 0; frame < (test::kSanitized ? 2 : 6); ++frame) {
    Basin basin;
    basin.slope = 0.06, basin.time = frame / 24.0;
    CausticsMaker maker;
    const CausticsTable table = table_of(basin, maker);
    const Picture truth = blurred(followed(basin)), of_maker = blurred(of_table(basin, table));
    for (int y = kBorder; frame > 0 && y < kSide - kBorder; ++y) {
      for (int x = kBorder; x < kSide - kBorder; ++x) {
        const auto i = static_cast<std::size_t>(y * kSide + x);
        moved += std::pow(truth[i] - last_truth[i], 2);
        table_moved += std::pow(of_maker[i] - last_table[i], 2);
      }
    }
    last_truth = truth, last_table = of_maker;
  }
  EXPECT_NEAR(std::sqrt(table_moved / moved), 1, 0.05);
}

TEST(Caustics, AreTheSameForAnyNumberOfThreads) {
  Basin basin;
  CausticsMaker one, four;
  const CausticsTable a = table_of(basin, one), b = table_of(basin, four, 4);
  ASSERT_EQ(a.count, b.count);
  EXPECT_EQ(a.most, b.most);
  for (int i = 0; i < a.count; ++i) {
    const auto level = static_cast<std::size_t>(i);
    const View<const float>&x = a.levels[level].light, &y = b.levels[level].light;
    ASSERT_EQ(x.window, y.window);
    for (int row = 0; row < x.window.height(); ++row) {
      ASSERT_TRUE(std::equal(x.row(row), x.row(row) + x.window.width(), y.row(row)));
    }
  }
}

TEST(Caustics, AreNoneWithoutSunOrWaves) {
  const auto levels = [](const auto& change) {
    Basin basin;
    change(basin);
    CausticsMaker maker;
    return table_of(basin, maker).count;
  };
  EXPECT_GT(levels([](Basin&) {}), 0);
  EXPECT_EQ(levels([](Basin& b) { b.slope = 0; }), 0);
  EXPECT_EQ(levels([](Basin& b) { b.sun_height = -5; }), 0);
  EXPECT_EQ(levels([](Basin& b) { b.sun_height = 0; }), 0);
  EXPECT_EQ(levels([](Basin& b) { b.deep = [](double, double) { return 1e-6; }; }), 0);
  EXPECT_EQ(levels([](Basin& b) { b.deep = [](double, double) { return -1.0; }; }), 0);
  EXPECT_EQ(levels([](Basin& b) { b.deep = [](double, double) { return HUGE_VAL; }; }), 0);
}

// Waves as steep as they may be: whatever comes of it is light, and finite.
TEST(Caustics, OfWavesThatFoldLightManyTimesAreFinite) {
  for (const double slope : {1.0, 30.0}) {
    for (const double sun : {1.0, 45.0, 90.0}) {
      Basin basin;
      basin.slope = slope, basin.sun_height = sun;
      CausticsMaker maker;
      const CausticsTable table = table_of(basin, maker);
      EXPECT_TRUE(std::isfinite(table.most));
      for (const double value : of_table(basin, table)) {
        ASSERT_TRUE(std::isfinite(value) && value >= 0) << slope << " " << sun;
      }
    }
  }
}

}  // namespace
}  // namespace limpid
