#include <cmath>
#include <cstring>

#include "judge/hard/hard_case.h"
#include "judge/hard/sea.h"

namespace limpid {
namespace {

/// The same water in units 1 / scale as long: lengths grow, losses per length fall.
Look scaled(Look look, double scale) {
  DepthFog::Params& fog = look.of<DepthFog>();
  fog.water_type = WaterType::kCustom;  // water types are per metre
  fog.density /= scale;
  fog.absorption = (1 / scale) * fog.absorption;
  fog.scattering = (1 / scale) * fog.scattering;
  WaveNormals::Params& waves = look.of<WaveNormals>();
  waves.tile_size *= scale;
  waves.speed *= scale;
  return look;
}

Sea scaled(Sea sea, double scale) {
  sea.height *= scale;
  sea.depth *= scale;
  sea.near *= scale;
  sea.far *= scale;
  return sea;
}

HardFrame scaled_noise(Size size, float scale) {
  HardFrame frame = noisy_frame(size);
  for (const PlaneId id :
       {PlaneId::kSurfaceNormalX, PlaneId::kSurfaceNormalY, PlaneId::kSurfaceNormalZ}) {
    frame.remove(id);  // waves come from the map, whose tile size is a length, too
  }
  for (const PlaneId id :
       {PlaneId::kDepth, PlaneId::kSurfaceDepth, PlaneId::kBelowDepth, PlaneId::kReflectionDepth}) {
    const View<float> plane = frame.plane(id);
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) plane.at(x, y) *= scale;
    }
  }
  return frame;
}

/// Bit for bit: a power of two changes only exponents.
Worst powers_of_two(const HardWorld& world) {
  Worst worst;
  const Sea sea{.size = {37, 19}};
  const auto picture_of = [&](const std::string& runner, const Look& look, double scale) {
    Scene scene = scaled(sea, scale).scene();
    scene.time = 3;
    return world.run(runner, scaled(look, scale), scaled_noise(sea.size, static_cast<float>(scale)),
                     scene);
  };
  for (const Look& look : world.looks()) {
    for (const std::string& runner : world.runners()) {
      const HardPicture judge = picture_of(runner, look, 1);
      for (const double scale : {0x1p-10, 0x1p10}) {
        const HardPicture picture = picture_of(runner, look, scale);
        for (int c = 0; c < 3; ++c) {
          for (int y = 0; y < sea.size.height; ++y) {
            for (int x = 0; x < sea.size.width; ++x) {
              worst.expect(picture.color(c, x, y) == judge.color(c, x, y),
                           [&] { return place_text(runner, look.name, x, y); });
            }
          }
        }
      }
    }
  }
  return worst;
}

/// On calm water, so that no lookup depends on the last digit.
Worst powers_of_ten(const HardWorld& world) {
  Worst worst;
  const Sea sea;
  for (Look look : world.looks()) {
    look.of<WaveNormals>().strength = 0;
    for (const std::string& runner : world.runners()) {
      const HardPicture judge = world.run(runner, scaled(look, 1), sea.frame(), sea.scene());
      for (const double scale : {1e-3, 1e3}) {
        const Sea other = scaled(sea, scale);
        const HardPicture picture =
            world.run(runner, scaled(look, scale), other.frame(), other.scene());
        for (int c = 0; c < 3; ++c) {
          for (int y = 0; y < sea.size.height; ++y) {
            for (int x = 0; x < sea.size.width; ++x) {
              worst.add(std::abs(picture.color(c, x, y) - judge.color(c, x, y)),
                        [&] { return place_text(runner, look.name, x, y); });
            }
          }
        }
      }
    }
  }
  return worst;
}

}  // namespace

void add_scale_cases(HardCases& cases) {
  add_sea_cases(cases, "scene units", "1e-3", scaled(Sea{}, 1e-3));
  add_sea_cases(cases, "scene units", "1e3", scaled(Sea{}, 1e3));
  cases.push_back({"scene units", "2^-10 and 2^10, every look", "values that differ",
                   "a power of two changes exponents alone: the same bits", 0, powers_of_two});
  cases.push_back({"scene units", "1e-3 and 1e3, every look",
                   "difference from units of 1 (white = 1)",
                   "100 roundings of the path and 60 of the light on it, of both pictures, of "
                   "colors up to 1.2",
                   1.2 * 2 * (100 + 60) * kRounding, powers_of_ten});
}

}  // namespace limpid
