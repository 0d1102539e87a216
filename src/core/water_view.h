#pragma once
#include <span>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "limpid/core/camera.h"
#include "limpid/core/rect.h"
#include "limpid/core/scene.h"
#include "limpid/core/vec.h"

namespace limpid {

template <class F>
LIMPID_INLINE Vec3<F> vec3_of(const glm::dvec3& v) {
  return {given<F>(v.x), given<F>(v.y), given<F>(v.z)};
}
template <class F>
LIMPID_INLINE Vec3<F> vec3_of(const glm::dvec3&& v) = delete;
/// Replaces the address of a vector that has none; see given().
template <class F>
LIMPID_INLINE Vec3<F> vec3_of(const glm::dvec3& v, const char* name) {
  return {given<F>(v.x, name, 0), given<F>(v.y, name, 1), given<F>(v.z, name, 2)};
}

/// The waves that raise the water of a frame.
struct Swell {
  bool raises = false;              ///< without, the water is calm
  std::span<const SineWave> waves;  ///< the scene's waves if it has some
  double scale = 1;                 ///< of their heights
};

/// Camera and water plane as the numbers of a picture, in double: made once per frame from a scene
/// and the picture's window, without reading a pixel.
///
/// t, b: tangent frame of the calm surface relative to the camera: t is the camera's right
/// projected on the plane (its up, if right is parallel to the plane's normal), b = cross(up, t)
/// points away from the camera. map_x, map_y: tangent frame fixed to the world, for tiling maps:
/// world x (z, if x is parallel to up) projected on the plane, and cross(up, map_x).
struct WaterView {
  /// Throws Error unless the scene is valid and has a camera and a water plane. The waves of
  /// `swell` must live as long.
  WaterView(const Scene& scene, const Rect& window, const Swell& swell = {});

  Rays rays;
  Rays part;              ///< `rays` with the steps of the visible part of a pixel (Scene::part)
  glm::dvec2 off_centre;  ///< the middle of that part, in pixels from the pixel's centre
  glm::dvec3 eye;
  glm::dvec3 up, t, b;
  glm::dvec3 map_x, map_y;
  double eye_above;  ///< signed height of the eye over the calm surface
  /// A picture is seen through a window at the near distance; where the window lies below the
  /// water, the view begins in the water. False if no pixel's view does, and for orthographic
  /// cameras.
  bool submersible;
  double near;                      ///< eye depth of that window
  bool raised;                      ///< waves raise the water; without it is calm
  std::span<const SineWave> waves;  ///< the waves that raise it: of the scene, or of the look
  double wave_scale;                ///< of their heights
  /// The screen, for directions d from the eye: uv = (dot(to_u, d), dot(to_v, d)) / w, and eye
  /// depth = dot(forward, d). A point at eye depth Z has w = w_origin + w_depth Z.
  glm::dvec3 to_u, to_v, forward;
  double w_origin, w_depth;
  double device_offset, device_scale;  ///< of device_depth()
  /// Height over the calm surface of a point at eye depth Z on the ray at uv: eye_above + over + Z
  /// under, where over and under change by these steps over the width and the height of the
  /// picture.
  glm::dvec2 over_step, under_step;
  glm::ivec2 size;    ///< of the window
  glm::ivec2 corner;  ///< of the window
  double time;

  /// Depth after projection, 0 at the near plane, 1 at the far plane or at infinity.
  template <class F>
  LIMPID_INLINE F device_depth(F eye_depth) const {
    return (given<F>(device_offset) + given<F>(device_scale) * eye_depth) /
           (given<F>(w_origin) + given<F>(w_depth) * eye_depth);
  }

  /// Phase of a wave below the eye, in rad, within a turn.
  double phase_at_eye(const SineWave& wave) const;
};

/// The rays of one picture row in the number type of the runner. x and y are pixel coordinates
/// (centres at +0.5) from the corner of the display window; y is folded in here, in double.
template <class F>
struct RowRays {
  Vec3<F> origin, origin_dx, ray, ray_dx;
  F v;  ///< of the row's centre, 0 ... 1 down the picture
  F calm_over, calm_over_dx, calm_under, calm_under_dx;
  F window;  ///< eye depth where the view begins, if it can begin in the water; else 0

  RowRays() = default;  ///< for callers that set all members
  RowRays(const WaterView& view, double y)
      : origin(vec3_of<F>(view.rays.origin + y * view.rays.origin_dy, "row.origin")),
        origin_dx(vec3_of<F>(view.rays.origin_dx)),
        ray(vec3_of<F>(view.rays.ray + y * view.rays.ray_dy, "row.ray")),
        ray_dx(vec3_of<F>(view.rays.ray_dx)),
        v(F(y / view.size.y)),
        calm_over(F(-view.eye_above - dot(view.up, view.rays.origin + y * view.rays.origin_dy))),
        calm_over_dx(F(-dot(view.up, view.rays.origin_dx))),
        calm_under(F(dot(view.up, view.rays.ray + y * view.rays.ray_dy))),
        calm_under_dx(F(dot(view.up, view.rays.ray_dx))),
        window(F(view.submersible ? view.near : 0)) {}

  LIMPID_INLINE Vec3<F> ray_at(F x) const { return ray + x * ray_dx; }
  LIMPID_INLINE Vec3<F> origin_at(F x) const { return origin + x * origin_dx; }

  /// Eye depth of the calm surface, +inf if the ray does not meet it beyond the begin of the view.
  LIMPID_INLINE F calm_depth(F x) const {
    const F over = calm_over + x * calm_over_dx;
    const F under = calm_under + x * calm_under_dx;
    const auto meets = over * under > F(0);
    const F depth = over / select(meets, under, F(1));
    return select(meets && depth >= window, depth, F(HUGE_VAL));
  }

 private:
  static double dot(const glm::dvec3& a, const glm::dvec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }
};

/// 1 where the view of this pixel begins in the water, 0 where it begins in the air.
template <class F>
LIMPID_INLINE F begins_in_water(const WaterView& view, const RowRays<F>& row, F x) {
  if (!view.submersible) return F(0);
  const Vec3<F> start = given<F>(view.near) * row.ray_at(x);  // relative to the eye
  F height = given<F>(view.eye_above) + dot(vec3_of<F>(view.up), start);
  const Vec3<F> map_x = vec3_of<F>(view.map_x), map_y = vec3_of<F>(view.map_y);
  if (!view.raised) return select(height < F(0), F(1), F(0));
  int nth = -1;
  for (const SineWave& wave : view.waves) {
    ++nth;
    const F along = given<F>(wave.k_x) * dot(start, map_x) + given<F>(wave.k_y) * dot(start, map_y);
    height = height - given<F>(view.wave_scale * wave.amplitude, "waves.height", nth) *
                          sin(given<F>(view.phase_at_eye(wave), "waves.phase", nth) + along);
  }
  return select(height < F(0), F(1), F(0));
}

}  // namespace limpid
