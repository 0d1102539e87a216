#pragma once
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "complete/caustics.h"
#include "complete/slope_map.h"
#include "op/plain_texture.h"
#include "optics/fresnel.h"
#include "optics/refract.h"
#include "optics/waves.h"
#include "support.h"

// A table of caustics beside photons that are followed in small steps.

namespace limpid::test {

constexpr double kIor = 1.333, kCell = 0.01;
constexpr int kSide = 192, kBorder = 24;  // pixels of a side; border pixels that are not judged

/// Waves in all directions with this root mean square of slopes; `longer` multiplies their lengths.
inline std::vector<SineWave> waves_of(double slope, double longer = 1) {
  std::vector<SineWave> waves;
  const double lengths[] = {1.3, 0.9, 0.62, 0.43, 0.35, 0.27, 0.22, 0.18};
  for (int i = 0; i < 8; ++i) {
    const double k = 2 * std::numbers::pi / (longer * lengths[i]), angle = 2.4 * i;
    waves.push_back({.amplitude = slope * std::sqrt(2.0 / 8) / k,
                     .k_x = k * std::cos(angle),
                     .k_y = k * std::sin(angle),
                     .phase = 1.7 * i,
                     .omega = std::sqrt(9.81 * k)});
  }
  return waves;
}

constexpr double kPeriod = 2;  ///< of the waves of a map

/// Waves that repeat with the period of a map.
inline std::vector<SineWave> periodic_waves_of(double slope) {
  std::vector<SineWave> waves;
  const double turns[][2] = {{2, 1}, {-1, 3}, {3, -3}, {4, 3}, {-5, 2}, {2, 6}, {7, -3}, {5, 7}};
  for (int i = 0; i < 8; ++i) {
    const double x = 2 * std::numbers::pi / kPeriod * turns[i][0];
    const double y = 2 * std::numbers::pi / kPeriod * turns[i][1];
    waves.push_back({.amplitude = slope * std::sqrt(2.0 / 8) / std::hypot(x, y),
                     .k_x = x,
                     .k_y = y,
                     .phase = 1.7 * i,
                     .omega = 0});
  }
  return waves;
}

/// The source of the water's slopes.
enum class Told { kBySines, kByMap, kBySlopesOfMap, kByNormals };

/// A basin under an orthographic camera that looks straight down; a pixel is 1 cm wide. From the
/// middle of the picture x runs to the right, y up; `deep` is the depth of the bottom there.
struct Basin {
  std::function<double(double x, double y)> deep;
  double sun_height = 40, sun_turn = 30;  ///< degrees, from x towards y
  double slope = 0.12, longer = 1, time = 0;
  bool cliff = false;  ///< along x = 0, between two levels
  Told told = Told::kBySines;
  Scene scene;
  Buffers buffers{rect_of({kSide, kSide})};
  std::array<Plane, 3> map;
  LevelMaker levels;
  SlopeMap slopes;

  /// Whether the cliff hides the bottom from the light of calm water, which moves aside by
  /// `aside_x` per depth.
  bool shaded(double x, double aside_x) const {
    return cliff && x >= 0 && x < (deep(1, 0) - deep(-1, 0)) * aside_x;
  }
  bool of_map() const { return told == Told::kByMap || told == Told::kBySlopesOfMap; }
  std::vector<SineWave> waves() const {
    return of_map() ? periodic_waves_of(slope) : waves_of(slope, longer);
  }
  /// Only sines give the water's height; normals give no slopes beyond the picture.
  WaveHeight surface(const std::vector<SineWave>& of, double x, double y) const {
    WaveHeight w = wave_height(of, x, y, time);
    if (told != Told::kBySines) w.height = 0;
    const double half = 0.5 * kSide * kCell;
    if (told == Told::kByNormals && std::max(std::abs(x), std::abs(y)) > half) return {};
    return w;
  }
  WaveNormals::Params params() const {
    WaveNormals::Params params;
    params.strength = 1;
    params.model = WaveNormals::Model::kSines;
    if (told == Told::kByNormals) params.model = WaveNormals::Model::kPlate;
    if (!of_map()) return params;
    params.model = WaveNormals::Model::kSlopes;
    params.tile_size = kPeriod;
    params.filter =
        told == Told::kByMap ? WaveNormals::Filter::kNone : WaveNormals::Filter::kVariance;
    return params;
  }

