#pragma once
#include <algorithm>
#include <cmath>

#include "op/pass.h"
#include "support.h"

namespace limpid::test {

/// A post upright before calm water on a level bottom, seen from above and blurred to the sides:
/// its share of a pixel rises from 0 to 1 over `blur` pixels round each of its sides.
struct Post {
  enum class Depth {
    kMiddle,    ///< the mean depth of the surfaces in the blur
    kOneSample  ///< the depth of one of the surfaces in the blur, by chance
  };
  static constexpr Size kSize{128, 96};
  static constexpr double kPostDepth = 1.5, kMiddle = 64.2;
  double width = 40, blur = 0;
  Depth kind = Depth::kMiddle;
  float texture = 0;  ///< amplitude on both sides, as a share of their colors
  float rise = 0;     ///< growth of the bottom's light to the right, over the picture's width
  Rgb<float> dark{0.1f, 0.06f, 0.03f}, light{0.5f, 0.6f, 0.4f};
  Scene scene = simple_scene(kSize);
  Buffers buffers{rect_of(kSize)};

  Post& make() {
    scene.sun.reset();
    for (int c = 0; c < 3; ++c) {
      buffers.set(plane_after(PlaneId::kColorR, c), [&](int x, int y) {
        const auto share = static_cast<float>(cover(x));
        return share * channel(front(x, y), c) + (1 - share) * channel(behind(x, y), c);
      });
    }
    buffers.set(PlaneId::kDepth, [&](int x, int y) {
      const double by = kind == Depth::kMiddle ? 0.5 : noise(x, y, 70);
      return cover(x) > by ? static_cast<float>(kPostDepth) : bottom_depth(y);
    });
    return *this;
  }
  double cover(int x) const {
    const double inside = width / 2 - std::abs(x + 0.5 - kMiddle);
    return std::clamp(inside / std::max(blur, 1e-6) + 0.5, 0.0, 1.0);
  }
  Rgb<float> front(int x, int y) const { return (1 + texture * (noise(x, y, 71) - 0.5f)) * dark; }
  Rgb<float> behind(int x, int y) const {
    const float lit = 1 + rise * (static_cast<float>(x) / kSize.width - 0.5f);
    return lit * (1 + texture * (noise(x / 3, y / 3, 72) - 0.5f)) * light;
  }
  float bottom_depth(int y) const {
    const glm::dvec3 ray = rays_of(*scene.camera, {kSize.width, kSize.height}).ray_at(64, y + 0.5);
    return static_cast<float>(-4 / ray.y);
  }
  Pass pass() const { return Pass(scene, buffers.frame, 1.333, kWholeState); }

  static float channel(const Rgb<float>& c, int i) { return i == 0 ? c.r : i == 1 ? c.g : c.b; }
};

}  // namespace limpid::test
