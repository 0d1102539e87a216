#pragma once
#include <span>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "limpid/core/camera.h"
#include "limpid/core/frame.h"
#include "limpid/core/scene.h"
#include "limpid/core/texture_levels.h"
#include "limpid/op/height_bound.h"
#include "limpid/op/pixel.h"
#include "limpid/optics/waves.h"

namespace limpid {

template <class F>
LIMPID_INLINE Vec3<F> vec3_of(const glm::dvec3& v) {
  return {F(v.x), F(v.y), F(v.z)};
}

/// Where planes can be looked up: the centres of their outermost texels, in uv.
struct Bounds {
  glm::dvec2 low, high;
};

/// The waves that raise the water of a frame which has no depth of its surface.
struct Swell {
  bool raises = false;              ///< without, that water is calm
  std::span<const SineWave> waves;  ///< those of the scene where there are none
  double scale = 1;                 ///< of their heights
};

/// What all pixels of a frame have in common, in double, made once a frame.
///
/// t, b: tangent frame of the calm surface as the camera sees it: t is the camera's right projected
/// on the plane (its up, should right be parallel to the plane's normal), b = cross(up, t) points
/// away from the camera. map_x, map_y: tangent frame that stays with the world, for tiling maps:
/// world x (z, should x be parallel to up) projected on the plane, and cross(up, map_x).
struct Context {
  /// Throws Error unless the scene has a camera and a water plane, both valid. The waves of `swell`
  /// must live as long.
  Context(const Scene& scene, const Frame& frame, double ior, StateSet made,
          const Swell& swell = {});

  Rays rays;
  Rays part;  ///< `rays` with the steps of the part of a pixel that is seen (Scene::part)
  glm::dvec2 off_centre;  ///< where the middle of that part is, in pixels from the pixel's centre
  glm::dvec3 eye;
  glm::dvec3 up, t, b;
  glm::dvec3 map_x, map_y;
  double eye_above;  ///< signed height of the eye over the calm surface
  /// A picture is seen through a window at the near distance; where that lies lower than the water,
  /// the view begins in it. False when no pixel's does, as for orthographic cameras.
  bool submersible;
  double near;                      ///< eye depth of that window
  bool raised;                      ///< waves raise and lower the water; without it is calm
  std::span<const SineWave> waves;  ///< those that do: of the scene, or of the look
  double wave_scale;                ///< of their heights
  /// The screen, for directions d from the eye: uv = (dot(to_u, d), dot(to_v, d)) / w, and eye
  /// depth = dot(forward, d). A point at eye depth Z has w = w_origin + w_depth Z.
  glm::dvec3 to_u, to_v, forward;
  double w_origin, w_depth;
  double device_offset, device_scale;  ///< of device_depth()
  /// Height over the calm surface of a point at eye depth Z on the ray at uv: eye_above + over + Z
  /// under, where over and under change by these over the width and the height of the picture.
  glm::dvec2 over_step, under_step;
  PlaneSet planes;  ///< that the frame has: for operators that take more where there is more
  Bounds dry, below, reflection;  ///< of color with depth, of the two others with theirs
  Bounds surface;                 ///< of the water's depth; `dry` where the frame has none
  bool surface_ends;              ///< before `dry` does: the calm level stands for the rest of it
  glm::ivec2 size;                ///< of the display window
  glm::ivec2 corner;              ///< of the display window
  Sun sun;                        ///< operators that need one declare it
  bool has_sun;                   ///< for those that do with or without
  double time;
  double ior;
  Texture wave_map, environment;
  const SlopeLevels* wave_slopes;         ///< of the wave map at this time, or null
  Sym2<double> wave_variance;             ///< likewise, or 0
  const ScatteredLight* scattered_light;  ///< of red, green, blue, or null
  Rgb<double> sky;                        ///< radiance of an even sky, 0 where nobody knows it
  bool has_sky;
  StateSet made;  ///< what the operators of the plan make: neutral or absent ones make nothing
  /// False where it is known that nothing stands before the water in any place that refraction may
  /// look up (plan/survey.h): an operator may leave out its test for that.
  bool foreground = true;
  /// False where it is known that something was hit in every place that refraction may look up: an
  /// operator may leave out its test for nothing().
  bool bottomless = true;
  /// Of what refraction may look up, where a runner has made it (complete/heights.h). It saves
  /// looks and changes no result.
  HeightBound heights = {};
  RangeBound mirrored = {};          ///< likewise, of what the mirror marches over and may hit
  RangeBound lit = {};               ///< likewise, of the shadow on the surface
  const Continuation* continuation;  ///< of the bottom beyond the picture, or null
  const BottomLayer* bottom_layer;   ///< of the bottom behind what stands before it, or null

