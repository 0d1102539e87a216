#include <cmath>
#include <limits>

#include "limpid/enter/sanitise.h"

#include "judge/hard/hard_case.h"
#include "judge/hard/sea.h"

namespace limpid {
namespace {

constexpr Size kSize{37, 21};
using Float = std::numeric_limits<float>;

/// Uniform on the sphere; half of the directions face away from any viewer.
glm::dvec3 direction(int x, int y) {
  const double up = 2 * hard_noise(x, y, 110) - 1, turn = 6.28 * hard_noise(x, y, 111);
  const double level = std::sqrt(1 - up * up);
  return {level * std::cos(turn), up, level * std::sin(turn)};
}

/// A frame with normals of that length, entered like a loader's frame.
HardFrame frame_of_length(float length) {
  HardFrame frame = noisy_frame(kSize);
  for (int c = 0; c < 3; ++c) {
    frame.set(plane_after(PlaneId::kSurfaceNormalX, c),
              [&](int x, int y) { return length * static_cast<float>(direction(x, y)[c]); });
  }
  frame.sanitise({0, 1, 0});
  return frame;
}

glm::dvec3 normal_at(HardFrame& frame, int x, int y) {
  return {frame.plane(PlaneId::kSurfaceNormalX).at(x, y),
          frame.plane(PlaneId::kSurfaceNormalY).at(x, y),
          frame.plane(PlaneId::kSurfaceNormalZ).at(x, y)};
}

Worst unnormalised(const HardWorld&) {
  Worst worst;
  for (const float length : {1e-12f, 1e-3f, 0.5f, 1.7f, 1e4f, 1e20f, 1e38f}) {
    HardFrame frame = frame_of_length(length);
    for (int y = 0; y < kSize.height; ++y) {
      for (int x = 0; x < kSize.width; ++x) {
        worst.add(glm::length(normal_at(frame, x, y) - direction(x, y)),
                  [&] { return "length " + std::to_string(length); });
      }
    }
  }
  return worst;
}

Worst without_direction(const HardWorld&) {
  Worst worst;
  for (const float length : {0.0f, -0.0f, Float::denorm_min(), Float::quiet_NaN(),
                             Float::infinity(), -Float::infinity()}) {
    HardFrame frame = frame_of_length(length);
    for (int y = 0; y < kSize.height; ++y) {
      worst.expect(normal_at(frame, 3, y) == glm::dvec3(0, 1, 0),
                   [&] { return "length " + std::to_string(length); });
    }
  }
  return worst;
}

Worst sound(const HardWorld& world) {
  return unsound_values(world, frame_of_length(1), noisy_scene(kSize));
}

/// Facets that face away from the viewer count as edge on; their reflectance must not exceed 1.
Worst shares(const HardWorld& world) {
  Worst worst;
  const HardFrame frame = frame_of_length(1);
  for (const Look& look : world.looks()) {
    for (const std::string& runner : world.runners()) {
      const HardPicture picture = world.run(runner, look, frame, noisy_scene(kSize));
      for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x) {
          const double share = picture.aov(Aov::kFresnel, x, y);
          worst.add(std::max(-share, share - 1),
                    [&] { return place_text(runner, look.name, x, y); });
        }
      }
    }
  }
  return worst;
}

/// The view is exactly level with the facet: all light is mirrored.
Worst edge_on(const HardWorld& world) {
  Worst worst;
  using Reflectance = FresnelReflection::Reflectance;
  const Sea sea{.size = {8, 5}, .orthographic = 2};
  HardFrame frame = sea.frame();
  frame.normal({1, 0, 0});
  for (const auto model : {Reflectance::kRim, Reflectance::kInversePower, Reflectance::kSchlick,
                           Reflectance::kExact}) {
    Look look = calm_look(world);
    look.of<FresnelReflection>().reflectance = model;
    for (const std::string& runner : world.runners()) {
      const HardPicture picture = world.run(runner, look, frame, sea.scene());
      for (int y = 0; y < sea.size.height; ++y) {
        worst.add(std::abs(picture.aov(Aov::kFresnel, 3, y) - 1),
                  [&] { return place_text(runner, look.name, 3, y); });
      }
    }
  }
  return worst;
}

/// A sun below the horizon, in front of the viewer.
Worst sun_below(const HardWorld& world) {
  Worst worst;
  const Sea sea{.down = 5};
  HardFrame frame = sea.frame();
  frame.normal({0, 1, 0});
  Scene scene = sea.scene();
  for (const double height : {-1e-6, -0.02, -0.1}) {
    scene.sun->direction = glm::dvec3(0, height, -std::sqrt(1 - height * height));
    for (const Look& look : world.looks()) {
      for (const std::string& runner : world.runners()) {
        const HardPicture picture = world.run(runner, look, frame, scene);
        for (int y = 0; y < sea.size.height; ++y) {
          worst.expect(picture.aov(Aov::kHighlight, 24, y) == 0,
                       [&] { return place_text(runner, look.name, 24, y); });
        }
      }
    }
  }
  return worst;
}

}  // namespace

void add_normal_cases(HardCases& cases) {
  cases.push_back({"normals", "of lengths 1e-12 to 1e38", "distance from the unit normal",
                   "two roundings of each coordinate, of numbers up to 1", 2 * kRounding,
                   unnormalised});
  cases.push_back({"normals", "of length 0, NaN and inf", "normals that are not the water's up",
                   "such vectors have no direction", 0, without_direction});
  cases.push_back({"normals", "all around, every look", "values that are not finite",
                   "V.n may have any sign; valid input gives finite values", 0, sound});
  cases.push_back({"normals", "all around, every look, shares", "reflectance beyond 0 ... 1",
                   "8 roundings of a share near 1", 8 * kRounding, shares});
  cases.push_back(
      {"normals", "V.n = 0", "1 - reflectance", "8 roundings of 1", 8 * kRounding, edge_on});
  cases.push_back({"normals", "n.L below 0, every look", "glints",
                   "facets that face away from the sun have no glint", 0, sun_below});
}

}  // namespace limpid
