#include "complete/water_floor.h"

#include <algorithm>

#include <glm/geometric.hpp>

#include "complete/row_heights.h"

namespace limpid {
namespace {

constexpr int kStep = 8;  ///< pixels

}  // namespace

WaterFloor water_floor(const Frame& frame, const Pass& c, const Rgb<double>& sky) {
  const View<const float>& depth = frame.plane(PlaneId::kDepth);
  Rect window = intersection(frame.work(), depth.window);
  for (int i = 0; i < 3; ++i) {
    window = intersection(window, frame.plane(plane_after(PlaneId::kColorR, i)).window);
  }
  const double rise = c.has_sun ? std::max(glm::dot(c.sun.direction, c.up), 0.0) : 0;
  const Rgb<double> light = rise * c.sun.color + sky;
  Rgb<double> color{0, 0, 0};
  double squares = 0, cubes = 0, met = 0, missed = 0;
  const int first_x = window.x0 + std::min(kStep, window.width()) / 2;
  for (int y = window.y0 + std::min(kStep, window.height()) / 2; y < window.y1; y += kStep) {
    const RowHeights heights(c, y);
    for (int x = first_x; x < window.x1; x += kStep) {
      if (!(heights.under + x * heights.under_step < 0)) continue;
      const double far = depth.at(x, y);
      if (far > 1e30) missed += 1;
      const double drop = far < 1e30 ? -heights.at(x, far) : 0;
      if (!(drop > 0)) continue;
      met += 1, squares += drop * drop, cubes += drop * drop * drop;
      color = color + Rgb<double>{frame.plane(PlaneId::kColorR).at(x, y),
                                  frame.plane(PlaneId::kColorG).at(x, y),
                                  frame.plane(PlaneId::kColorB).at(x, y)};
    }
  }
  if (!(met > 0)) return {};
  const auto albedo = [&](double sum, double lit) {
    return lit > 0 ? std::clamp(sum / (met * lit), 0.0, ScatteredLight::kMaxAlbedo) : 0;
  };
  return {.depth = std::max(cubes / squares, -c.eye_above),
          .albedo = {albedo(color.r, light.r), albedo(color.g, light.g), albedo(color.b, light.b)},
          .share = met / (met + missed)};
}

}  // namespace limpid
