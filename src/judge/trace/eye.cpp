#include "judge/trace/eye.h"

#include <cmath>

#include <glm/mat3x3.hpp>
#include <glm/vec4.hpp>

#include "limpid/optics/depth.h"

namespace limpid::trace {
namespace {

double plane_depth(const Camera& camera, double device) {
  return eye_depth_from_device(device, device_depth_of(camera));
}

}  // namespace

Eye::Eye(const Camera& camera, Size size)
    : rays_(rays_of(camera, {size.width, size.height})),
      to_view_(camera.view),
      projection_(camera.projection) {
  const double at_near = camera.clip == ClipSpace::kGl    ? -1
                         : camera.clip == ClipSpace::kD3d ? 0
                                                          : 1;
  near_ = plane_depth(camera, at_near);
  far_ = plane_depth(camera, camera.far_device_depth());
  if (!(far_ > near_)) far_ = HUGE_VAL;  // an infinite far plane, by rounding
}

Ray Eye::ray_at(double x, double y) const {
  const glm::dvec3 along = rays_.ray_at(x, y);
  const double length = glm::length(along);
  const Ray ray{rays_.origin_at(x, y), along / length, near_ * length, far_ * length};
  // Orthographic views may begin behind the eye, rays never do behind their origin.
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
