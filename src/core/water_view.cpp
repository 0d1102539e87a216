#include "core/water_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "limpid/core/error.h"

namespace limpid {
namespace {

/// `v` without its component along `axis`, unit; `fallback` instead of `v` if (almost) nothing is
/// left.
glm::dvec3 on_plane(const glm::dvec3& axis, const glm::dvec3& v, const glm::dvec3& fallback) {
  const auto flat = [&](const glm::dvec3& w) { return w - glm::dot(w, axis) * axis; };
  const glm::dvec3 first = flat(v);
  return glm::normalize(glm::length(first) > 1e-6 ? first : flat(fallback));
}

/// The direction on screen, unit, in pixels to the right and down, in which the calm water recedes:
/// the heights of equally deep points change fastest along it. Down if they do not change.
glm::dvec2 receding(const Rays& rays, const glm::dvec3& up) {
  const glm::dvec2 near(glm::dot(up, rays.origin_dx), glm::dot(up, rays.origin_dy));
  const glm::dvec2 far(glm::dot(up, rays.ray_dx), glm::dot(up, rays.ray_dy));
  const glm::dvec2 falls = near + far;  // one of them is 0
  const double steep = glm::length(falls);
  return steep > 1e-12 ? falls / steep : glm::dvec2(0, 1);
}

/// The camera with its pixel centres moved by this, in pixels.
Camera moved(Camera camera, glm::dvec2 pixels, glm::dvec2 size) {
  const glm::dvec2 by = 2.0 * pixels / size;
  for (int column = 0; column < 4; ++column) {
    glm::dvec4& p = camera.projection[column];
    p.x -= by.x * p.w;
    p.y += by.y * p.w;
  }
  return camera;
}

/// Rays whose steps are this many times narrower along a direction on screen.
Rays narrower(Rays rays, glm::dvec2 along, int times) {
  const auto narrow = [&](glm::dvec3& dx, glm::dvec3& dy) {
    const glm::dvec3 lost = (1 - 1.0 / times) * (along.x * dx + along.y * dy);
    dx -= along.x * lost;
    dy -= along.y * lost;
  };
  narrow(rays.origin_dx, rays.origin_dy);
  narrow(rays.ray_dx, rays.ray_dy);
  return rays;
}

}  // namespace

WaterView::WaterView(const Scene& scene, const Rect& window, const Swell& swell) {
  scene.validate();
  if (!scene.camera) throw Error("the scene has no camera, expected view and projection matrices");
  if (!scene.water) throw Error("the scene has no water plane, expected its normal and height");
  size = {window.width(), window.height()};
  corner = {window.x0, window.y0};
  raised = swell.raises;
  waves = swell.waves.empty() ? std::span<const SineWave>(scene.water->waves) : swell.waves;
  wave_scale = swell.scale;
  time = scene.time;
  Camera camera = *scene.camera;
  up = scene.water->up;
  rays = part = rays_of(camera, size);
  off_centre = {0, 0};
  if (scene.part.count > 1) {
    const glm::dvec2 along = receding(rays, up);
    off_centre = ((scene.part.index + 0.5) / scene.part.count - 0.5) * along;
    camera = moved(camera, off_centre, glm::dvec2(size));
    rays = rays_of(camera, size);
    part = narrower(rays, along, scene.part.count);
  }
  eye = camera.eye();
  t = on_plane(up, camera.right(), camera.up());
  b = glm::cross(up, t);
  const PlaneAxes axes = plane_axes(up);
  map_x = axes.x;
  map_y = axes.y;
  eye_above = glm::dot(up, eye) - scene.water->height;

  const glm::dmat4& p = camera.projection;
  const glm::dmat3 to_view(camera.view);
  const auto row = [&](int r) { return glm::dvec3(p[0][r], p[1][r], p[2][r]) * to_view; };
  to_u = 0.5 * (row(0) + row(3));
  to_v = 0.5 * (row(3) - row(1));
  forward = glm::dvec3(0, 0, -1) * to_view;
  w_origin = p[3][3];
  w_depth = -p[2][3];
  // z / w in 0 ... 1, for any range of the projection: GL's is twice as long, reversed ones run
  // backwards.
  const glm::dvec2 z(p[3][2], -p[2][2]), one(w_origin, w_depth);
  const glm::dvec2 device = camera.clip == ClipSpace::kGl    ? 0.5 * (z + one)
                            : camera.clip == ClipSpace::kD3d ? z
                                                             : one - z;
  device_offset = device.x;
  device_scale = device.y;
  over_step = {glm::dot(up, rays.origin_dx) * size.x, glm::dot(up, rays.origin_dy) * size.y};
  under_step = {glm::dot(up, rays.ray_dx) * size.x, glm::dot(up, rays.ray_dy) * size.y};

  double crest = 0;
  if (raised) {
    for (const SineWave& wave : waves) crest += std::abs(wave_scale * wave.amplitude);
  }
  near = camera.near_depth();
  double lowest = HUGE_VAL;  // of the window's corners, over the calm surface
  for (const int x : {0, size.x}) {
    for (const int y : {0, size.y}) {
      lowest = std::min(lowest, eye_above + near * glm::dot(up, rays.ray_at(x, y)));
    }
  }
  submersible = !camera.orthographic() && lowest < crest;
}

double WaterView::phase_at_eye(const SineWave& wave) const {
  const double phase = wave.k_x * glm::dot(eye, map_x) + wave.k_y * glm::dot(eye, map_y) +
                       wave.phase - std::fmod(wave.omega * time, 2 * std::numbers::pi);
  return std::remainder(phase, 2 * std::numbers::pi);
}

}  // namespace limpid
