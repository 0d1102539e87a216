#include <cmath>
#include <numbers>

#include "judge/hard/hard_case.h"
#include "judge/hard/sea.h"
#include "op/pass.h"
#include "optics/waves.h"

namespace limpid {
namespace {

using Real = long double;

constexpr double kLate = 1e7;  // seconds: almost four months
constexpr Real kTurn = 2 * std::numbers::pi_v<Real>;

/// Across the view, along it, and diagonal.
const std::vector<SineWave> kWaves = {
    {0.05, 1.1, 0.3, 0.5, 3.19}, {0.02, -0.4, 2.3, 1.25, 4.78}, {0.01, 3.7, -1.9, 2.75, 6.38}};

Worst phases(const HardWorld&) {
  Worst worst;
  for (const SineWave& wave : kWaves) {
    for (const double time : {0.0, 1.0, 1e4, kLate, -kLate, 1e7 + 0.125}) {
      // The product of two doubles, exactly, in two parts.
      const double high = wave.omega * time, low = std::fma(wave.omega, time, -high);
      const Real turns = std::remainder(high / kTurn, Real(1)) + low / kTurn;
      const Real exact = wave.phase / kTurn - turns;
      const Real off = std::remainder(wave_offset(wave, time) / kTurn - exact, Real(1));
      // Half an ulp of omega t; 2 pi in double has an error of 2.5e-16, once per turn.
      const Real bound =
          std::abs(high) * (0x1p-53L / kTurn + 2.5e-16L / (kTurn * kTurn)) + 4 * 0x1p-53L;
      worst.add(double(std::abs(off) / bound), [&] { return std::to_string(time) + " s"; });
    }
  }
  return worst;
}

/// Normals of waves at that time against those of exact phases.
Worst waves(const HardWorld& world) {
  Worst worst;
  const Sea sea;
  const HardFrame frame = sea.frame();
  Scene scene = sea.scene();
  scene.water->waves = kWaves;
  scene.time = kLate + 1.0 / 3;  // a time whose multiples are never exact floats
  Look look = calm_look(world);
  look.of<WaveNormals>().model = WaveNormals::Model::kSines;
  look.of<WaveNormals>().strength = 1;
  const Rays rays = rays_of(*scene.camera, {sea.size.width, sea.size.height});
  for (const std::string& runner : world.runners()) {
    const HardPicture picture = world.run(runner, look, frame, scene);
    for (int y = 0; y < sea.size.height; ++y) {
      for (int x = 0; x < sea.size.width; ++x) {
        const glm::dvec3 to_surface = double(sea.at(x, y).surface) * rays.ray_at(x + 0.5, y + 0.5);
        // Map axes: world x, and up cross x, which is -z.
        const Real along_x = to_surface.x, along_y = -to_surface.z;
        Real slope_x = 0, slope_y = 0, bound = 6 * kRounding;
        for (const SineWave& wave : kWaves) {
          const Real phase = wave.phase + wave.k_x * along_x + wave.k_y * along_y -
                             std::fmod(Real(wave.omega) * scene.time, kTurn);
          slope_x += wave.amplitude * wave.k_x * std::cos(phase);
          slope_y += wave.amplitude * wave.k_y * std::cos(phase);
          // 8 roundings of the place, in rad, 2 of the turn and 1.5e-7 of the cosine.
          const Real steep = wave.amplitude * std::hypot(wave.k_x, wave.k_y);
          const Real far = std::abs(wave.k_x * along_x) + std::abs(wave.k_y * along_y);
          bound += steep * ((8 * far + 2 * kTurn) * kRounding + 1.5e-7L);
        }
        const Real length = std::sqrt(1 + slope_x * slope_x + slope_y * slope_y);
        const Real off = std::hypot(picture.aov(Aov::kNormal, x, y, 0) + slope_x / length,
                                    picture.aov(Aov::kNormal, x, y, 1) - 1 / length,
                                    picture.aov(Aov::kNormal, x, y, 2) - slope_y / length);
        worst.add(double(off / bound), [&] { return place_text(runner, look.name, x, y); });
      }
    }
  }
  return worst;
}

/// Maps drift by whole periods in 16 s, and 1e7 s is 625000 times that: the picture equals that of
/// 0 s, bit for bit. So does that of two flows, although the second drifts at 0.3 of the speed: 0.3
/// in double is 1.2e-17 too small, 625000 times that is 7e-12, and less than half an ulp of 187500
/// (1.5e-11).
Worst drift(const HardWorld& world) {
  Worst worst;
  const Size size{39, 21};
  HardFrame frame = noisy_frame(size);
  for (const PlaneId id :
       {PlaneId::kSurfaceNormalX, PlaneId::kSurfaceNormalY, PlaneId::kSurfaceNormalZ}) {
    frame.remove(id);
  }
  Scene scene = noisy_scene(size);
  for (Look look : world.looks()) {
    look.of<WaveNormals>().tile_size = 4;
    look.of<WaveNormals>().speed = 0.25;
    look.of<WaveNormals>().direction = 0;
    for (const std::string& runner : world.runners()) {
      scene.time = 0;
      const HardPicture judge = world.run(runner, look, frame, scene);
      scene.time = kLate;
      const HardPicture picture = world.run(runner, look, frame, scene);
      scene.time = 3;
      const HardPicture other = world.run(runner, look, frame, scene);
      bool moves = false;
      for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
          const double was = judge.aov(Aov::kNormal, x, y), is = picture.aov(Aov::kNormal, x, y);
          worst.expect(is == was, [&] { return place_text(runner, look.name, x, y); });
          moves = moves || other.aov(Aov::kNormal, x, y) != was;
        }
      }
      worst.expect(moves, [&] { return runner + ", " + look.name + ": nothing moves"; });
    }
  }
  return worst;
}

Worst sound(const HardWorld& world) {
  const Size size{31, 17};
  HardFrame frame = noisy_frame(size);
  frame.remove(PlaneId::kSurfaceNormalX);
  frame.remove(PlaneId::kSurfaceNormalY);
  frame.remove(PlaneId::kSurfaceNormalZ);
  Worst worst;
  for (const double time : {kLate, -kLate, 1e15, 1e300}) {
    Scene scene = noisy_scene(size);
    scene.water->waves = kWaves;
    scene.time = time;
    worst.add_counts(unsound_values(world, frame, scene));
  }
  return worst;
}

}  // namespace

void add_time_cases(HardCases& cases) {
  cases.push_back({"time", "phase of waves to 1e7 s", "error over its bound",
                   "half an ulp of omega t, and the error of 2 pi in double times the turns", 1,
                   phases});
  cases.push_back(
      {"time", "normals of waves at 1e7 s", "error over its bound",
       "8 roundings of the position in rad, 2 of a turn, 1.5e-7 of the cosine; 6 of the "
       "normal",
       1, waves});
  cases.push_back({"time", "drift of maps at 1e7 s, every look",
                   "normals that differ from those at 0 s",
                   "625000 whole periods, or 187500 at 0.3 of the speed: the same bits", 0, drift});
  cases.push_back({"time", "1e7 s to 1e300 s, every look", "values that are not finite",
                   "valid input gives finite values", 0, sound});
}

}  // namespace limpid
