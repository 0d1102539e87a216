#include <cmath>
#include <limits>

#include "judge/hard/hard_case.h"
#include "judge/hard/sea.h"

namespace limpid {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

/// A beach that falls by 0.1 away from the viewer and enters the water at a distance of 4 units.
struct Beach {
  Sea sea{.size = {61, 40}};
  HardFrame frame{sea.frame()};

  Beach() {
    frame.set(PlaneId::kDepth, [this](int x, int y) { return depth(x, y); });
    for (int c = 0; c < 3; ++c) {  // gentle waves
      frame.set(plane_after(PlaneId::kSurfaceNormalX, c), [c](int x, int y) {
        const double normal[] = {0.1 * std::sin(0.7 * x), 1, 0.1 * std::cos(0.5 * y)};
        return normal[c] / std::hypot(normal[0], normal[1], normal[2]);
      });
    }
  }
  long double depth(int x, int y) const {
    const Sea::Pixel p = sea.at(x, y);
    const long double slope = 0.1L, shore = 4;
    const long double fall = p.fall - slope * p.forward;
    return fall > 0 ? (sea.height - slope * shore) / fall : kInf;
  }
  /// Each depth moved up or down by 1 ulp, or unchanged.
  HardFrame shaken() const {
    Beach other;
    const View<float> plane = other.frame.plane(PlaneId::kDepth);
    for (int y = 0; y < sea.size.height; ++y) {
      for (int x = 0; x < sea.size.width; ++x) {
        float& z = plane.at(x, y);
        const float kind = hard_noise(x, y, 80);
        if (kind < 1 / 3.0f) z = std::nextafter(z, 0.0f);
        if (kind > 2 / 3.0f) z = std::nextafter(z, kInf);
      }
    }
    return std::move(other.frame);
  }
};

/// fn(place, before, after, x, y) for each pixel, look and runner.
template <class Fn>
void for_each_shaken(const HardWorld& world, Fn&& fn) {
  const Beach beach;
  const HardFrame shaken = beach.shaken();
  const Scene scene = beach.sea.scene();
  for (const Look& look : world.looks()) {
    for (const std::string& runner : world.runners()) {
      const HardPicture before = world.run(runner, look, beach.frame, scene);
      const HardPicture after = world.run(runner, look, shaken, scene);
      for (int y = 0; y < beach.sea.size.height; ++y) {
        for (int x = 0; x < beach.sea.size.width; ++x) {
          fn(place_text(runner, look.name, x, y), before, after, x, y);
        }
      }
    }
  }
}

Worst flicker(const HardWorld& world) {
  Worst worst;
  int rejected = 0;
  for_each_shaken(world, [&](const std::string& where, const HardPicture& before,
                             const HardPicture& after, int x, int y) {
    if (!before.wet(x, y) || !after.wet(x, y)) return;
    for (int c = 0; c < 3; ++c) {
      worst.add(std::abs(before.color(c, x, y) - after.color(c, x, y)), [&] { return where; });
    }
    rejected += before.aov(Aov::kConfidence, x, y) < 1;
  });
  if (rejected == 0) worst.add(HUGE_VAL, [] { return std::string("nothing is rejected"); });
  return worst;
}

Worst waterline(const HardWorld& world) {
  Worst worst;
  const Beach beach;
  for_each_shaken(world, [&](const std::string& where, const HardPicture& before,
                             const HardPicture& after, int x, int y) {
    const Sea::Pixel p = beach.sea.at(x, y);
    const long double under = beach.depth(x, y) - p.surface;
    if (!p.water || std::abs(under) < 4 * kRounding * p.surface) return;
    worst.expect(before.wet(x, y) == (under > 0) && after.wet(x, y) == (under > 0),
                 [&] { return where; });
  });
  return worst;
}

/// In stripes, beside water of depth 1.
Worst coincident(const HardWorld& world) {
  Worst worst;
  const Sea sea;
  HardFrame frame = sea.frame();
  const auto coincides = [](int x) { return x / 3 % 2 == 0; };
  frame.set(PlaneId::kDepth, [&](int x, int y) {
    return coincides(x) ? sea.at(x, y).surface : sea.at(x, y).bottom;
  });
  for (const Look& look : world.looks()) {
    for (const std::string& runner : world.runners()) {
      const HardPicture picture = world.run(runner, look, frame, sea.scene());
      for (int c = 0; c < 3; ++c) {
        const View<const float>& dry = frame.frame().plane(plane_after(PlaneId::kColorR, c));
        for (int y = 0; y < sea.size.height; ++y) {
          for (int x = 0; x < sea.size.width; ++x) {
            const bool is_dry = picture.color(c, x, y) == dry.at(x, y);
            worst.expect(is_dry == coincides(x),
                         [&] { return place_text(runner, look.name, x, y); });
          }
        }
      }
    }
  }
  return worst;
}

/// Without a plane of the surface, rounding decides which pixels are wet; all their paths must be
/// nearly 0.
Worst nearly_coincident(const HardWorld& world) {
  Worst worst;
  const Sea sea{.depth = 0};
  HardFrame above = sea.frame(), plane = sea.frame(false);
  const View<float> depth = above.plane(PlaneId::kDepth);
  for (int y = 0; y < sea.size.height; ++y) {
    for (int x = 0; x < sea.size.width; ++x) {
      depth.at(x, y) = std::nextafter(depth.at(x, y), kInf);
    }
  }
  for (const HardFrame* frame : {&above, &plane}) {
    for (const Look& look : world.looks()) {
      for (const std::string& runner : world.runners()) {
        const HardPicture picture = world.run(runner, look, *frame, sea.scene());
        for (int y = 0; y < sea.size.height; ++y) {
          for (int x = 0; x < sea.size.width; ++x) {
            const Sea::Pixel p = sea.at(x, y);
            // In any measure of the path, straight or refracted.
            const long double longest = p.length * p.surface * kRounding * (2 + 7 + 30);
            worst.add(double(picture.aov(Aov::kPath, x, y) / longest),
                      [&] { return place_text(runner, look.name, x, y); });
          }
        }
      }
    }
  }
  return worst;
}

}  // namespace

void add_shore_cases(HardCases& cases) {
  cases.push_back({"shore", "depth shaken by 1 ulp, every look", "change of a pixel (white = 1)",
                   "30 roundings of heights of 2 and 8 of depths make 68 of the path; losses of "
                   "0.6 and a slope of 0.6 over it, and 60 of the light",
                   (68 * 1.2 + 60) * kRounding, flicker});
  cases.push_back({"shore", "waterline shaken by 1 ulp, every look",
                   "pixels on the wrong side of the waterline",
                   "only where the bottom is within 2 ulp of the surface", 0, waterline});
  cases.push_back({"shore", "surface and floor coincident, every look",
                   "values that differ from the dry picture, and wet values that do not",
                   "a pixel is wet where the surface is in front, and nowhere else", 0,
                   coincident});
  cases.push_back({"shore", "floor 1 ulp under the surface, every look", "path over its bound",
                   "an ulp, the 7 roundings of a calm surface and 30 of heights", 1,
                   nearly_coincident});
}

}  // namespace limpid
