#include "complete/sun_sight.h"

#include <algorithm>
#include <cmath>

#include "op/height_bound.h"
#include "op/pixel_start.h"
#include "op/sun_search.h"

namespace limpid {
namespace {

/// Lookups of one pixel in the depth plane.
struct DepthTap {
  const View<const float>& depth;
  const Pass& c;
  int x, y;

  double nearest(PlaneId, Vec2<double> shift) const {
    const Rect& window = depth.window;
    const auto texel = [](double at, int low, int high) {
      return static_cast<int>(std::floor(std::clamp<double>(at, low, high - 1) + 0.5));
    };
    return depth.at(texel(x + shift.x * c.size.x, window.x0, window.x1),
                    texel(y + shift.y * c.size.y, window.y0, window.y1));
  }
  static SeenRange range(PlaneId, bool, Vec2<double>, Vec2<double>) { return {}; }
};

}  // namespace

Pixel<double> SunSight::pixel_at(int x, int y, double depth) const {
  Pixel<double> pixel{};
  const RowRays<double> rays(c_, y - c_.corner.y + 0.5);
  const double at = x - c_.corner.x + 0.5;
  const double side = begins_in_water(c_, rays, at) > 0 ? -1 : 1;
  begin_pixel<double>(c_, rays, at, side, depth, depth, pixel);
  return pixel;
}

double SunSight::hidden_from_water(int x, int y, double depth) const {
  return sun_hidden<double>(c_, pixel_at(x, y, depth), DepthTap{depth_, c_, x, y}, true);
}

double SunSight::hidden_from_surface(int x, int y) const {
  constexpr MirrorSteps kSteps{24, 0.2, 0.2, true};
  constexpr double kOff = 0.005;  // a pixel's depth is that of a texel, its surface may be steep
  const Pixel<double> pixel = pixel_at(x, y, (1 - kOff) * depth_.at(x, y));
  const ScreenRay<double> to_sun(c_, pixel, vec3_of<double>(c_.sun.direction));
  const auto all = [](Vec2<double>, double) { return true; };
  return MirrorSearch<double, DepthTap>::march(c_, DepthTap{depth_, c_, x, y}, true,
                                               PlaneId::kDepth, c_.dry, pixel, to_sun, kSteps, all)
      .hit;
}

}  // namespace limpid