  void make() {
    Camera camera;
    camera.view = glm::lookAt(glm::dvec3(0, 4, 0), glm::dvec3(0, 0, 0), glm::dvec3(0, 0, -1));
    camera.projection = orthographic(kSide * kCell, kSide * kCell, 0.1, 50, ClipSpace::kGl);
    scene.camera = camera;
    scene.water = WaterPlane{};
    if (told == Told::kBySines) scene.water->waves = waves();
    scene.time = time;
    const double rise = sun_height * std::numbers::pi / 180,
                 turn = sun_turn * std::numbers::pi / 180;
    scene.sun = Sun{.direction = {std::cos(rise) * std::cos(turn), std::sin(rise),
                                  -std::cos(rise) * std::sin(turn)}};
    buffers.set(PlaneId::kDepth,
                [&](int x, int y) { return static_cast<float>(4 + deep(at(x), -at(y))); });
    for (int c = 0; c < 3; ++c) buffers.fill(plane_after(PlaneId::kColorR, c), 0.5f);
    if (of_map()) make_map();
    if (told == Told::kByNormals) make_normals();
  }
  static std::array<double, 3> normal_of(const WaveHeight& w) {
    const double length = std::sqrt(1 + w.slope_x * w.slope_x + w.slope_y * w.slope_y);
    return {-w.slope_x / length, -w.slope_y / length, 1 / length};
  }
  void make_map() {
    constexpr int kTexels = 256;
    for (Plane& plane : map) plane = Plane(rect_of({kTexels, kTexels}));
    const std::vector<SineWave> of = waves();
    for (int y = 0; y < kTexels; ++y) {
      for (int x = 0; x < kTexels; ++x) {
        const auto place = [](int i) { return kPeriod * (i + 0.5) / kTexels; };
        const std::array<double, 3> n = normal_of(wave_height(of, place(x), place(y), time));
        for (std::size_t c = 0; c < 3; ++c) {
          map[c].view().at(x, y) = static_cast<float>(0.5 + 0.5 * n[c]);
        }
      }
    }
    for (std::size_t c = 0; c < 3; ++c) buffers.frame.wave_map.channels[c] = map[c].view();
    if (told == Told::kByMap) return;
    levels.make(buffers.frame.wave_map);
    slopes.make(levels.levels(), Kernel<WaveNormals>::four_shifts(params(), time),
                *make_executor(1));
    buffers.frame.wave_slopes = &slopes.levels();
  }
  /// World x is to the right, z down in the picture.
  void make_normals() {
    const std::vector<SineWave> of = waves();
    const int component[] = {0, 2, 1};
    for (int c = 0; c < 3; ++c) {
      buffers.set(plane_after(PlaneId::kSurfaceNormalX, c), [&](int x, int y) {
        const std::array<double, 3> n = normal_of(wave_height(of, at(x), -at(y), time));
        const double value = n[static_cast<std::size_t>(component[c])];
        return static_cast<float>(c == 2 ? -value : value);
      });
    }
  }
  static double at(int pixel) { return (pixel + 0.5 - kSide / 2) * kCell; }
  Swell swell() const { return {told == Told::kBySines, scene.water->waves, 1}; }
};

using LightMap = std::vector<double>;  // kSide x kSide, a value a cell of the bottom

/// How far calm light moves aside per unit of depth.
inline glm::dvec2 aside_of(const glm::dvec3& to_sun) {
  return glm::dvec2(to_sun) * (-1 / std::sqrt(kIor * kIor - 1 + to_sun.z * to_sun.z));
}

/// Photons from a grid of 4 mm, over the sun's disc, each counted where its ray meets the bottom;
/// over the light of calm water there. Each photon carries its transmitted share.
inline LightMap followed(const Basin& basin) {
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
  const double calm_passes = 1 - fresnel_exact(suns[0].z, kIor);
  const std::vector<SineWave> waves = basin.waves();
  const glm::dvec2 aside = aside_of({suns[0].x, suns[0].y, suns[0].z});
  const double sink = std::sqrt(1 / (1 + glm::dot(aside, aside)));
  const double focus = (kIor * sink - suns[0].z) / (kIor * sink * sink * sink);
  const double around = 0.3 + 4 * middle * focus * basin.slope + std::abs(0.8 * aside.x);
  const int count = static_cast<int>((kSide * kCell + 2 * around) / kStep);
  LightMap light(kSide * kSide);
  for (int row = 0; row < count; ++row) {
    const double y = (row + 0.5) * kStep - around - kSide * kCell / 2 - middle * aside.y;
    for (int column = 0; column < count; ++column) {
      const double x = (column + 0.5) * kStep - around - kSide * kCell / 2 - middle * aside.x;
      const WaveHeight w = basin.surface(waves, x, y);
      const double length = std::sqrt(1 + w.slope_x * w.slope_x + w.slope_y * w.slope_y);
      const Vec3<double> normal{-w.slope_x / length, -w.slope_y / length, 1 / length};
      for (const Vec3<double>& from : suns) {
        const double cosine = dot(from, normal);
        if (!(cosine > 0)) continue;
        const Vec3<double> in = refract(from, normal, 1 / kIor).direction;
        double depth = middle, bottom_x = 0, bottom_y = 0;
        const auto go = [&] {
          bottom_x = x - (depth + w.height) * in.x / in.z;
          bottom_y = y - (depth + w.height) * in.y / in.z;
        };
        if (basin.cliff) {  // upper bottom, lower bottom, or the wall between
          depth = basin.deep(-1, 0), go();
          if (bottom_x >= 0) depth = basin.deep(1, 0), go();
          if (depth != basin.deep(bottom_x, bottom_y)) continue;
        }
        for (int k = 0; k < 5 && !basin.cliff; ++k) go(), depth = basin.deep(bottom_x, bottom_y);
        const int cell_x = static_cast<int>(std::floor(bottom_x / kCell + kSide / 2));
        const int cell_y = static_cast<int>(std::floor(-bottom_y / kCell + kSide / 2));
        if (cell_x < 0 || cell_y < 0 || cell_x >= kSide || cell_y >= kSide) continue;
        const double passes = (1 - fresnel_exact(cosine, kIor)) / calm_passes;
        const double power = passes * cosine * length / suns[0].z;
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

/// The table's light, but 0 where the dry picture has the sun's shadow.
inline LightMap of_table(const Basin& basin, const CausticsTable& table) {
  const Pass pass(basin.scene, basin.buffers.frame, kIor, kWholeState, basin.swell());
  const glm::dvec3& sun = basin.scene.sun->direction;
  const glm::dvec2 aside =
      aside_of({glm::dot(sun, pass.map_x), glm::dot(sun, pass.map_y), glm::dot(sun, pass.up)});
  LightMap light(kSide * kSide);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double deep = basin.deep(Basin::at(x), -Basin::at(y));
      const Vec2<double> entry{Basin::at(x) - deep * aside.x, -Basin::at(y) - deep * aside.y};
      if (basin.shaded(Basin::at(x), aside.x)) continue;
      light[y * kSide + x] = caustics_at(table, Grid{}, entry, kCell);
    }
  }
  return light;
}

/// Blurred by a Gaussian of two cells.
inline LightMap blurred(const LightMap& picture) {
  const auto along = [](const LightMap& from, int step_x, int step_y) {
    LightMap to(from.size());
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

/// Compares the cells for which `judged(x, y)` holds.
inline Beside beside(const LightMap& truth, const LightMap& table,
                     const std::function<bool(double, double)>& judged) {
  const LightMap a = blurred(truth), b = blurred(table);
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

inline Beside judge(Basin& basin, const std::function<bool(double, double)>& judged) {
  basin.make();
  const Pass pass(basin.scene, basin.buffers.frame, kIor, kWholeState, basin.swell());
  CausticsMaker maker;
  const auto executor = make_executor(1);
  const WaveNormals::Params params = basin.params();
  const CausticsTable* table = maker.make(&params, {0, 0, 0}, basin.buffers.frame, pass, *executor);
  EXPECT_GT(table->count, 0);
  return beside(followed(basin), of_table(basin, *table), judged);
}

/// The table of a basin a metre deep.
inline CausticsTable table_of(Basin& basin, CausticsMaker& maker, int threads = 1) {
  if (!basin.deep) basin.deep = [](double, double) { return 1.0; };
  basin.make();
  const Pass pass(basin.scene, basin.buffers.frame, kIor, kWholeState, basin.swell());
  const WaveNormals::Params params = basin.params();
  return *maker.make(&params, {0, 0, 0}, basin.buffers.frame, pass, *make_executor(threads));
}

}  // namespace limpid::test
