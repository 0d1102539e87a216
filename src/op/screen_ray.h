#pragma once
#include "op/pass.h"
#include "op/pixel.h"

/// @file
/// Screen geometry for operators: the path of a ray from the surface across the screen, and the
/// height of visible surfaces above the calm water.

namespace limpid {

/// A ray from a pixel's surface point, as it crosses the screen. At s scene units from the surface
/// it appears shift_at(s) away from the pixel's own centre, at eye depth depth_at(s). Computed from
/// differences, never from two positions: exact in float at any size of picture, and 0 at s = 0.
/// Surfaces at the eye itself count as slightly in front of it, against 0 / 0.
template <class F>
struct ScreenRay {
  static constexpr double kLeastW = 1e-30;  ///< a millionth of it is no denormal float
  Vec2<F> across;                           ///< shift = s across / (w + s w_step)
  F w, w_step;                              ///< w_step < 0 where the ray comes towards the viewer
  F depth, depth_step;

  LIMPID_INLINE ScreenRay(const WaterView& c, const Pixel<F>& p, Vec3<F> direction) {
    depth = p.surface_depth;
    depth_step = dot(vec3_of<F>(c.forward), direction);
    w = max(given<F>(c.w_origin) + given<F>(c.w_depth) * depth, F(kLeastW));
    w_step = given<F>(c.w_depth) * depth_step;
    across = {dot(vec3_of<F>(c.to_u), direction) - p.uv.x * w_step,
              dot(vec3_of<F>(c.to_v), direction) - p.uv.y * w_step};
  }

  /// For s >= 0, +inf included (the vanishing point). Where the ray has passed the viewer's plane
  /// the shift is huge and finite.
  LIMPID_INLINE Vec2<F> shift_at(F s) const {
    const F far = min(s, F(1e30));
    return min(far / max(w + far * w_step, F(1e-6) * w), F(1e30)) * across;
  }
  LIMPID_INLINE F depth_at(F s) const { return depth + min(s, F(1e30)) * depth_step; }

  /// The s at a share t in 0 ... 1 of the screen distance to the place at s = `end`.
  LIMPID_INLINE F at_share(F t, F end) const {
    return t * end * (w / max(w + (F(1) - t) * end * w_step, F(1e-6) * w));
  }

  /// The inverse: at_share(share_at(s, end), end) = s, for s in 0 ... end.
  LIMPID_INLINE F share_at(F s, F end) const {
    return s * max(w / end + w_step, F(0)) / max(w + s * w_step, F(1e-6) * w);
  }

