#include <algorithm>
#include <cmath>

#include "limpid/core/error.h"

#include "judge/hard/hard_case.h"
#include "judge/hard/sea.h"

namespace limpid {
namespace {

/// Parameters refuse offsets of a million pictures: their ranges end at 10.
Worst refused(const HardWorld& world) {
  Worst worst;
  const Sea sea{.size = {3, 3}};
  const HardFrame frame = sea.frame();
  const auto refuses = [&](Look look) {
    try {
      world.run(world.runners()[0], look, frame, sea.scene());
    } catch (const Error&) {
      return true;
    }
    return false;
  };
  const auto expect = [&](const Look& look, const char* what) {
    worst.expect(refuses(look), [&] { return std::string(what); });
  };
  for (const double size : {1e6, -1e6, double(INFINITY), double(NAN)}) {
    Look look = calm_look(world);
    look.of<Refraction>().strength = size;
    expect(look, "refraction");
    look = calm_look(world);
    look.of<PrismSplit>().strength = size;
    expect(look, "prism_split");
    look = calm_look(world);
    look.of<FresnelReflection>().strength = size;
    expect(look, "fresnel_reflection");
  }
  return worst;
}

/// The largest allowed offsets leave the picture from everywhere: lookups are clamped to its edge.
Worst clamped(const HardWorld& world) {
  Worst worst;
  const Sea sea{.size = {29, 17}};
  HardFrame frame = sea.frame();
  frame.normal({0.6, 0.8, 0});
  Look look = calm_look(world);
  look.of<Refraction>() = {.model = Refraction::Model::kNormalOffset,
                           .strength = 10,
                           .rejection = Refraction::Rejection::kNone,
                           .off_frame = Refraction::OffFrame::kClamp};
  look.of<DepthFog>().model = DepthFog::Model::kLinear;
  look.of<DepthFog>().alpha = 0;
  for (const double sign : {1.0, -1.0}) {
    look.of<Refraction>().strength = 10 * sign;
    const int edge = sign > 0 ? sea.size.width - 1 : 0;
    for (const std::string& runner : world.runners()) {
      const HardPicture picture = world.run(runner, look, frame, sea.scene());
      for (int y = 0; y < sea.size.height; ++y) {
        const double own = frame.frame().plane(PlaneId::kColorR).at(edge, y);
        for (int x = 0; x < sea.size.width; ++x) {
          const double through = 1 - picture.aov(Aov::kFresnel, x, y);
          const double off = picture.aov(Aov::kTransmitted, x, y) - through * own;
          worst.add(std::abs(off), [&] { return place_text(runner, look.name, x, y); });
        }
      }
    }
  }
  return worst;
}

/// A viewer who looks up sees water only at the sides: rays into deep water come from behind the
/// viewer, through the plane of the eye, where picture coordinates are infinite.
struct Behind {
  Sea sea{.size = {41, 23}, .depth = 1000, .down = -50, .fov = 120};
  HardFrame frame{sea.frame()};
  Scene scene = sea.scene();
};

Worst behind_the_eye(const HardWorld& world) {
  Worst worst;
  const Behind behind;
  worst.add_counts(unsound_values(world, behind.frame, behind.scene));
  Look look = world.look("physical");
  for (const int steps : {0, 1, 8, Refraction::kMarch}) {
    for (const auto off_frame : {Refraction::OffFrame::kClamp, Refraction::OffFrame::kShorten,
                                 Refraction::OffFrame::kFog, Refraction::OffFrame::kContinue}) {
      look.of<Refraction>().steps = steps;
      look.of<Refraction>().off_frame = off_frame;
      for (const std::string& runner : world.runners()) {
        const HardPicture picture = world.run(runner, look, behind.frame, behind.scene);
        for (int y = 0; y < behind.sea.size.height; ++y) {
          worst.expect(std::isfinite(picture.color(0, 20, y)),
                       [&] { return place_text(runner, look.name, 20, y); });
        }
      }
    }
  }
  return worst;
}

/// Checks the case itself: the largest shift, in pictures, must exceed a million.
Worst reaches_far(const HardWorld& world) {
  Worst worst;
  const Behind behind;
  Look look = calm_look(world);
  look.of<Refraction>() = {.rejection = Refraction::Rejection::kNone,
                           .steps = 0,
                           .off_frame = Refraction::OffFrame::kClamp};
  for (const std::string& runner : world.runners()) {
    const HardPicture picture = world.run(runner, look, behind.frame, behind.scene);
    double most = 0;
    for (int y = 0; y < behind.sea.size.height; ++y) {
      for (int x = 0; x < behind.sea.size.width; ++x) {
        if (picture.wet(x, y)) most = std::max(most, std::abs(picture.aov(Aov::kStmapG, x, y, 1)));
      }
    }
    worst.add(1e6 / most, [&] { return runner; });
  }
  return worst;
}

/// Waves a million periods away, and in tiles a millionth of a pixel wide.
Worst tiles(const HardWorld& world) {
  Worst worst;
  for (const double height : {2.0, 2e6}) {
    const Sea sea{.size = {33, 17}, .height = height, .depth = 0.5 * height};
    const HardFrame frame = sea.frame();
    for (Look look : world.looks()) {
      for (const double tile : {1e-6, 1.0}) {
        look.of<WaveNormals>().tile_size = tile;
        for (const std::string& runner : world.runners()) {
          const HardPicture picture = world.run(runner, look, frame, sea.scene());
          for (int y = 0; y < sea.size.height; ++y) {
            for (int x = 0; x < sea.size.width; ++x) {
              const double length =
                  std::hypot(picture.aov(Aov::kNormal, x, y, 0), picture.aov(Aov::kNormal, x, y, 1),
                             picture.aov(Aov::kNormal, x, y, 2));
              worst.add(std::abs(length - 1), [&] { return place_text(runner, look.name, x, y); });
            }
          }
        }
      }
    }
  }
  return worst;
}

}  // namespace

void add_lookup_cases(HardCases& cases) {
  cases.push_back({"lookups", "strengths of 1e6, inf, NaN", "values that are not refused",
                   "no parameter reaches beyond 10 pictures", 0, refused});
  cases.push_back({"lookups", "10 pictures off", "difference from the texel at the edge",
                   "clamped there; 4 roundings of colors up to 0.8", 0.8 * 4 * kRounding, clamped});
  cases.push_back({"lookups", "rays through the eye's plane",
                   "1e6 pictures over the farthest shift", "the shift is w / 1e-6 there", 1,
                   reaches_far});
  cases.push_back({"lookups", "rays through the eye's plane, every look",
                   "values that are not finite", "valid input gives finite values", 0,
                   behind_the_eye});
  cases.push_back({"lookups", "1e6 tiles and more away, every look", "error of the normals' length",
                   "6 roundings", 6 * kRounding, tiles});
}

}  // namespace limpid
