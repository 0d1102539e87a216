#include "complete/part_depths.h"

#include <algorithm>
#include <cmath>

#include "complete/row_heights.h"
#include "complete/rows.h"

namespace limpid {
namespace {

void move_row(const WaterView& c, const View<const float>& from, int y, const View<float>& to,
              bool may_be_dry) {
  const RowHeights centre(c, y, -c.off_centre), part(c, y);
  for (int x = from.window.x0; x < from.window.x1; ++x) {
    const float depth = from.at(x, y);
    const double height = centre.at(x, depth), there = part.depth_at(x, height);
    const bool reached = std::isfinite(depth) && there > 0 && there < 1e30;
    const float moved = reached ? static_cast<float>(there) : depth;
    to.at(x, y) = may_be_dry && height * c.eye_above > 0 ? std::min(moved, depth) : moved;
  }
}

}  // namespace

void PartDepths::move(Frame& frame, const WaterView& water, Executor& executor) {
  for (std::size_t i = 0; i < kPlanes.size(); ++i) {
    View<const float>& view = frame.planes[index_of(kPlanes[i])];
    if (!view) continue;
    if (!depths_[i] || depths_[i].view().window != view.window) depths_[i] = Plane(view.window);
    const View<float> to = depths_[i].view();
    const bool may_be_dry = kPlanes[i] == PlaneId::kDepth;
    each_row(executor, view.window, [&](int y) { move_row(water, view, y, to, may_be_dry); });
    view = to;
  }
}

}  // namespace limpid
