#include "judge/trace/eye.h"

#include <cmath>

#include <glm/mat3x3.hpp>
#include <glm/vec4.hpp>

namespace limpid::trace {
Eye::Eye(const Camera& camera, Size size)
    : rays_(rays_of(camera, {size.width, size.height})),
      to_view_(camera.view),
      projection_(camera.projection),
      near_(camera.near_depth()),
      far_(camera.far_depth()) {}

Ray Eye::ray_at(double x, double y) const {
  const glm::dvec3 along = rays_.ray_at(x, y);
  const double length = glm::length(along);
  const Ray ray{rays_.origin_at(x, y), along / length, near_ * length, far_ * length};
  // Orthographic views may begin behind the eye, but no ray may begin behind its origin.
  return ray.from >= 0 ? ray : Ray{ray.at(ray.from), ray.direction, 0, ray.to - ray.from};
}

Beam Eye::beam_at(double x, double y, double step) const {
  return {ray_at(x, y), ray_at(x + step, y), ray_at(x, y + step)};
}

double Eye::depth_of(const Ray& ray, double distance) const {
  return -(to_view_ * ray.at(distance)).z;
}

std::optional<glm::dvec2> Eye::place(const glm::dvec3& p, double w) const {
  const glm::dvec4 clip = projection_ * glm::dvec4(to_view_ * p, w);
  if (!(clip.w > 0)) return std::nullopt;
  return glm::dvec2(0.5 + 0.5 * clip.x / clip.w, 0.5 - 0.5 * clip.y / clip.w);
}

}  // namespace limpid::trace
