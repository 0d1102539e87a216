#pragma once
#include "limpid/core/vec.h"

namespace limpid {

/// The running state of one pixel (F = double) or of one vector of pixels (F = SIMD lanes).
///
/// Positions in the picture are kept as shifts from the pixel's own centre, in uv units of the
/// display window: exact in float at any picture size, and "not shifted" is 0.
template <class F>
struct Pixel {
  // Set before the first operator, never written by one.
  Vec2<F> uv;             ///< the pixel's own centre
  Vec3<F> to_viewer;      ///< V, unit, world
  Vec3<F> surface_point;  ///< world, relative to the eye
  F surface_depth;        ///< eye depth of the water at this pixel, finite
  F dry_depth;   ///< eye depth of the dry scene at this pixel, beyond surface_depth or +inf
  F ray_length;  ///< length of the pixel's ray per unit of eye depth
  /// Where the view begins and whether it meets the surface: 1 from the air onto the water, -1 from
  /// the water up to the surface, 0 in the water without meeting it. Always 1 unless
  /// WaterView::submersible.
  F side;

  Vec3<F> normal;  ///< wave normal, unit, world; begins as the calm normal
  Vec2<F> tilt;    ///< (n.t, -n.b): x right, y down; begins as 0
  /// Variance of the slopes along WaterView::map_x and map_y around those of `normal`, for waves
  /// too small for the pixel. Begins as 0.
  Sym2<F> slope_variance;
  Vec2<F> prism_r, prism_g, prism_b;  ///< shift of each channel beyond `shift`; begin as 0
  Rgb<F> dispersion;  ///< index of refraction of each channel, less the common index; begins as 0

  Vec2<F> shift;                      ///< to the end of the refracted ray; begins as 0
  Vec2<F> shift_r, shift_g, shift_b;  ///< to the final lookup of each channel; begin as 0
  F hit_depth;                        ///< dry eye depth at `shift`; begins as dry_depth
  F path;                ///< scene units, >= 0, +inf where the ray meets no surface; begins as 0
  F confidence;          ///< begins as 1; as 0 for water without a bottom
  Rgb<F> transmittance;  ///< begins as 1

  /// Begins as the dry color at this pixel; as 0 if nothing was hit and no surface lies in between:
  /// there the view shows the water itself.
  Rgb<F> transmitted;
  Rgb<F> dry_bottom;  ///< `transmitted` as lit in the dry picture; begins like it
  /// The share of the sunlight that reaches the bottom in the dry picture, where the shadow plane
  /// shows another surface, and whether it is known, 0 ... 1; begins as 1, not known. Refraction
  /// knows the share of it that BottomLayer::lit fills in.
  F dry_lit, dry_lit_known;
  F filled;        ///< share of `transmitted` from Pass::bottom_layer, by Refraction; begins as 0
  Rgb<F> dry_sun;  ///< the sun's light alone where the channels are looked up; set by Caustics
  Rgb<F> in_scatter;  ///< begins as 0, as do all members below
  /// Sunlit parts of in_scatter: the first in the shadow of the surface point, the second in that
  /// of the end of the ray.
  Rgb<F> sun_near, sun_far;
  /// Part of in_scatter: sunlight scattered more than once, or reflected by the bottom.
  Rgb<F> sun_multiple;
  /// Movement of the entry point of sunlight on the surface per unit of the path.
  Vec3<F> sun_entry;
  F mean_scatter_distance;  ///< mean distance along the path to the scattering
  F fresnel;
  Rgb<F> reflected;
  /// Shares of the mirrored light, whose sum is 1: r from the reflection, g from the picture
  /// itself, b from infinitely far (surroundings, sky, or a constant). Computed only for an AOV.
  Rgb<F> mirror_sources;
  Rgb<F> highlight;

  LIMPID_INLINE Rgb<F> beauty() const { return transmitted + in_scatter + reflected + highlight; }
};

/// Whether an eye depth means that no surface was hit.
template <class F>
LIMPID_INLINE auto nothing(F depth) {
  return depth > F(1e30);
}

}  // namespace limpid
