#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "judge/hard/hard_case.h"
#include "judge/hard/sea.h"

namespace limpid {
namespace {

constexpr Size kSize{45, 23};

struct Kind {
  const char* name;
  float value;
};
using Float = std::numeric_limits<float>;
constexpr Kind kKinds[] = {
    {"NaN", Float::quiet_NaN()},
    {"inf", Float::infinity()},
    {"-inf", -Float::infinity()},
    {"-1", -1},
    {"denormal", 1e-40f},
    {"65504", 65504},
    {"-65504", -65504},
    {"1e30", 1e30f},
    {"-1e30", -1e30f},
};

/// A frame in all of whose planes about every eighth texel is that value, entered like a loader's
/// frame.
HardFrame littered(float value, const glm::dvec3& up) {
  HardFrame frame = noisy_frame(kSize);
  for (int i = 0; i < kPlaneCount; ++i) {
    const View<float> plane = frame.plane(static_cast<PlaneId>(i));
    for (int y = 0; y < kSize.height; ++y) {
      for (int x = 0; x < kSize.width; ++x) {
        if (hard_noise(x, y, 90 + i) < 0.12f) plane.at(x, y) = value;
      }
    }
  }
  frame.sanitise(up);
  return frame;
}

Worst sound(const HardWorld& world, float value) {
  const Scene scene = noisy_scene(kSize);
  return unsound_values(world, littered(value, scene.water->up), scene);
}

/// Every value except those that entry replaces.
Worst dry_bits(const HardWorld& world) {
  Worst worst;
  const Scene scene = noisy_scene(kSize);
  for (const Kind& kind : kKinds) {
    if (!std::isfinite(kind.value)) continue;
    const HardFrame frame = littered(kind.value, scene.water->up);
    const View<const float>& depth = frame.frame().plane(PlaneId::kDepth);
    const View<const float>& surface = frame.frame().plane(PlaneId::kSurfaceDepth);
    const View<const float>& dry = frame.frame().plane(PlaneId::kColorB);
    for (const std::string& runner : world.runners()) {
      const HardPicture picture = world.run(runner, world.looks()[0], frame, scene);
      for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x) {
          if (surface.at(x, y) < depth.at(x, y)) continue;
          const float out = picture.target.color[2].at(x, y);
          worst.expect(
              std::bit_cast<std::uint32_t>(out) == std::bit_cast<std::uint32_t>(dry.at(x, y)),
              [&] { return place_text(runner, kind.name, x, y); });
        }
      }
    }
  }
  return worst;
}

/// An even environment.
Plane even_sky(double radiance) {
  Plane plane(Rect{0, 0, 8, 4});
  for (int y = 0; y < 4; ++y) std::fill_n(plane.view().row(y), 8, static_cast<float>(radiance));
  return plane;
}

void brightness_of(const HardWorld& world, const Look& look, int exponent, bool lit, Worst& worst) {
  const double times = std::ldexp(1, exponent);
  const Scene scene = noisy_scene(kSize);
  HardFrame frame = noisy_frame(kSize), bright = noisy_frame(kSize);
  Scene sunny = scene;
  const Plane sky = even_sky(0.3), bright_sky = even_sky(0.3 * times);
  if (lit) {
    sunny.sun->color = times * sunny.sun->color;
    frame.frame().environment.channels = {sky.view(), sky.view(), sky.view()};
    bright.frame().environment.channels = {bright_sky.view(), bright_sky.view(), bright_sky.view()};
  }
  for (HardFrame* made : {&frame, &bright}) {
    // The surroundings would replace it, as bright as ever.
    made->remove(PlaneId::kReflectionValid);
  }
  for (const PlaneId first :
       {PlaneId::kColorR, PlaneId::kReflectionR, PlaneId::kBelowR, PlaneId::kSunColorR}) {
    for (int c = 0; c < 3; ++c) {
      const View<float> plane = bright.plane(plane_after(first, c));
      for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x) plane.at(x, y) *= static_cast<float>(times);
      }
    }
  }
  for (const std::string& runner : world.runners()) {
    const HardPicture judge = world.run(runner, look, frame, scene);
    const HardPicture picture = world.run(runner, look, bright, sunny);
    for (const Aov term : {Aov::kTransmitted, Aov::kReflected}) {
      if (term == Aov::kReflected &&
          look.of<FresnelReflection>().source != FresnelReflection::Source::kPlanar) {
        continue;
      }
      for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x) {
          const double off = picture.aov(term, x, y) - times * judge.aov(term, x, y);
          worst.expect(off == 0, [&] { return place_text(runner, look.name, x, y); });
        }
      }
    }
  }
}

/// Light is linear: a world 2^80 times as bright has the same bits except the exponent. Radiative
/// transfer adds to the bottom's light what sun and sky send it through the water: with it, they
/// are as much brighter, and the world 2^20 times, for a sun may not be brighter.
Worst brightness(const HardWorld& world) {
  Worst worst;
  for (const Look& look : world.looks()) {
    const bool lit = look.of<DepthFog>().model == DepthFog::Model::kRadiativeTransfer;
    brightness_of(world, look, lit ? 20 : 80, lit, worst);
  }
  return worst;
}

}  // namespace

void add_pixel_cases(HardCases& cases) {
  for (const Kind& kind : kKinds) {
    cases.push_back(
        {"pixels", std::string(kind.name) + " in every plane, every look",
         "values that are not finite",
         "meaningless values are replaced on entry, and valid input gives finite values", 0,
         [=](const HardWorld& world) { return sound(world, kind.value); }});
  }
  cases.push_back({"pixels", "dry ones of every kind", "values with other bits",
                   "dry pixels are copied", 0, dry_bits});
  cases.push_back({"pixels", "2^80 times as bright, every look (2^20 with radiative transfer)",
                   "values with other bits", "light is linear: the exponent alone changes", 0,
                   brightness});
}

}  // namespace limpid
