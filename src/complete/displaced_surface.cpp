#include "complete/displaced_surface.h"

#include "limpid/core/simd.h"

#include "complete/rows.h"
#include "complete/surface_target.h"

namespace limpid {

// One for each instruction set that the build names, defined in surface_target.cpp.
#define LIMPID_TARGET(name, highway) extern const SurfaceTarget kSurface_##name;
#include "core/targets.inc"
#undef LIMPID_TARGET

namespace {

constexpr const SurfaceTarget* kTargets[] = {
#define LIMPID_TARGET(name, highway) &kSurface_##name,
#include "core/targets.inc"
#undef LIMPID_TARGET
};

void exact_row(const WaterView& c, const RaisedWater<double>& water, int y,
               const View<float>& depth) {
  const RowRays<double> rays(c, y - c.corner.y + 0.5);
  for (int x = depth.window.x0; x < depth.window.x1; ++x) {
    const RaisedRay<double, double> ray(c, water, rays, x - c.corner.x + 0.5);
    depth.at(x, y) = static_cast<float>(ray.first_meeting());
  }
}

}  // namespace

const SurfaceTarget& surface_target(const std::string& simd) { return *kTargets[simd_index(simd)]; }

void DisplacedSurface::make(const Frame& frame, const WaterView& view, Executor& executor,
                            const std::string* simd) {
  const Rect window = frame.plane(PlaneId::kDepth).window;
  if (!depth_ || depth_.view().window != window) depth_ = Plane(window);
  const View<float> to = depth_.view();
  if (!simd) {
    exact_water_.make(view);
    each_row(executor, window, [&](int y) { exact_row(view, exact_water_, y, to); });
    return;
  }
  const SurfaceTarget& target = surface_target(*simd);
  water_.make(view);
  each_row(executor, window, [&](int y) { target.row(view, water_, y, to); });
}

}  // namespace limpid
