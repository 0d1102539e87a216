#pragma once
#include <optional>
#include <span>
#include <string_view>

#include "limpid/core/field.h"
#include "limpid/core/vec.h"
#include "limpid/optics/water_types.h"

namespace limpid {

/// Dims what lies under the surface by the length d of the way through the water, and adds what the
/// water itself sends to the viewer.
///
/// d, by `distance`: `eye` is the difference of eye depths between the hit and this pixel's
/// surface, `ray` the same along the pixel's straight ray, `refracted` the way that refraction
/// found; without refraction that of a flat bottom, straight way * cos_i / cos_t. Never below 0,
/// +inf where the ray ends in the sky. Views that begin in the water go straight, to the surface or
/// to what stands before it, whatever `distance` says.
///
/// `linear` ("Realistic Water"): f = 1 - sat(density d - offset), c = lerp(color, u, f), out =
/// lerp(u, c, alpha). So transmitted keeps the share 1 - alpha (1 - f), and alpha (1 - f) color
/// comes in. Not physical: no light, one number for all channels.
///
/// `beer_lambert`: with a `absorption`, b `scattering`, p Henyey-Greenstein's phase function, z the
/// depth under the calm surface, E what the sun sends onto a surface that faces it (pi times its
/// color, so that a white Lambert one shows that color), each per channel:
///
///     transmitted *= exp(-(a + b) d) exp(-K z / cos_sun) crossing
///     in_scatter = b ambient integral of exp(-(a + b) s)
///                + b p E' integral of exp(-(a + b) s) exp(-K z(s) / cos_sun), s = 0 ... d
///
/// `absorption` is that of the `water_type` custom; to set it is to mean that one, and a type that
/// is named afterwards has its own. Likewise `murkiness` is that of case_1, which has a scattering
/// of its own, too (optics/water_types.h). To any of them `sediment` and `cdom` are added: the one
/// throws light back and makes the water bright, the other takes blue and makes it brown and dark.
/// K is the loss of light on its way down: that of the `water_type` if it has one, else a + b (1 -
/// g), for what is scattered goes on forwards, mostly.
/// By `sunlight` this way is not made (`none`: K = 0, E' = E), or made along the sun's straight ray
/// (E' = E), or along its refracted one: E' = (1 - F) E cos_i / cos_t, what the surface lets in, in
/// a wider beam. By `crossing` the change of radiance at the surface is made or not: (1 - F_sun) /
/// n^2 for the bottom (0.0664 for F_sun when the sky alone lights it), 1 / n^2 for the sun's
/// in-scatter; (1 - F) of the view is fresnel_reflection's. `ambient` is radiance as the viewer in
/// the air sees it and loses nothing. A view that begins in the water crosses nothing, and what it
/// sees through the surface from below is not lit through water. A sun at the horizon or under it
/// counts as none. Light is scattered once: murky water comes out too dark.
///
/// `radiative_transfer`: light is scattered as often as it may be, and what bottom and surface
/// throw back goes on. Of the scattering b the narrow peak of p counts as not scattered
/// (narrow_share()), for the way to the viewer and for K alike; scattered once it is as above, with
/// that extinction. Beyond that, from the layer that is as deep as the end of the way
/// (optics/scattered_light.h: A is the albedo of the bottom, I what lights it, G the share of its
/// light that passes up, B the share that comes back to it), for views from the air:
///
///     in_scatter += sun's and sky's light scattered more than once, by depth, view and angle
///                 + A I G / (1 - A B), less what `transmitted` has of a level Lambert floor
///
/// With `crossing` radiance the surface reflects from below what Fresnel's equations say. The sky's
/// radiance is that of the environment, else the scene's, else `ambient`. Views that begin in the
/// water take it as endlessly deep. Without what complete/ makes for a frame light is scattered
/// once.
struct DepthFog {
  enum class Model { kLinear, kBeerLambert, kRadiativeTransfer };
  enum class Distance { kEye, kRay, kRefracted };
  enum class Sunlight { kNone, kStraight, kRefracted };
  enum class Crossing { kNone, kRadiance };
  struct Params {
    Model model = Model::kBeerLambert;
    Distance distance = Distance::kRefracted;
    double density = 0.15;
    double offset = 0;
    Rgb<double> color{0.02, 0.10, 0.12};
    double alpha = 0.9;
    Rgb<double> absorption = kPureWaterAbsorption;
    Rgb<double> scattering{0.10, 0.12, 0.14};
    WaterType water_type = WaterType::kJerlovII;
    double murkiness = 0.5;
    double sediment = 0;
    double cdom = 0;
    double anisotropy = 0.92;  // 1.8 % is thrown back, as by Petzold's ocean water
    Rgb<double> ambient{0.1, 0.1, 0.1};
    Sunlight sunlight = Sunlight::kRefracted;
    Crossing crossing = Crossing::kRadiance;
    /// No parameter: where red, green and blue are not those of Rec.709, what water_type,
    /// murkiness, sediment and cdom are for them. The planner makes it.
    std::optional<FittedWater> fitted = {};
  };

  static constexpr std::string_view kName = "depth_fog";
  static constexpr std::string_view kAbout = "Dims and tints by the way through the water.";
  static std::span<const Field<Params>> fields();
};

}  // namespace limpid
