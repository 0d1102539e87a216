#include "job/deep_output.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "limpid/files/exr/deep_writer.h"
#include "limpid/op/pass.h"

namespace limpid {
namespace {

using Fog = DepthFog::Params;

/// How long the way through water without end is made: there it is as dense as it gets. Nothing
/// where it takes no light.
std::optional<double> endless_way(const Fog& fog) {
  if (fog.model == DepthFog::Model::kLinear) {
    if (fog.density == 0) return std::nullopt;
    return (1 + std::max(fog.offset, 0.0)) / fog.density;
  }
  const Rgb<double> extinction = DepthFog::extinction(fog);
  return deep_reach({extinction.r, extinction.g, extinction.b});
}

/// The front and the back of one pixel.
struct Extent {
  double front, back;
};

}  // namespace

WaterExtent water_extent(const Plan& plan, const Frame& frame, const Scene& scene,
                         const Target& target) {
  const Fog& fog = plan.look.of<DepthFog>();
  const std::optional<double> endless = endless_way(fog);
  const Pass pass(scene, frame, plan.look.water.ior, plan.made, plan.swell());
  const View<float>&path = target.of(Aov::kPath)[0], &surface = target.of(Aov::kSurfaceDepth)[0];

  const auto extent_at = [&](const RowRays<double>& rays, int x, int y) -> Extent {
    const double pixel_x = x - pass.corner.x + 0.5;
    const bool in_water = begins_in_water(pass, rays, pixel_x) > 0;
    const double front = in_water ? pass.near : surface.at(x, y);
    if (std::isinf(front)) return {front, front};
    // In water the operator measures from the eye and along the ray, whatever its `distance`.
    const bool along_axis = !in_water && fog.distance == DepthFog::Distance::kEye;
    const Vec3<double> ray = rays.ray_at(pixel_x);
    const double way_per_depth = along_axis ? 1 : length(ray);
    const double back = (in_water ? 0 : front) + path.at(x, y) / way_per_depth;
    if (back < kInfiniteDepth) return {front, std::max(front, back)};
    if (!endless) return {front, front};
    const double end = front + *endless / way_per_depth;
    return {front, std::max(front, std::min<double>(end, kLargestDepth))};
  };

  const Rect work = frame.work();
  WaterExtent extent{Plane(work), Plane(work), {Plane(work), Plane(work), Plane(work)}};
  for (int y = work.y0; y < work.y1; ++y) {
    const RowRays<double> rays(pass, y - pass.corner.y + 0.5);
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
