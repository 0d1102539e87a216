#pragma once
#include <span>
#include <string_view>

#include "limpid/core/field.h"

namespace limpid {

/// Where the view ray ends under the water, and the light that comes from there.
///
/// `normal_offset` ("Realistic Water"): uv' = uv + strength * tilt. No depth, no index of
/// refraction: calm water does not shift at all.
///
/// `dudv_offset` (Digiorgio 2024, "How to create Water shader in Monogame XNA"): uv' = uv - 0.001 /
/// z (1, 1) + strength * tilt, with z the surface's depth after projection (0 near ... 1 far).
/// Meant for the model dudv of the waves, whose tilt is the distortion map. Kept as the article has
/// it: the first term is an almost constant shift to the upper left, not a bend that grows with
/// depth.
///
/// `snell`: from the surface point along the refracted ray (Heckbert 1989, "Writing a Ray Tracer"),
/// bent at the wave's normal by water.ior, to the dry geometry that the depth plane shows. How far:
/// with `steps` 0 as deep as the bottom at the pixel itself; with k, k times as deep as the bottom
/// that the last guess has found; with "march", to where the ray passes behind the depth plane
/// (McGuire & Mara 2014, "Efficient GPU Screen-Space Ray Tracing", with equal steps on screen, then
/// bisection). What lies far before the ray hides the bottom and is not hit. A ray that comes out
/// from behind it under the bottom ends where the layer of the bottom does that Pass has, drawn
/// on behind what stands before it; one that meets nothing in the picture where 4 steps guess. What
/// is thin under water hides no more than what lies within its `thickness` behind it. From below
/// the ray is bent outwards; where it is totally reflected nothing is transmitted by the surface
/// and the lookup stays at the pixel.
///
/// What lies above the surface must not be seen through it. `rejection` `none` takes what is there.
/// `snap` ("Realistic Water"): where the dry depth nearest to uv' is in front of this pixel's
/// surface, uv' goes back to uv and the prism is switched off. Its faults are kept: only the centre
/// of the three prism taps is tested, the color tap is bilinear where the depth tap is nearest, and
/// the choice is hard (a halo). `shorten`: each texel of each channel is tested against the surface
/// in front of it (op/valid_lookup.h); along snell's rays what stands under water far before their
/// end hides that, too, and does not count; what is missing is then of the layer of the bottom,
/// where that lies deep enough, else of the last texel on the way there that counts. Where the
/// frame has a layer below, that is looked up instead of the dry scene. It reaches the highest
/// crest: `shorten` rejects what of it stands above the surface, `snap`, which asks for this
/// pixel's surface alone, takes all of it. Not so where the view may begin in the water, from where
/// one looks up into the air as well.
///
/// Where nothing was hit (a depth of +inf) no light comes from: the water there has no end, and
/// what is seen is the fog of an endless way, never the sky. A texel of that kind does not count
/// when four are mixed; where half of the weight is such, nothing is there, for all channels. Of an
/// empty place of the layer below this holds where the dry scene is empty, too; elsewhere something
/// stands before it, and `snap` goes back to the pixel itself, `shorten` along the way. The sky
/// over a view that begins in the water is seen as it is.
///
/// A ray that leaves the data window of the planes (overscan included) sees, by `off_frame`:
/// `clamp` the nearest texel of the edge, `shorten` the last texel on its way, `fog` water without
/// end, faded in over a twentieth of the picture. `continue` draws the picture on, for snell's rays
/// from the air: the bottom goes on as a plane, which the ray meets; what the edge shows goes on
/// along the lines of the bottom, in their perspective, and fades into the color of the bottom near
/// there (op/continuation.h). Where frames have no such plane, and with other models, it is
/// `shorten`.
///
/// `confidence` is the share of the lookup that is real: 0 for what was rejected or is off frame,
/// and where nothing is there. `path` is the refracted way through the water: with snell the ray's
/// own, else that of the bottom found, taken for flat.
struct Refraction {
  enum class Model { kNormalOffset, kDudvOffset, kSnell };
  enum class Rejection { kNone, kSnap, kShorten };
  enum class OffFrame { kClamp, kShorten, kFog, kContinue };
  static constexpr int kMarch = -1;  ///< a value of steps
  struct Params {
    Model model = Model::kSnell;
    double strength = 0.03;
    Rejection rejection = Rejection::kShorten;
    int steps = kMarch;
    OffFrame off_frame = OffFrame::kContinue;
    double thickness = 0;

    bool marches() const { return model == Model::kSnell && steps == kMarch; }
    /// Whether rays that end behind something see Frame::bottom_layer.
    bool looks_behind() const { return marches() && rejection == Rejection::kShorten; }
    /// Whether rays that leave the picture see Frame::continuation.
    bool goes_on() const { return model == Model::kSnell && off_frame == OffFrame::kContinue; }
  };

  static constexpr std::string_view kName = "refraction";
  static constexpr std::string_view kAbout =
      "Looks up the dry picture where the refracted ray ends.";
  static std::span<const Field<Params>> fields();
};

}  // namespace limpid