  /// The s at which the shift has grown to `reach` times `across`, as in shift_at; +inf if it never
  /// does.
  LIMPID_INLINE F s_at(F reach) const {
    const F rest = F(1) - reach * w_step;
    return select(rest > F(0), reach * w / select(rest > F(0), rest, F(1)), F(HUGE_VAL));
  }
};

/// Height over the calm surface of the point at eye depth `depth` (+inf counts as 1e30) on the view
/// ray at `shift` from the pixel.
template <class F>
LIMPID_INLINE F height_at(const WaterView& c, const Pixel<F>& p, Vec2<F> shift, F depth) {
  const F under = dot(vec3_of<F>(c.up), p.to_viewer) * (F(0) - p.ray_length);
  const F over = dot(vec3_of<F>(c.up), p.surface_point) - p.surface_depth * under;
  const F there_under =
      under + shift.x * given<F>(c.under_step.x) + shift.y * given<F>(c.under_step.y);
  const F there_over = over + shift.x * given<F>(c.over_step.x) + shift.y * given<F>(c.over_step.y);
  return given<F>(c.eye_above) + there_over + min(depth, F(1e30)) * there_under;
}

/// The shift to the centre of the texel at `shift`, where bilinear filtering mixes nothing in.
template <class F>
LIMPID_INLINE Vec2<F> to_texel(const WaterView& c, Vec2<F> shift) {
  const auto whole = [](F part, F count) { return floor(part * count + F(0.5)) / count; };
  return {whole(shift.x, given<F>(c.size.x)), whole(shift.y, given<F>(c.size.y))};
}

/// The gain of the view ray, per unit of eye depth, from the pixel to `shift`.
template <class F>
LIMPID_INLINE Vec3<F> ray_gain(const WaterView& c, Vec2<F> shift) {
  return shift.x * vec3_of<F>(double(c.size.x) * c.rays.ray_dx, "camera.ray_across") +
         shift.y * vec3_of<F>(double(c.size.y) * c.rays.ray_dy, "camera.ray_down");
}

/// The vector from the pixel's surface point to the point at eye depth `depth` (+inf counts as
/// 1e30) on the view ray at `shift`. From differences, like a ScreenRay.
template <class F>
LIMPID_INLINE Vec3<F> offset_to(const WaterView& c, const Pixel<F>& p, Vec2<F> shift, F depth) {
  const Rays& rays = c.rays;
  const double width = c.size.x, height = c.size.y;
  const Vec3<F> origin = shift.x * vec3_of<F>(width * rays.origin_dx, "camera.origin_across") +
                         shift.y * vec3_of<F>(height * rays.origin_dy, "camera.origin_down");
  const F far = min(depth, F(1e30));
  return (p.ray_length * (p.surface_depth - far)) * p.to_viewer + origin + far * ray_gain(c, shift);
}

/// Whether `across` mainly leads up or down the picture.
template <class F>
LIMPID_INLINE auto is_upright(const WaterView& c, Vec2<F> across) {
  return given<F>(c.size.x) * abs(across.x) < given<F>(c.size.y) * abs(across.y);
}

/// Number of times that `across` fits between uv and the edge to which it leads. A ray along the
/// edge does not stop because of rounding over the outermost texel.
template <class F>
LIMPID_INLINE F reach_in(const Bounds& b, Vec2<F> uv, Vec2<F> across) {
  const auto along = [](F at, F low, F high, F step) {
    const F room = select(step > F(0), high - at, at - low);
    return (max(room, F(0)) + F(1e-5)) / max(abs(step), F(1e-20));
  };
  return min(along(uv.x, given<F>(b.low.x), given<F>(b.high.x), across.x),
             along(uv.y, given<F>(b.low.y), given<F>(b.high.y), across.y));
}

/// The same for the two edges to which `across` mainly leads: a ray up the picture does not end at
/// the side to which it leans. Lookups beyond that side take the texels at the edge.
template <class F>
LIMPID_INLINE F reach_ahead(const WaterView& c, const Bounds& b, Vec2<F> uv, Vec2<F> across) {
  const auto upright = is_upright(c, across);
  return reach_in(b, uv, Vec2<F>{select(upright, F(0), across.x), select(upright, across.y, F(0))});
}

/// Eye depth at which the view ray at `shift` from the pixel is `drop` below the calm surface, +inf
/// if it never is.
template <class F>
LIMPID_INLINE F depth_at_drop(const WaterView& c, const Pixel<F>& p, Vec2<F> shift, F drop) {
  const F under = dot(vec3_of<F>(c.up), p.to_viewer) * (F(0) - p.ray_length);
  const F over = dot(vec3_of<F>(c.up), p.surface_point) - p.surface_depth * under;
  const F falls =
      F(0) - (under + shift.x * given<F>(c.under_step.x) + shift.y * given<F>(c.under_step.y));
  const F above = given<F>(c.eye_above) + over + shift.x * given<F>(c.over_step.x) +
                  shift.y * given<F>(c.over_step.y);
  const auto meets = (above + drop) * falls > F(0);
  return select(meets, (above + drop) / select(meets, falls, F(1)), F(HUGE_VAL));
}

/// The same for the calm surface itself.
template <class F>
LIMPID_INLINE F calm_depth_at(const WaterView& c, const Pixel<F>& p, Vec2<F> shift) {
  return depth_at_drop(c, p, shift, F(0));
}

/// Change of calm_depth_at from one row of pixels to the next.
template <class F>
LIMPID_INLINE F calm_depth_step(const WaterView& c, const Pixel<F>& p, Vec2<F> shift) {
  const F row = given<F>(1.0 / c.size.y, "camera.row");
  const F here = min(calm_depth_at(c, p, shift), F(1e30));
  const F below = min(calm_depth_at(c, p, Vec2<F>{shift.x, shift.y + row}), F(1e30));
  return abs(here - below);
}

}  // namespace limpid
