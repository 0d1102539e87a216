#pragma once
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "core/water_view.h"

namespace limpid {

/// Heights over the calm water on the rays of one row, at eye depths: over + depth under, each
/// linear in the column. `off` moves the rays by that many pixels.
struct RowHeights {
  double over, over_step, under, under_step;

  RowHeights(const WaterView& c, int y, glm::dvec2 off = {0, 0})
      : over_step(glm::dot(c.up, c.rays.origin_dx)), under_step(glm::dot(c.up, c.rays.ray_dx)) {
    const double column = 0.5 - c.corner.x + off.x, row = y - c.corner.y + 0.5 + off.y;
    over = c.eye_above + glm::dot(c.up, c.rays.origin_at(column, row));
    under = glm::dot(c.up, c.rays.ray_at(column, row));
  }

  double at(int x, double depth) const {
    return over + x * over_step + depth * (under + x * under_step);
  }
  /// The depth at which a height is reached; infinite or below 0 where it is not.
  double depth_at(int x, double height) const {
    return (height - over - x * over_step) / (under + x * under_step);
  }
};

}  // namespace limpid
