#include "complete/sky.h"

#include <algorithm>
#include <cmath>

#include "complete/rows.h"

namespace limpid {
namespace {

using Texel = PullPush<3>::Texel;

struct Picture {
  std::array<View<const float>, 3> color;
  View<const float> alpha, depth;
  Rect window;  ///< where both color and depth are

  explicit Picture(const Frame& frame)
      : color{frame.plane(PlaneId::kColorR), frame.plane(PlaneId::kColorG),
              frame.plane(PlaneId::kColorB)},
        alpha(frame.plane(PlaneId::kColorA)),
        depth(frame.plane(PlaneId::kDepth)),
        window(intersection(color[0].window, depth.window)) {
    for (const View<const float>& view : color) window = intersection(window, view.window);
    if (alpha) window = intersection(window, alpha.window);
  }

  bool is_sky(int x, int y) const {
    return !(depth.at(x, y) < 1e30f) && !(alpha && alpha.at(x, y) < 0.5f);
  }
  Texel sky_at(int x, int y) const {
    if (!is_sky(x, y)) return {};
    return {color[0].at(x, y), color[1].at(x, y), color[2].at(x, y), 1};
  }
};

}  // namespace

bool Sky::make(const Frame& frame, Executor& executor) {
  const Picture picture(frame);
  sky_.begin(picture.window.size(), executor, [&](int x, int y) {
    return picture.sky_at(picture.window.x0 + x, picture.window.y0 + y);
  });
  if (!sky_.draw_on(executor)) return false;
  for (Plane& plane : color_) {
    if (!plane || plane.view().window != picture.window) plane = Plane(picture.window);
  }
  const auto& half = sky_.finest();
  each_row(executor, picture.window, [&](int y) {
    for (int x = picture.window.x0; x < picture.window.x1; ++x) {
      const bool own = picture.is_sky(x, y);
      const Texel drawn_on =
          own ? Texel{} : half.between(x - picture.window.x0, y - picture.window.y0);
      for (std::size_t i = 0; i < 3; ++i) {
        color_[i].view().at(x, y) = own ? picture.color[i].at(x, y) : drawn_on[i];
      }
    }
  });
  return true;
}

}  // namespace limpid
