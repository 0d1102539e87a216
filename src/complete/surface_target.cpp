// Compiled once for each instruction set, under the same rules as run/lanes_target.cpp.
#include "complete/surface_target.h"

#include "core/lanes.h"
#include "core/target_name.h"

namespace limpid::HWY_NAMESPACE {
namespace {

void row(const WaterView& view, const RaisedWater<float>& water, int y, const View<float>& depth) {
  const RowRays<Lane> rays(view, y - view.corner.y + 0.5);
  const Rect& window = depth.window;
  float* to = depth.data + std::ptrdiff_t{y - window.y0} * depth.y_stride;
  for (int x = window.x0; x < window.x1; x += kLanes) {
    const Lane at = Lane(hn::ConvertTo(kD, count_from(x))) + Lane(0.5 - view.corner.x);
    const Lane met = RaisedRay<Lane, float>(view, water, rays, at).first_meeting();
    if (window.x1 - x >= kLanes) {
      hn::StoreU(met.v, kD, to + (x - window.x0));
      continue;
    }
    alignas(64) float lanes[kLanes];
    hn::Store(met.v, kD, lanes);
    for (int i = 0; i < window.x1 - x; ++i) to[x - window.x0 + i] = lanes[i];
  }
}

}  // namespace
}  // namespace limpid::HWY_NAMESPACE

namespace limpid {

extern const SurfaceTarget LIMPID_OF_TARGET(kSurface_);
const SurfaceTarget LIMPID_OF_TARGET(kSurface_) = {HWY_NAMESPACE::row};

}  // namespace limpid
