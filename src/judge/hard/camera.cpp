#include <cmath>

#include "judge/hard/hard_case.h"
#include "judge/hard/sea.h"

namespace limpid {
namespace {

constexpr Size kSize{40, 23};  // an odd number of rows: the middle row is the horizon

/// A level camera, `height` over the water; a wall stands at a distance of 3.
struct Waterline {
  Sea sea;
  HardFrame frame;
  Scene scene;

  explicit Waterline(double height)
      : sea{.size = kSize, .height = height, .down = 0, .far = 100},
        frame(noisy_frame(kSize)),
        scene(sea.scene()) {
    frame.fill(PlaneId::kDepth, 3);
    for (const PlaneId id : {PlaneId::kSurfaceDepth, PlaneId::kBelowDepth, PlaneId::kBelowR,
                             PlaneId::kBelowG, PlaneId::kBelowB}) {
      frame.remove(id);
    }
  }
};

/// A pixel begins in the water if its ray begins there, at the near plane: for an eye in the
/// surface exactly the lower half of the picture. The middle row lies in the surface, and is dry.
Worst eye_in_the_surface(const HardWorld& world) {
  Worst worst;
  const Waterline line(0);
  const Look look = calm_look(world);
  for (const std::string& runner : world.runners()) {
    const HardPicture picture = world.run(runner, look, line.frame, line.scene);
    for (int y = 0; y < kSize.height; ++y) {
      for (int x = 0; x < kSize.width; ++x) {
        const bool in_water = 2 * y + 1 > kSize.height;
        const double distance = in_water ? 3 * double(line.sea.at(x, y).length) : 0;
        const bool right =
            std::abs(picture.aov(Aov::kPath, x, y) - distance) <= 4 * kRounding * distance;
        worst.expect(right, [&] { return place_text(runner, look.name, x, y); });
      }
    }
  }
  return worst;
}

/// For the same picture, and for tiny heights.
Worst at_the_surface(const HardWorld& world) {
  Worst worst;
  for (const double height : {0.0, 1e-30, -1e-30, 1e-7, -1e-7, 1e-3, -1e-3, 0.05, -0.05}) {
    const Waterline line(height);
    worst.add_counts(unsound_values(world, line.frame, line.scene));
  }
  return worst;
}

Worst below_the_surface(const HardWorld& world) {
  Worst worst;
  for (const double height : {-0.2, -10.0, -1e4}) {
    Waterline line(height);
    worst.add_counts(unsound_values(world, line.frame, line.scene));
    line.frame.fill(PlaneId::kDepth, HUGE_VAL);  // and no object
    worst.add_counts(unsound_values(world, line.frame, line.scene));
  }
  return worst;
}

/// From 1 below, looking up: beyond the critical angle the surface is a mirror.
Worst total_reflection(const HardWorld& world) {
  Worst worst;
  Sea sea{.size = {64, 37}, .height = -1, .down = -45, .fov = 70, .far = 100};
  HardFrame frame = sea.frame(false);
  frame.fill(PlaneId::kDepth, HUGE_VAL);
  const Look look = calm_look(world);
  const long double critical = std::sqrt(1 - 1 / (look.water.ior * (long double)(look.water.ior)));
  for (const std::string& runner : world.runners()) {
    const HardPicture picture = world.run(runner, look, frame, sea.scene());
    for (int y = 0; y < sea.size.height; ++y) {
      for (int x = 0; x < sea.size.width; ++x) {
        const long double cosine = -sea.at(x, y).cosine;  // seen from below
        // Within 6 roundings of the cosine and 4 of the index, either side is right.
        if (cosine <= 0 || std::abs(cosine - critical) < 16 * kRounding) continue;
        const bool total = picture.aov(Aov::kFresnel, x, y) == 1;
        worst.expect(total == (cosine < critical),
                     [&] { return place_text(runner, look.name, x, y); });
      }
    }
  }
  return worst;
}

Worst far_above(const HardWorld& world) {
  const Sea sea{.size = kSize, .height = 1e4, .depth = 20, .down = 40, .far = 1e9};
  return unsound_values(world, sea.frame(), sea.scene());
}

}  // namespace

void add_camera_cases(HardCases& cases) {
  const Sea high{.height = 1e4, .depth = 20, .down = 40, .near = 1, .far = 1e9};
  add_sea_cases(cases, "camera", "10 km up", high);
  Sea down = high;
  down.down = 90;
  add_sea_cases(cases, "camera", "10 km up, straight down", down);
  const char* sound = "values that are not finite, all looks";
  cases.push_back(
      {"camera", "10 km up, every look", sound, "valid input gives finite values", 0, far_above});
  cases.push_back(
      {"camera", "eye in the surface", "pixels on the wrong side, or with another path",
       "below the horizon the path is in the water, to 4 roundings; above there is none", 0,
       eye_in_the_surface});
  cases.push_back({"camera", "eye at the surface, every look", sound,
                   "valid input gives finite values", 0, at_the_surface});
  cases.push_back({"camera", "eye below the surface, every look", sound,
                   "valid input gives finite values", 0, below_the_surface});
  cases.push_back({"camera", "total reflection from below", "wrongly classified pixels",
                   "total beyond arcsin(1 / n), and only there", 0, total_reflection});
}

}  // namespace limpid
