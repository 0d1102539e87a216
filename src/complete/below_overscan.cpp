#include "complete/below_overscan.h"

#include <limits>

#include "complete/row_heights.h"
#include "complete/rows.h"

namespace limpid {
namespace {

constexpr std::array kDry{PlaneId::kColorR, PlaneId::kColorG, PlaneId::kColorB, PlaneId::kDepth};
constexpr std::array kBelow{PlaneId::kBelowR, PlaneId::kBelowG, PlaneId::kBelowB,
                            PlaneId::kBelowDepth};
constexpr std::size_t kDepth = 3;

using Layer = std::array<View<const float>, 4>;

Layer layer_of(const Frame& frame, const std::array<PlaneId, 4>& planes) {
  return {frame.plane(planes[0]), frame.plane(planes[1]), frame.plane(planes[2]),
          frame.plane(planes[3])};
}

Rect window_of(const Layer& layer) {
  Rect window = layer[0].window;
  for (const View<const float>& view : layer) window = intersection(window, view.window);
  return window;
}

}  // namespace

void BelowOverscan::widen(Frame& frame, const Pass& pass, Executor& executor) {
  const Layer dry = layer_of(frame, kDry), below = layer_of(frame, kBelow);
  const Rect wide = window_of(dry), own = window_of(below);
  if (own.contains(wide) || !wide.contains(own)) return;
  std::array<View<float>, 4> to;
  for (std::size_t i = 0; i < 4; ++i) {
    if (!planes_[i] || planes_[i].view().window != wide) planes_[i] = Plane(wide);
    to[i] = planes_[i].view();
    frame.planes[index_of(kBelow[i])] = to[i];
  }
  each_row(executor, wide, [&](int y) {
    const RowHeights heights(pass, y);
    for (int x = wide.x0; x < wide.x1; ++x) {
      const bool is_own = own.contains({x, y, x + 1, y + 1});
      const float depth = dry[kDepth].at(x, y);
      const bool wet = depth < 1e30f && heights.at(x, depth) * pass.eye_above < 0;
      for (std::size_t i = 0; i < 4; ++i) {
        const float empty = i == kDepth ? std::numeric_limits<float>::infinity() : 0;
        to[i].at(x, y) = is_own ? below[i].at(x, y) : wet ? dry[i].at(x, y) : empty;
      }
    }
  });
}

}  // namespace limpid
