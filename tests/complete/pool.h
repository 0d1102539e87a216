#pragma once
#include <cmath>

#include <glm/geometric.hpp>

#include "op/pass.h"
#include "support.h"

namespace limpid::test {

/// A pool without walls: a bottom at y = -deep + rise z, with a texture of the world. The camera of
/// simple_scene(), two metres above the water; z grows towards the camera.
template <int kWidth, int kHeight>
struct PoolOf {
  static constexpr Size kSize{kWidth, kHeight};
  Scene scene = simple_scene(kSize);
  double deep = 2, rise = 0.05;
  Rect window = rect_of(kSize);
  Buffers buffers{rect_of(kSize)};

  glm::dvec3 ray(double x, double y) const {
    return rays_of(*scene.camera, {kSize.width, kSize.height}).ray_at(x + 0.5, y + 0.5);
  }
  double dry_depth(double x, double y) const {
    const glm::dvec3 r = ray(x, y);
    const double meets = (-deep - 2) / (r.y - rise * r.z);
    return meets > 0 ? meets : HUGE_VAL;
  }
  /// Colors the bottom by `light(x, z)` of its places in the world.
  template <class Light>
  void draw(Light&& light) {
    buffers.set(
        PlaneId::kDepth, [&](int x, int y) { return static_cast<float>(dry_depth(x, y)); }, window);
    for (int c = 0; c < 3; ++c) {
      buffers.set(
          plane_after(PlaneId::kColorR, c),
          [&](int x, int y) {
            const double depth = dry_depth(x, y);
            if (!(depth < 1e30)) return 0.5f;
            const glm::dvec3 at = depth * ray(x, y);
            return static_cast<float>(light(at.x, at.z));
          },
          window);
    }
  }
  Pass pass() const { return Pass(scene, buffers.frame, 1.333, kWholeState); }
  glm::dvec3 normal() const { return glm::normalize(glm::dvec3(0, 1, -rise)); }

  /// The end of a pixel's ray under calm water: its place in the picture, in pixels, the length of
  /// the path, and its place in the world.
  struct End {
    double x, y, distance;
    glm::dvec3 at;  ///< relative to the eye
  };
  End end(int x, int y) const {
    const glm::dvec3 r = ray(x, y), point = (-2 / r.y) * r, in = glm::normalize(r);
    const glm::dvec3 level = glm::dvec3(in.x, 0, in.z) / 1.333;
    const glm::dvec3 t = level - glm::dvec3(0, std::sqrt(1 - glm::dot(level, level)), 0);
    const double distance = (-deep - 2 + rise * point.z - point.y) / (t.y - rise * t.z);
    const glm::dvec3 at = point + distance * t;
    const glm::dvec3 eye = scene.camera->eye();
    const glm::dvec4 clip = scene.camera->projection * scene.camera->view * glm::dvec4(eye + at, 1);
    return {(0.5 + 0.5 * clip.x / clip.w) * kSize.width - 0.5,
            (0.5 - 0.5 * clip.y / clip.w) * kSize.height - 0.5, distance, at};
  }
  bool leaves(int x, int y) const {
    const End e = end(x, y);
    return e.x < -1e-3 || e.y < -1e-3 || e.x > kSize.width - 1 + 1e-3 ||
           e.y > kSize.height - 1 + 1e-3;
  }
};
using Pool = PoolOf<96, 72>;

}  // namespace limpid::test