  /// Depth after projection, 0 at the near plane, 1 at the far plane or at infinity.
  template <class F>
  LIMPID_INLINE F device_depth(F eye_depth) const {
    return (F(device_offset) + F(device_scale) * eye_depth) /
           (F(w_origin) + F(w_depth) * eye_depth);
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
  F window;  ///< eye depth where the view begins, should it be able to begin in the water; else 0

  RowRays(const Context& c, double y)
      : origin(vec3_of<F>(c.rays.origin + y * c.rays.origin_dy)),
        origin_dx(vec3_of<F>(c.rays.origin_dx)),
        ray(vec3_of<F>(c.rays.ray + y * c.rays.ray_dy)),
        ray_dx(vec3_of<F>(c.rays.ray_dx)),
        v(F(y / c.size.y)),
        calm_over(F(-c.eye_above - dot(c.up, c.rays.origin + y * c.rays.origin_dy))),
        calm_over_dx(F(-dot(c.up, c.rays.origin_dx))),
        calm_under(F(dot(c.up, c.rays.ray + y * c.rays.ray_dy))),
        calm_under_dx(F(dot(c.up, c.rays.ray_dx))),
        window(F(c.submersible ? c.near : 0)) {}

  LIMPID_INLINE Vec3<F> ray_at(F x) const { return ray + x * ray_dx; }
  LIMPID_INLINE Vec3<F> origin_at(F x) const { return origin + x * origin_dx; }

  /// Eye depth of the calm surface, +inf where the ray does not meet it where the view is.
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
LIMPID_INLINE F begins_in_water(const Context& c, const RowRays<F>& row, F x) {
  if (!c.submersible) return F(0);
  const Vec3<F> start = F(c.near) * row.ray_at(x);  // relative to the eye
  F height = F(c.eye_above) + dot(vec3_of<F>(c.up), start);
  const Vec3<F> map_x = vec3_of<F>(c.map_x), map_y = vec3_of<F>(c.map_y);
  if (!c.raised) return select(height < F(0), F(1), F(0));
  for (const SineWave& wave : c.waves) {
    const F along = F(wave.k_x) * dot(start, map_x) + F(wave.k_y) * dot(start, map_y);
    height = height - F(c.wave_scale * wave.amplitude) * sin(F(c.phase_at_eye(wave)) + along);
  }
  return select(height < F(0), F(1), F(0));
}

/// Fills what no operator writes; see Pixel.
template <class F>
LIMPID_INLINE void begin_pixel(const Context& c, const RowRays<F>& row, F x, F side,
                               F surface_depth, F dry_depth, Pixel<F>& p) {
  const Vec3<F> ray = row.ray_at(x);
  p.uv = {x * F(1.0 / c.size.x), row.v};
  p.ray_length = length(ray);
  p.to_viewer = (F(-1) / p.ray_length) * ray;
  p.surface_point = row.origin_at(x) + surface_depth * ray;
  p.surface_depth = surface_depth;
  p.dry_depth = dry_depth;
  p.side = side;
}

/// Whether an eye depth says that nothing was hit.
template <class F>
LIMPID_INLINE auto nothing(F depth) {
  return depth > F(1e30);
}

/// Gives these parts of the state what Pixel says that they begin as, once begin_pixel() is done.
template <class F>
LIMPID_INLINE void begin_state(StateSet parts, const Context& c, Rgb<F> dry_color, Pixel<F>& p) {
  const Vec2<F> none{F(0), F(0)};
  const Rgb<F> black{F(0), F(0), F(0)};
  const auto endless = nothing(p.dry_depth) && p.side > F(-0.5);
  if (parts.has(StatePart::kNormal)) {
    p.normal = vec3_of<F>(c.up);
    p.tilt = none;
  }
  if (parts.has(StatePart::kSlopeVariance)) p.slope_variance = {F(0), F(0), F(0)};
  if (parts.has(StatePart::kPrism)) {
    p.prism_r = p.prism_g = p.prism_b = none;
    p.dispersion = black;
  }
  if (parts.has(StatePart::kPosition)) {
    p.shift = p.shift_r = p.shift_g = p.shift_b = none;
    p.hit_depth = p.dry_depth;
  }
  if (parts.has(StatePart::kPath)) p.path = F(0);
  if (parts.has(StatePart::kConfidence)) p.confidence = select(endless, F(0), F(1));
  if (parts.has(StatePart::kTransmittance)) p.transmittance = {F(1), F(1), F(1)};
  if (parts.has(StatePart::kTransmitted)) p.transmitted = select(endless, black, dry_color);
  if (parts.has(StatePart::kInScatter)) p.in_scatter = black;
  if (parts.has(StatePart::kSunScatter)) p.sun_near = p.sun_far = p.sun_often = black;
  p.sun_entry = {F(0), F(0), F(0)};
  p.sun_way = F(0);
  if (parts.has(StatePart::kFresnel)) p.fresnel = F(0);
  if (parts.has(StatePart::kReflected)) p.reflected = black;
  if (parts.has(StatePart::kMirrorSources)) p.mirror_sources = black;
  if (parts.has(StatePart::kHighlight)) p.highlight = black;
}

}  // namespace limpid
