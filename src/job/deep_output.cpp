#include "job/deep_output.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "limpid/files/exr/deep_writer.h"

#include "op/pass.h"
#include "plan/operator_table.h"
#include "plan/pass_of.h"

namespace limpid {
namespace {

/// From the last operator of the chain that has a path length.
PathMeasure path_measure_of(const Look& look) {
  PathMeasure measure;
  for (const OperatorEntry& entry : operator_table())
    measure = entry.path_measure(look).value_or(measure);
  return measure;
}

/// The finite length that replaces an endless path: there the water is as dense as it gets. Nothing
/// if the water does not dim light.
std::optional<double> infinite_path(const PathMeasure& measure) {
  const Rgb<double>& e = measure.extinction;
  return measure.ends ? measure.ends : deep_reach({e.r, e.g, e.b});
}

/// Front and back of the water in one pixel.
struct Extent {
  double front, back;
};

}  // namespace

WaterExtent water_extent(const Plan& plan, const Frame& frame, const Scene& scene,
                         const Target& target) {
  const PathMeasure measure = path_measure_of(plan.look);
  const std::optional<double> endless = infinite_path(measure);
  const WaterView view(scene, frame.display, swell_of(frame, swell_of(plan)));
  const View<float>&path = target.of(Aov::kPath)[0], &surface = target.of(Aov::kSurfaceDepth)[0];

  const auto extent_at = [&](const RowRays<double>& rays, int x, int y) -> Extent {
    const double pixel_x = x - view.corner.x + 0.5;
    const bool in_water = begins_in_water(view, rays, pixel_x) > 0;
    const double front = in_water ? view.near : surface.at(x, y);
    if (std::isinf(front)) return {front, front};
    const bool along_axis = !in_water && measure.along_axis;
    const Vec3<double> ray = rays.ray_at(pixel_x);
    const double length_per_depth = along_axis ? 1 : length(ray);
    const double back = (in_water ? 0 : front) + path.at(x, y) / length_per_depth;
    if (back < kInfiniteDepth) return {front, std::max(front, back)};
    if (!endless) return {front, front};
    const double end = front + *endless / length_per_depth;
    return {front, std::max(front, std::min<double>(end, kLargestDepth))};
  };

  const Rect work = frame.work();
  WaterExtent extent{Plane(work), Plane(work), {Plane(work), Plane(work), Plane(work)}};
  for (int y = work.y0; y < work.y1; ++y) {
    const RowRays<double> rays(view, y - view.corner.y + 0.5);
    for (int x = work.x0; x < work.x1; ++x) {
      const Extent at = extent_at(rays, x, y);
      extent.front.view().at(x, y) = static_cast<float>(at.front);
      extent.back.view().at(x, y) = static_cast<float>(at.back);
      for (std::size_t c = 0; c < 3; ++c) {
        extent.in_scatter[c].view().at(x, y) =
            target.of(Aov::kInScatter)[c].at(x, y) / target.uncovered.at(x, y);
      }
    }
  }
  return extent;
}

}  // namespace limpid
