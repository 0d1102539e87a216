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
  /// Of the slopes along WaterView::map_x and map_y around those of `normal`: what waves too small
  /// for the pixel do to it. Begins as 0.
  Sym2<F> slope_variance;
  Vec2<F> prism_r, prism_g, prism_b;  ///< shift of each channel beyond `shift`; begin as 0
  Rgb<F> dispersion;  ///< index of refraction of each channel, beyond the common one; begins as 0

  Vec2<F> shift;                      ///< where the refracted ray ends; begins as 0
  Vec2<F> shift_r, shift_g, shift_b;  ///< where each channel is looked up in the end; begin as 0
  F hit_depth;                        ///< dry eye depth at `shift`; begins as dry_depth
  F path;                ///< scene units, >= 0, +inf where the ray meets nothing; begins as 0
  F confidence;          ///< begins as 1; as 0 where water without a bottom begins
  Rgb<F> transmittance;  ///< begins as 1

  /// Begins as the dry color at this pixel; as 0 where nothing was hit and no surface lies between
  /// that and water: what is seen there is the water itself.
  Rgb<F> transmitted;
  Rgb<F> in_scatter;  ///< begins as 0, as do all below
  /// Parts of in_scatter that the sun lights: the first in the shadow of the surface point, the
  /// second in that of the point where the ray ends.
  Rgb<F> sun_near, sun_far;
  /// Of in_scatter, too: what of the sun was scattered more than once, or came from the bottom.
  Rgb<F> sun_multiple;
  /// How the place on the surface at which sunlight enters moves with a unit of the way.
  Vec3<F> sun_entry;
  F mean_scatter_distance;  ///< after which it is scattered once on average, of the way
  F fresnel;
  Rgb<F> reflected;
  /// Shares of what is mirrored, whose sum is 1: r from the reflection, g from the picture itself,
  /// b from what is infinitely far (surroundings, sky, or a constant). Made for an AOV alone.
  Rgb<F> mirror_sources;
  Rgb<F> highlight;

  LIMPID_INLINE Rgb<F> beauty() const { return transmitted + in_scatter + reflected + highlight; }
};

/// Whether an eye depth says that nothing was hit.
template <class F>
LIMPID_INLINE auto nothing(F depth) {
  return depth > F(1e30);
}

}  // namespace limpid
