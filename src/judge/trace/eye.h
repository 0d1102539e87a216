#pragma once
#include <optional>

#include <glm/vec2.hpp>

#include "limpid/core/camera.h"
#include "limpid/core/rect.h"

#include "judge/trace/beam.h"

namespace limpid::trace {

/// The camera, with its eye as origin.
class Eye {
 public:
  Eye(const Camera& camera, Size size);

  /// The view through that place of the picture, in pixels; its neighbours are `step` away.
  Beam beam_at(double x, double y, double step) const;
  /// Eye depth of a point at that distance along a ray.
  double depth_of(const Ray& ray, double distance) const;

  /// The place of a point in the picture, (0, 0) the upper left; nothing if it is not in front of
  /// the camera.
  std::optional<glm::dvec2> place_of(const glm::dvec3& point) const { return place(point, 1); }
  /// The place of a direction, for points infinitely far away.
  std::optional<glm::dvec2> place_of_direction(const glm::dvec3& to) const { return place(to, 0); }

 private:
  Ray ray_at(double x, double y) const;
  std::optional<glm::dvec2> place(const glm::dvec3& p, double w) const;

  Rays rays_;
  glm::dmat3 to_view_;
  glm::dmat4 projection_;
  double near_, far_;
};

}  // namespace limpid::trace
