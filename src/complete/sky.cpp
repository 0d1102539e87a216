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
  resize(picture.window);
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

void Sky::make_even(const Frame& frame, const Rgb<double>& color, Executor& executor) {
  const Rect window = Picture(frame).window;
  resize(window);
  const double values[] = {color.r, color.g, color.b};
  each_row(executor, window, [&](int y) {
    for (std::size_t i = 0; i < 3; ++i) {
      std::fill_n(color_[i].view().row(y), window.width(), static_cast<float>(values[i]));
    }
  });
}

void Sky::resize(const Rect& window) {
  for (Plane& plane : color_) {
    if (!plane || plane.view().window != window) plane = Plane(window);
  }
}

bool shows_sky(const Frame& frame) {
  const Picture picture(frame);
  for (int y = picture.window.y0; y < picture.window.y1; ++y) {
    for (int x = picture.window.x0; x < picture.window.x1; ++x) {
      if (picture.is_sky(x, y)) return true;
    }
  }
  return false;
}

Rgb<double> guessed_sky(const Frame& frame) {
  constexpr int kMost = 256;
  constexpr double kOverGround = 2;
  const Picture picture(frame);
  const Rect& window = picture.window;
  const int step_x = std::max(1, window.width() / kMost);
  const int step_y = std::max(1, window.height() / kMost);
  double sum = 0;
  int count = 0;
  for (int y = window.y0; y < window.y1; y += step_y) {
    for (int x = window.x0; x < window.x1; x += step_x) {
      if (!(picture.depth.at(x, y) < 1e30f)) continue;
      double color = 0;
      for (const View<const float>& view : picture.color) color += view.at(x, y) / 3.0;
      if (!(color < HUGE_VAL)) continue;
      sum += std::sqrt(std::max(color, 0.0));
      ++count;
    }
  }
  const double root = count > 0 ? sum / count : 0;
  const double gray = kOverGround * root * root;
  return {gray, gray, gray};
}

}  // namespace limpid
