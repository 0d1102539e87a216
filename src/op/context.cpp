#include "limpid/op/context.h"

#include <string>

#include <glm/geometric.hpp>

#include "limpid/core/error.h"

namespace limpid {
namespace {

/// `v` without its part along `axis`, unit; `fallback` instead of `v` where that leaves (almost)
/// nothing.
glm::dvec3 on_plane(const glm::dvec3& axis, const glm::dvec3& v, const glm::dvec3& fallback) {
  const auto flat = [&](const glm::dvec3& w) { return w - glm::dot(w, axis) * axis; };
  const glm::dvec3 first = flat(v);
  return glm::normalize(glm::length(first) > 1e-6 ? first : flat(fallback));
}

}  // namespace

Context::Context(const Scene& scene, const Frame& frame, double index, StateSet parts)
    : sun(scene.sun.value_or(Sun{})),
      time(scene.time),
      ior(index),
      wave_map(frame.wave_map),
      made(parts) {
  scene.validate();
  if (!scene.camera) throw Error("the scene has no camera, expected view and projection matrices");
  if (!scene.water) throw Error("the scene has no water plane, expected its normal and height");
  size = {frame.display.width(), frame.display.height()};
  corner = {frame.display.x0, frame.display.y0};
  rays = rays_of(*scene.camera, size);
  eye = scene.camera->eye();
  up = scene.water->up;
  t = on_plane(up, scene.camera->right(), scene.camera->up());
  b = glm::cross(up, t);
  const PlaneAxes axes = plane_axes(up);
  map_x = axes.x;
  map_y = axes.y;
  eye_above = glm::dot(up, eye) - scene.water->height;
  if (!(eye_above > 0) && !scene.camera->orthographic()) {
    throw Error("the camera is in the water, " + std::to_string(-eye_above) +
                " below its surface: expected an eye above it");
  }
}

}  // namespace limpid
