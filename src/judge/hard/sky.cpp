#include <cmath>
#include <limits>

#include "judge/hard/hard_case.h"
#include "judge/hard/sea.h"

namespace limpid {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

/// Water without a bottom, up to the horizon.
struct Abyss {
  Sea sea{.size = {16, 27}, .down = 15};
  HardFrame frame{sea.frame()};
  Scene scene = sea.scene();

  Abyss() { frame.fill(PlaneId::kDepth, kInf); }
};

Worst sound(const HardWorld& world) {
  Worst worst;
  Abyss abyss;
  worst.add_counts(unsound_values(world, abyss.frame, abyss.scene));
  abyss.frame.remove(PlaneId::kSurfaceDepth);  // waves, and a surface to the horizon
  worst.add_counts(unsound_values(world, abyss.frame, abyss.scene));
  return worst;
}

/// A look and its transmittance for an endless path.
struct Fog {
  DepthFog::Params params;
  double left;
};

/// Every distance of both models, in water that absorbs and in water that does not.
std::vector<Fog> fogs() {
  std::vector<Fog> fogs;
  for (const auto distance :
       {DepthFog::Distance::kEye, DepthFog::Distance::kRay, DepthFog::Distance::kRefracted}) {
    const auto add = [&](DepthFog::Params params, double left) {
      params.distance = distance;
      params.water_type = WaterType::kCustom;
      fogs.push_back({params, left});
    };
    const Rgb<double> none{0, 0, 0};
    add({.model = DepthFog::Model::kLinear, .density = 0, .alpha = 0.9}, 1);
    add({.model = DepthFog::Model::kLinear, .density = 1e-6, .alpha = 0.75}, 0.25);
    add({.model = DepthFog::Model::kLinear, .density = 0, .offset = 1e6, .alpha = 1}, 1);
    // 0 x inf, if it were NaN, would be clamped to no fog, without the fog of the offset.
    add({.model = DepthFog::Model::kLinear, .density = 0, .offset = -1, .alpha = 0.75}, 0.25);
    add({.absorption = none, .scattering = none}, 1);
    add({.absorption = {1e-6, 1e-6, 1e-6}, .scattering = none}, 0);
    add({.absorption = none, .scattering = {1e-6, 1e-6, 1e-6}}, 0);
  }
  return fogs;
}

Worst limits(const HardWorld& world) {
  Worst worst;
  const Abyss abyss;
  for (const Fog& fog : fogs()) {
    Look look = calm_look(world);
    look.of<DepthFog>() = fog.params;
    for (const std::string& runner : world.runners()) {
      const HardPicture picture = world.run(runner, look, abyss.frame, abyss.scene);
      for (int y = 0; y < abyss.sea.size.height; ++y) {
        if (!picture.wet(5, y)) continue;
        for (int c = 0; c < 3; ++c) {
          worst.add(std::abs(picture.aov(Aov::kTransmittance, 5, y, c) - fog.left),
                    [&] { return place_text(runner, look.name, 5, y); });
        }
        worst.add(std::isfinite(picture.color(0, 5, y)) ? 0 : kInf,
                  [&] { return place_text(runner, look.name, 5, y); });
      }
    }
  }
  return worst;
}

/// Surface and bottom both infinitely far: no water, for any difference.
Worst nothing_at_all(const HardWorld& world) {
  Worst worst;
  Abyss abyss;
  abyss.frame.fill(PlaneId::kSurfaceDepth, kInf);
  for (const Look& look : world.looks()) {
    for (const std::string& runner : world.runners()) {
      const HardPicture picture = world.run(runner, look, abyss.frame, abyss.scene);
      for (int y = 0; y < abyss.sea.size.height; ++y) {
        for (int x = 0; x < abyss.sea.size.width; ++x) {
          const float dry = abyss.frame.frame().plane(PlaneId::kColorG).at(x, y);
          worst.expect(picture.color(1, x, y) == dry,
                       [&] { return place_text(runner, look.name, x, y); });
        }
      }
    }
  }
  return worst;
}

}  // namespace

void add_sky_cases(HardCases& cases) {
  cases.push_back({"sky", "under water, every look", "values that are not finite",
                   "inf - inf and 0 x inf do not occur", 0, sound});
  cases.push_back({"sky", "fog of 0 and of next to 0", "error of the transmittance",
                   "the limits: 1 without absorption, else 0 (1 - alpha); 4 roundings",
                   4 * kRounding, limits});
  cases.push_back({"sky", "behind no surface, every look",
                   "values that differ from the dry picture", "inf is not in front of inf", 0,
                   nothing_at_all});
}

}  // namespace limpid
