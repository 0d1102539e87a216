#include <cmath>

#include "judge/hard/hard_case.h"
#include "judge/hard/sea.h"

namespace limpid {
namespace {

using Real = long double;

/// From grazing views to straight down: cosines of 0 ... 1, so bases of 1 ... 0.
const Sea kSea{.size = {7, 90}, .down = 89, .fov = 178, .far = 1e9};
const Sea kStraightDown{.size = {9, 9}, .down = 90, .fov = 1};

Look look_of(const HardWorld& world, double power) {
  Look look = calm_look(world);
  look.of<FresnelReflection>().reflectance = FresnelReflection::Reflectance::kRim;
  look.of<FresnelReflection>().power = std::min(power, 100.0);
  look.of<SunHighlight>() = {.model = SunHighlight::Model::kBlinnPhong, .power = power};
  look.of<Penetration>() = {.model = Penetration::Model::kViewAngle,
                            .power = std::min(power, 100.0)};
  return look;
}

Sun sun_above() { return {{0, 1, 0}, {1, 1, 1}}; }

/// 1 for every base, including 0 (seen straight down).
Worst exponent_zero(const HardWorld& world) {
  Worst worst;
  const Look look = look_of(world, 0);
  for (const Sea* sea : {&kSea, &kStraightDown}) {
    const HardFrame frame = sea->frame();
    Scene scene = sea->scene();
    scene.sun = sun_above();
    for (const std::string& runner : world.runners()) {
      const HardPicture picture = world.run(runner, look, frame, scene);
      for (int y = 0; y < sea->size.height; ++y) {
        if (!picture.wet(4, y)) continue;
        const auto where = [&] { return place_text(runner, look.name, 4, y); };
        worst.add(std::abs(picture.aov(Aov::kFresnel, 4, y) - 1), where);
        // Light from straight above, a lobe of 1; 1 - 0.2 1^0 of it remains: 0.8.
        worst.add(std::abs(picture.aov(Aov::kHighlight, 4, y) - 0.8), where);
      }
    }
  }
  return worst;
}

/// (1 - V.n)^100 over its bound.
Worst reflectance(const HardWorld& world) {
  Worst worst;
  for (const double power : {100.0, 99.5}) {
    Look look = look_of(world, power);
    look.of<Penetration>().model = Penetration::Model::kNone;
    const HardFrame frame = kSea.frame();
    for (const std::string& runner : world.runners()) {
      const HardPicture picture = world.run(runner, look, frame, kSea.scene());
      for (int y = 0; y < kSea.size.height; ++y) {
        const Sea::Pixel p = kSea.at(3, y);
        if (!p.water) continue;
        const Real base = 1 - p.cosine, exact = std::pow(base, Real(power));
        // The base has 7 roundings of 1, which count p / base fold. A product chain adds p / 2^24,
        // exp(p log x) 3e-7 (2 + p |log x|); below 1.2e-38 is 0.
        const Real relative = 7 * kRounding * power / base + power * kRounding +
                              3e-7L * (2 + power * std::abs(std::log(base)));
        const Real bound = exact * relative + 0x1p-126L;
        // For large p the first-order sum is no bound any more: there all values are nearly 0.
        if (relative > Real(0.1)) {
          worst.add(picture.aov(Aov::kFresnel, 3, y) > 1e-30 ? HUGE_VAL : 0,
                    [&] { return place_text(runner, look.name, 3, y); });
          continue;
        }
        worst.add(double(std::abs(picture.aov(Aov::kFresnel, 3, y) - exact) / bound),
                  [&] { return place_text(runner, look.name, 3, y); });
      }
    }
  }
  return worst;
}

/// Counts the fused runner's denormals; the reference is in double and judges, and a GPU is as fast
/// with denormals.
Worst denormals(const HardWorld& world) {
  Worst worst;
  const HardFrame frame = kSea.frame();
  Scene scene = kSea.scene();
  scene.sun = sun_above();
  for (const double power : {100.0, 200.0, 256.0, 300.0, 1e5}) {
    const Look look = look_of(world, power);
    for (const std::string& runner : world.runners()) {
      if (runner == world.runners()[0] || runner == "gpu") continue;
      const HardPicture picture = world.run(runner, look, frame, scene);
      picture.for_each_value([&](float value, int x, int y, bool) {
        worst.expect(std::fpclassify(value) != FP_SUBNORMAL,
                     [&] { return place_text(runner, std::to_string(power), x, y); });
      });
    }
  }
  return worst;
}

/// n.h of a sun straight above is cos of half the angle of the view.
Worst highlight(const HardWorld& world) {
  Worst worst;
  const HardFrame frame = kSea.frame();
  Scene scene = kSea.scene();
  scene.sun = sun_above();
  for (const double power : {200.0, 256.0, 256.5, 1e5}) {
    Look look = look_of(world, power);
    look.of<Penetration>().model = Penetration::Model::kNone;
    for (const std::string& runner : world.runners()) {
      const HardPicture picture = world.run(runner, look, frame, scene);
      for (int y = 0; y < kSea.size.height; ++y) {
        const Sea::Pixel p = kSea.at(3, y);
        if (!p.water) continue;
        const Real base = std::sqrt((1 + p.cosine) / 2), exact = std::pow(base, Real(power));
        // 8 roundings of the base (to_viewer, half vector, dot product), then as above.
        const Real relative =
            power * 9 * kRounding / base + 3e-7L * (2 + power * std::abs(std::log(base)));
        const Real bound = exact * std::expm1(relative) + 0x1p-126L;
        worst.add(double(std::abs(picture.aov(Aov::kHighlight, 3, y) - exact) / bound),
                  [&] { return place_text(runner, std::to_string(power), 3, y); });
      }
    }
  }
  return worst;
}

}  // namespace

void add_power_cases(HardCases& cases) {
  cases.push_back({"powers", "exponent 0, base 0 to 1", "error of reflectance and lobe",
                   "x^0 is 1, for 0, too; 4 roundings", 4 * kRounding, exponent_zero});
  cases.push_back({"powers", "(1 - V.n)^100", "error over its bound",
                   "7 roundings of 1 - V.n times 100 / (1 - V.n), and the power's own", 1,
                   reflectance});
  cases.push_back({"powers", "(n.h)^200 to ^1e5", "error over its bound",
                   "8 roundings of n.h times the exponent, and the power's own", 1, highlight});
  cases.push_back({"powers", "denormals made by fused", "values",
                   "denormals are slow: fused replaces them by 0", 0, denormals});
}

}  // namespace limpid
