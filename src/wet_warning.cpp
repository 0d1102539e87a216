#include "wet_warning.h"

#include "limpid/op/context.h"

namespace limpid {
namespace {

/// What there is among the pixels that were looked at.
struct Found {
  bool wet = false, dry = false, in_water = false;
  bool both() const { return wet && dry; }
};

/// Every `step`-th pixel of every `step`-th row, until both kinds are found.
Found look_at(const Frame& frame, const Context& context, int step) {
  Found found;
  const Rect work = frame.work();
  const View<const float>& depth = frame.plane(PlaneId::kDepth);
  const View<const float>& surface = frame.plane(PlaneId::kSurfaceDepth);
  for (int y = work.y0; y < work.y1 && !found.both(); y += step) {
    const RowRays<double> rays(context, y - context.corner.y + 0.5);
    for (int x = work.x0; x < work.x1 && !found.both(); x += step) {
      const double pixel_x = x - context.corner.x + 0.5;
      const double water = surface ? surface.at(x, y) : rays.calm_depth(pixel_x);
      const bool in_water = begins_in_water(context, rays, pixel_x) > 0;
      const bool wet = in_water || water < depth.at(x, y);
      found.wet |= wet;
      found.dry |= !wet;
      found.in_water |= in_water;
    }
  }
  return found;
}

}  // namespace

void warn_of_wet(const Frame& frame, const Scene& scene, std::vector<std::string>& warnings) {
  const double any_index = 1;
  const Context context(scene, frame, any_index, {});
  constexpr int kCoarse = 16;
  if (look_at(frame, context, kCoarse).both()) return;
  const Found found = look_at(frame, context, 1);
  const std::string expected =
      "; expected another height or direction of the water, another camera or kind of depth, if "
      "that is not meant";
  if (!found.wet) warnings.push_back("no pixel is wet, the picture is the dry one" + expected);
  if (!found.dry && !found.in_water) {
    warnings.push_back("every pixel is wet, nothing stands before the water" + expected);
  }
}

}  // namespace limpid
