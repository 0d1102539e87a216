#include "limpid/complete/sky.h"

#include <algorithm>
#include <cmath>

#include "complete/rows.h"

namespace limpid {
namespace {

using Texel = std::array<float, 4>;

Rect half_of(const Rect& window) {
  return {0, 0, (window.width() + 1) / 2, (window.height() + 1) / 2};
}

/// Bilinear between the centres of a level that is half as large.
template <class At>
Texel between(At&& at, const Rect& window, int x, int y) {
  const int x0 = (x - 1) >> 1, y0 = (y - 1) >> 1;
  const float u = x % 2 == 0 ? 0.75f : 0.25f, v = y % 2 == 0 ? 0.75f : 0.25f;
  Texel sum{};
  float weights = 0;
  for (int k = 0; k < 4; ++k) {
    const int column = std::clamp(x0 + (k & 1), 0, window.width() - 1);
    const int row = std::clamp(y0 + (k >> 1), 0, window.height() - 1);
    const Texel& texel = at(column, row);
    const float weight = (k & 1 ? u : 1 - u) * (k >> 1 ? v : 1 - v) * texel[3];
    for (std::size_t i = 0; i < 3; ++i) sum[i] += weight * texel[i];
    weights += weight;
  }
  if (weights > 0) {
    for (std::size_t i = 0; i < 3; ++i) sum[i] /= weights;
    sum[3] = 1;
  }
  return sum;
}

struct Picture {
  std::array<View<const float>, 3> color;
  View<const float> alpha, depth;
  Rect window;  ///< where color and depth are

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

/// The mean of four texels of a picture of that size, by their shares of sky: those at (2 x, 2 y)
/// and after.
template <class At>
Texel mean_of_quad(Size size, int x, int y, At&& at) {
  Texel sum{};
  for (int k = 0; k < 4; ++k) {
    const int column = 2 * x + (k & 1), row = 2 * y + (k >> 1);
    if (column >= size.width || row >= size.height) continue;
    const Texel texel = at(column, row);
    for (std::size_t i = 0; i < 3; ++i) sum[i] += texel[3] * texel[i];
    sum[3] += texel[3];
  }
  if (!(sum[3] > 0)) return {};
  return {sum[0] / sum[3], sum[1] / sum[3], sum[2] / sum[3], std::min(sum[3], 1.0f)};
}

}  // namespace

/// What a level lacks, from the coarser one.
void Sky::fill(Level& finer, Level& coarser, Executor& executor) const {
  const auto at = [&](int x, int y) -> const Texel& { return coarser.at(x, y); };
  each_row(executor, finer.window, [&](int y) {
    for (int x = 0; x < finer.window.width(); ++x) {
      Texel& texel = finer.at(x, y);
      if (texel[3] > 0) continue;
      texel = between(at, coarser.window, x, y);
    }
  });
}

bool Sky::make(const Frame& frame, Executor& executor) {
  const Picture picture(frame);
  std::size_t count = 1;
  for (Rect w = half_of(picture.window); w.width() > 1 || w.height() > 1; w = half_of(w)) ++count;
  levels_.resize(count);
  const auto reduce = [&](Level& level, const Rect& finer, auto&& at) {
    level.window = half_of(finer);
    level.texels.resize(static_cast<std::size_t>(level.window.area()));
    each_row(executor, level.window, [&](int y) {
      for (int x = 0; x < level.window.width(); ++x) {
        level.at(x, y) = mean_of_quad(finer.size(), x, y, at);
      }
    });
  };
  reduce(levels_[0], picture.window, [&](int x, int y) {
    return picture.sky_at(picture.window.x0 + x, picture.window.y0 + y);
  });
  for (std::size_t i = 1; i < count; ++i) {
    Level& finer = levels_[i - 1];
    reduce(levels_[i], finer.window, [&](int x, int y) { return finer.at(x, y); });
  }
  if (!(levels_.back().at(0, 0)[3] > 0)) return false;
  for (std::size_t i = count - 1; i > 0; --i) fill(levels_[i - 1], levels_[i], executor);
  for (Plane& plane : color_) {
    if (!plane || plane.view().window != picture.window) plane = Plane(picture.window);
  }
  Level& half = levels_[0];
  const auto at = [&](int x, int y) -> const Texel& { return half.at(x, y); };
  each_row(executor, picture.window, [&](int y) {
    for (int x = picture.window.x0; x < picture.window.x1; ++x) {
      const bool own = picture.is_sky(x, y);
      const Texel drawn_on =
          own ? Texel{} : between(at, half.window, x - picture.window.x0, y - picture.window.y0);
      for (std::size_t i = 0; i < 3; ++i) {
        color_[i].view().at(x, y) = own ? picture.color[i].at(x, y) : drawn_on[i];
      }
    }
  });
  return true;
}

}  // namespace limpid
