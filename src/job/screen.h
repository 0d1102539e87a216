#pragma once
#include <cmath>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "core/water_view.h"

namespace limpid {

/// A place on a picture or a motion on it, in pixels: x to the right, y down.
struct Place {
  double x, y;
};

/// The texel that covers a place, or none beyond the window.
inline std::optional<std::pair<int, int>> texel_of(const Place& place, const Rect& window) {
  const double x = std::floor(place.x), y = std::floor(place.y);
  if (!(x >= window.x0 && x < window.x1 && y >= window.y0 && y < window.y1)) return {};
  return std::pair(static_cast<int>(x), static_cast<int>(y));
}

/// From places on a picture to points of the scene, and back. Points are relative to the eye.
class Screen {
 public:
  explicit Screen(const WaterView& view) : view_(view) {}

  const WaterView& view() const { return view_; }
  glm::dvec3 ray_at(const Place& p) const {
    return view_.rays.ray_at(p.x - view_.corner.x, p.y - view_.corner.y);
  }
  glm::dvec3 origin_at(const Place& p) const {
    return view_.rays.origin_at(p.x - view_.corner.x, p.y - view_.corner.y);
  }
  glm::dvec3 point_at(const Place& p, double depth) const {
    return origin_at(p) + depth * ray_at(p);
  }
  /// None of what lies behind the camera.
  std::optional<Place> place_of(const glm::dvec3& point) const {
    const glm::dvec3 of_origin = point - view_.rays.origin;
    return place_of(of_origin, view_.w_origin + view_.w_depth * glm::dot(view_.forward, of_origin));
  }
  /// Of a point infinitely far away; none of orthographic cameras.
  std::optional<Place> place_of_direction(const glm::dvec3& direction) const {
    return place_of(direction, view_.w_depth * glm::dot(view_.forward, direction));
  }

 private:
  std::optional<Place> place_of(const glm::dvec3& d, double w) const {
    if (!(w > 0)) return {};
    return Place{glm::dot(view_.to_u, d) / w * view_.size.x + view_.corner.x,
                 glm::dot(view_.to_v, d) / w * view_.size.y + view_.corner.y};
  }

  const WaterView& view_;
};

}  // namespace limpid
