#pragma once
#include <span>
#include <string_view>

#include "limpid/core/field.h"

namespace limpid {

/// Finds the end of the refracted view ray under the water, and looks up the light from this point.
///
/// `normal_offset` ("Realistic Water"): uv' = uv + strength * tilt. No depth, no index of
/// refraction: calm water does not shift at all.
///
/// `dudv_offset` (Digiorgio 2024, "How to create Water shader in Monogame XNA"): uv' = uv - 0.001 /
/// z (1, 1) + strength * tilt, with z the surface's depth after projection (0 near ... 1 far). Made
/// for the model dudv of the waves, whose tilt is the distortion map. Kept as in the article: the
/// first term is an almost constant shift to the upper left, not a refraction that grows with
/// depth.
///
/// `snell`: from the surface point along the refracted ray (Heckbert 1989, "Writing a Ray Tracer"),
/// refracted at the wave's normal by water.ior, to the dry geometry in the depth plane. Its length:
/// with `steps` 0 to the depth of the bottom at the pixel itself; with k, refined k times by the
/// depth at the last estimate, and by a secant if the last two lead back and forth; with "march",
/// to where the ray passes behind the depth plane (McGuire & Mara 2014, "Efficient GPU Screen-Space
/// Ray Tracing", with equal steps on screen, then bisection). Objects far in front of the ray hide
/// the bottom and are not hit. A ray that reappears from behind such an object below the bottom
/// ends on the layer of the bottom in Pass, which continues the bottom behind objects; a ray
/// without a hit in the picture ends where 4 steps estimate. Thin objects under water hide only
/// points within `thickness` behind them. From below the ray is refracted outwards; where it is
/// totally reflected the surface transmits nothing and the lookup stays at the pixel.
///
/// A lookup must not show objects above the surface. `rejection` `none` accepts every lookup.
/// `snap` ("Realistic Water"): where the dry depth nearest to uv' is in front of this pixel's
/// surface, uv' goes back to uv and the prism is switched off. Its faults are kept: only the centre
/// of the three prism taps is tested, the color tap is bilinear but the depth tap nearest, and the
/// choice is hard (a halo). `shorten`: each texel of each channel is tested against the surface in
/// front of it (op/valid_lookup.h); along snell's rays an object under water far in front of their
/// end hides that end, too, and is rejected; rejected texels are replaced by the layer of the
/// bottom if that is deep enough, else by the last accepted texel along the ray. If the frame has a
/// layer below, that is looked up instead of the dry scene. It reaches the highest crest: `shorten`
/// rejects parts of it above the surface, `snap`, which tests this pixel's surface only, takes all
/// of it. No layer below is used where the view may start under water and look up into the air.
///
/// Where no surface was hit (a depth of +inf) no light comes back: the path is infinite, and the
/// pixel shows fog only, never the sky. A bilinear lookup ignores such empty texels; if they have
/// half of the weight, the lookup is empty, for all channels. For an empty texel of the layer below
/// this holds if the dry scene is empty, too; else an object is in front of it, and `snap` goes
/// back to the pixel itself, `shorten` back along the ray. Views from under water see the sky above
/// them as it is.
///
/// A ray that leaves the data window of the planes (overscan included) shows, by `off_frame`:
/// `clamp` the nearest texel of the edge, `shorten` the last texel along the ray, `fog` infinitely
/// deep water, faded in over a twentieth of the picture. `continue` extends the picture, for
/// snell's rays from the air: the bottom continues as a plane that the ray meets; the edge's color
/// continues along the perspective lines of the bottom, and fades into the mean color of the bottom
/// near that edge (op/continuation.h). In frames without such a plane, and with other models,
/// `continue` works as `shorten`.
///
/// `confidence` is the share of the lookup that is known: 0 where it was rejected, off frame or
/// empty. `path` is the length of the refracted ray in the water: with snell the ray's own length,
/// else that to the bottom found, taken as flat.
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
    /// Whether rays that end behind an object look up Frame::bottom_layer.
    bool uses_bottom_layer() const { return marches() && rejection == Rejection::kShorten; }
    /// Whether rays that leave the picture look up Frame::continuation.
    bool continues_bottom() const {
      return model == Model::kSnell && off_frame == OffFrame::kContinue;
    }
  };

  static constexpr std::string_view kName = "refraction";
  static constexpr std::string_view kAbout =
      "Looks up the dry picture where the refracted ray ends.";
  static std::span<const Field<Params>> fields();
};

}  // namespace limpid
