#include <cmath>

#include "judge/hard/hard_case.h"
#include "judge/hard/sea.h"

namespace limpid {
namespace {

using Real = long double;

constexpr double kIncidence[] = {80, 89, 89.9, 89.99};

/// A narrow view of water at that angle of incidence.
Sea sea_at(double incidence, bool turned) {
  const double down = 90 - incidence;
  return {.size = {16, 9}, .down = down, .fov = 0.2 * down, .turned = turned};
}

struct Model {
  FresnelReflection::Reflectance reflectance;
  const char* name;
  double steepest;  ///< over the cosine
  Real (*exact)(Real cosine);
};

/// With the operator's default parameters: power 3, intensity 1, f0 0.020373.
constexpr Model kModels[] = {
    {FresnelReflection::Reflectance::kRim, "rim", 3,
     [](Real c) { return std::pow(1 - c, Real(3)); }},
    {FresnelReflection::Reflectance::kLinear, "linear", 1, [](Real c) { return 1 - c; }},
    {FresnelReflection::Reflectance::kInversePower, "inverse power", 3,
     [](Real c) { return 1 - c * c * c; }},
    {FresnelReflection::Reflectance::kSchlick, "schlick", 5,
     [](Real c) { return Real(0.020373) + (1 - Real(0.020373)) * std::pow(1 - c, Real(5)); }},
};

Worst reflectance(const HardWorld& world, const Model& model) {
  Worst worst;
  Look look = calm_look(world);
  look.of<FresnelReflection>() = {.reflectance = model.reflectance,
                                  .source = FresnelReflection::Source::kConstant};
  for (const double incidence : kIncidence) {
    for (const bool turned : {false, true}) {
      const Sea sea = sea_at(incidence, turned);
      const HardFrame frame = sea.frame();
      for (const std::string& runner : world.runners()) {
        const HardPicture picture = world.run(runner, look, frame, sea.scene());
        for (int y = 0; y < sea.size.height; ++y) {
          const Real off = picture.aov(Aov::kFresnel, 3, y) - model.exact(sea.at(3, y).cosine);
          worst.add(double(std::abs(off)), [&] {
            return place_text(runner, std::to_string(incidence) + " degrees", 3, y);
          });
        }
      }
    }
  }
  return worst;
}

/// Violations of energy conservation: transmittance and reflectance must lie in 0 ... 1.
Worst shares(const HardWorld& world) {
  Worst worst;
  for (const double incidence : kIncidence) {
    const Sea sea = sea_at(incidence, true);
    const HardFrame frame = sea.frame();
    for (const Look& look : world.looks()) {
      for (const std::string& runner : world.runners()) {
        const HardPicture picture = world.run(runner, look, frame, sea.scene());
        for (int y = 0; y < sea.size.height; ++y) {
          for (const Aov share : {Aov::kFresnel, Aov::kTransmittance, Aov::kConfidence}) {
            const double s = picture.aov(share, 3, y);
            worst.add(std::max(-s, s - 1), [&] { return place_text(runner, look.name, 3, y); });
          }
        }
      }
    }
  }
  return worst;
}

}  // namespace

void add_angle_cases(HardCases& cases) {
  for (const double incidence : kIncidence) {
    char name[32];
    std::snprintf(name, sizeof name, "%g degrees", incidence);
    add_sea_cases(cases, "angles", name, sea_at(incidence, false));
  }
  add_sea_cases(cases, "angles", "89.99 degrees, turned", sea_at(89.99, true));
  for (const Model& model : kModels) {
    cases.push_back({"angles", std::string("to 89.99 degrees, ") + model.name,
                     "error of the reflectance",
                     "6 roundings of the cosine times the largest slope, and 8 of the formula",
                     (6 * model.steepest + 8) * kRounding,
                     [=](const HardWorld& world) { return reflectance(world, model); }});
  }
  cases.push_back({"angles", "to 89.99 degrees, shares", "distance of shares from 0 ... 1",
                   "8 roundings of a share near 1", 8 * kRounding, shares});
}

}  // namespace limpid
