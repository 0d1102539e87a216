#pragma once
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "limpid/core/vec.h"

#include "op/pass.h"
#include "optics/refract.h"

/// Rays of light. All positions of the tracer are relative to the eye, which keeps them exact near
/// it.

namespace limpid::trace {

inline Vec3<double> formula_of(const glm::dvec3& v) { return vec3_of<double>(v); }
inline glm::dvec3 glm_of(const Vec3<double>& v) { return {v.x, v.y, v.z}; }

/// Length of a path without an end.
inline constexpr double kInfinitePath = 3e38;

/// The points origin + s direction, from <= s < to.
struct Ray {
  glm::dvec3 origin{0}, direction{0};  ///< direction is unit
  double from = 0, to = HUGE_VAL;

  glm::dvec3 at(double s) const { return origin + s * direction; }
};

/// Distance along the ray to the plane through `point`, +-inf or NaN if the ray does not meet it.
inline double distance_to_plane(const Ray& ray, const glm::dvec3& point, const glm::dvec3& normal) {
  return glm::dot(point - ray.origin, normal) / glm::dot(ray.direction, normal);
}

/// A ray, and those of the samples to its right and below it, which give its footprint in a
/// texture.
struct Beam {
  Ray ray, right, below;
};

/// The three rays from their points on the plane, each with the direction turn(direction).
template <class Turn>
Beam turned(const Beam& beam, const glm::dvec3& point, const glm::dvec3& plane_normal,
            Turn&& turn) {
  const auto next = [&](const Ray& ray) {
    return Ray{ray.at(distance_to_plane(ray, point, plane_normal)), turn(ray.direction)};
  };
  return {{point, turn(beam.ray.direction)}, next(beam.right), next(beam.below)};
}

}  // namespace limpid::trace
