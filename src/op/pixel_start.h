#pragma once
#include "limpid/core/state.h"

#include "core/water_view.h"
#include "op/pixel.h"

/// @file
/// The state of a pixel before the first operator, for all runners.

namespace limpid {

/// The start of a pixel: whether it is wet, on which side its view begins, and its depths. Finite
/// numbers replace the depths of a dry pixel, whose results are discarded, to keep infinities out
/// of the formulas. A pixel that looks through water alone, into the distance, has no surface, but
/// a finite depth for it.
template <class F>
struct PixelStart {
  using Mask = decltype(F() < F());
  Mask wet;
  F side;  ///< Pixel::side
  F surface_depth, dry_depth;

  /// x: as in RowRays; `water` and `dry` are the eye depths of the surface and of the dry scene.
  /// Pixels that are not `in_picture` are dry.
  LIMPID_INLINE PixelStart(const WaterView& view, const RowRays<F>& row, F x, F water, F dry,
                           Mask in_picture) {
    constexpr double kDrySurface = 1, kDryBottom = 2, kFarAway = 1e4;
    const Mask meets = water < dry;
    const Mask in_water = begins_in_water(view, row, x) > F(0);
    wet = in_picture && (meets || in_water);
    side = select(in_water, select(meets, F(-1), F(0)), F(1));
    const F other = select(in_water, min(dry, F(kFarAway)), F(kDrySurface));
    surface_depth = select(meets, water, other);
    dry_depth = select(wet, dry, F(kDryBottom));
  }
};

/// Sets the members that no operator writes; see Pixel.
template <class F>
LIMPID_INLINE void begin_pixel(const WaterView& view, const RowRays<F>& row, F x, F side,
                               F surface_depth, F dry_depth, Pixel<F>& p) {
  const Vec3<F> ray = row.ray_at(x);
  p.uv = {x * given<F>(1.0 / view.size.x, "camera.column"), row.v};
  p.ray_length = length(ray);
  p.to_viewer = (F(-1) / p.ray_length) * ray;
  p.surface_point = row.origin_at(x) + surface_depth * ray;
  p.surface_depth = surface_depth;
  p.dry_depth = dry_depth;
  p.side = side;
}

/// Initialises these parts of the state as Pixel states, after begin_pixel().
template <class F>
LIMPID_INLINE void begin_state(StateSet parts, const WaterView& view, Rgb<F> dry_color,
                               Pixel<F>& p) {
  const Vec2<F> none{F(0), F(0)};
  const Rgb<F> black{F(0), F(0), F(0)};
  const auto endless = nothing(p.dry_depth) && p.side > F(-0.5);
  if (parts.has(StatePart::kNormal)) {
    p.normal = vec3_of<F>(view.up);
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
  if (parts.has(StatePart::kDryBottom)) {
    p.dry_bottom = select(endless, black, dry_color);
    p.dry_lit = F(1), p.dry_lit_known = p.filled = F(0);
  }
  if (parts.has(StatePart::kInScatter)) p.in_scatter = black;
  if (parts.has(StatePart::kSunScatter)) p.sun_near = p.sun_far = p.sun_multiple = black;
  p.sun_entry = {F(0), F(0), F(0)};
  p.mean_scatter_distance = F(0);
  if (parts.has(StatePart::kFresnel)) p.fresnel = F(0);
  if (parts.has(StatePart::kReflected)) p.reflected = black;
  if (parts.has(StatePart::kMirrorSources)) p.mirror_sources = black;
  if (parts.has(StatePart::kHighlight)) p.highlight = black;
}

}  // namespace limpid
