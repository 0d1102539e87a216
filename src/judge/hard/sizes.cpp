#include <cmath>

#include "judge/hard/hard_case.h"
#include "judge/hard/sea.h"

namespace limpid {
namespace {

constexpr Size kAwkward[] = {{1, 1}, {1, 9}, {9, 1}, {7, 5}, {127, 3}, {129, 3}, {3, 131}};
constexpr Size kWide{32768, 2};

Worst sound(const HardWorld& world) {
  Worst worst;
  for (const Size size : kAwkward) {
    HardFrame frame = noisy_frame(size);
    frame.plane(PlaneId::kDepth).at(0, 0) = 9;  // some water even in the smallest
    frame.plane(PlaneId::kSurfaceDepth).at(0, 0) = 4;
    worst.add_counts(unsound_values(world, frame, noisy_scene(size)));
  }
  return worst;
}

Worst closed_forms(const HardWorld& world) {
  Worst worst;
  for (const Size size : kAwkward) {
    for (const SeaError what : {SeaError::kSurface, SeaError::kPath, SeaError::kReflectance}) {
      const Worst one = sea_error(world, {.size = size}, what);
      worst.add(one.value(), [&] {
        return one.where() + " of " + std::to_string(size.width) + "x" +
               std::to_string(size.height);
      });
    }
  }
  return worst;
}

/// Error of a lookup in columns. Colors identify columns: red counts them, from 0 to 255 and again;
/// columns where it restarts are skipped.
Worst lookups(const HardWorld& world) {
  Worst worst;
  constexpr int kPeriod = 256;
  constexpr double kTilt = 0.28;
  const Sea sea{.size = kWide, .fov = 0.001, .pixel_aspect = 1e-3};
  HardFrame frame = sea.frame();
  frame.set(PlaneId::kColorR, [](int x, int) { return x % kPeriod; });
  frame.normal({kTilt, std::sqrt(1 - kTilt * kTilt), 0});
  Look look = calm_look(world);
  Refraction::Params& refraction = look.of<Refraction>();
  refraction = {.model = Refraction::Model::kNormalOffset,
                .rejection = Refraction::Rejection::kNone,
                .off_frame = Refraction::OffFrame::kClamp};
  look.of<DepthFog>().model = DepthFog::Model::kLinear;
  look.of<DepthFog>().alpha = 0;
  look.of<FresnelReflection>() = {.reflectance = FresnelReflection::Reflectance::kInversePower,
                                  .power = 0,
                                  .intensity = 1,
                                  .source = FresnelReflection::Source::kConstant};
  const double tilt = static_cast<float>(kTilt);
  for (const double strength : {-0.02, 0.03}) {
    refraction.strength = strength;
    const double columns = strength * tilt * kWide.width;
    for (const std::string& runner : world.runners()) {
      const HardPicture picture = world.run(runner, look, frame, sea.scene());
      for (int x = 0; x < kWide.width; x += 7) {
        const double at = x + columns, in_period = at - kPeriod * std::floor(at / kPeriod);
        if (at < 1 || at > kWide.width - 2 || in_period > kPeriod - 1.01 || in_period < 0.01) {
          continue;
        }
        // 4 roundings of the shift in columns, 4 of a color up to 255.
        const double bound = (4 * std::abs(columns) + 4 * kPeriod) * kRounding;
        worst.add(std::abs(picture.aov(Aov::kTransmitted, x, 1) - in_period) / bound,
                  [&] { return place_text(runner, look.name, x, 1); });
      }
    }
  }
  return worst;
}

Worst wide_sound(const HardWorld& world) {
  Worst worst;
  // All looks in one size would take seconds in double: fused runners only.
  const HardFrame frame = noisy_frame(kWide);
  const Scene scene = noisy_scene({32768, 18432});
  for (const Look& look : world.looks()) {
    const HardPicture picture = world.run(world.runners()[1], look, frame, scene);
    picture.for_each_value([&](float value, int x, int y, bool aov) {
      worst.expect(aov ? !std::isnan(value) : std::isfinite(value),
                   [&] { return place_text(world.runners()[1], look.name, x, y); });
    });
  }
  return worst;
}

}  // namespace

void add_size_cases(HardCases& cases) {
  cases.push_back({"sizes", "1x1, 1xN, odd, every look", "values that are not finite",
                   "valid input gives finite values", 0, sound});
  cases.push_back({"sizes", "1x1, 1xN, odd: closed forms", "error over its bound",
                   "the bounds of surface depth, path and reflectance", 1, closed_forms});
  cases.push_back({"sizes", "32768 wide, lookups", "columns off, over their bound",
                   "4 roundings of the shift in columns, 4 of a color up to 255", 1, lookups});
  cases.push_back({"sizes", "32768 wide, every look", "values that are not finite",
                   "valid input gives finite values", 0, wide_sound});
}

}  // namespace limpid
