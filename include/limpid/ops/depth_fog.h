#pragma once
#include <optional>
#include <span>
#include <string_view>

#include "limpid/core/field.h"
#include "limpid/core/vec.h"
#include "limpid/optics/water_types.h"

namespace limpid {

/// Multiplies the light from below the surface by the transmittance of the path length d in the
/// water, and adds the light that the water scatters to the viewer.
///
/// d, by `distance`: `eye` is the difference of eye depths between the hit and this pixel's
/// surface, `ray` the same along the pixel's unrefracted ray, `refracted` the path length that
/// refraction found; without refraction that of a flat bottom, unrefracted length * cos_i / cos_t.
/// Never below 0, +inf where the ray ends in the sky. Views from under water take the straight ray,
/// to the surface or to the object in front of it, whatever `distance` is.
///
/// `linear` ("Realistic Water"): f = 1 - sat(density d - offset), c = lerp(color, u, f), out =
/// lerp(u, c, alpha). So transmitted light keeps the share 1 - alpha (1 - f), and in-scatter is
/// alpha (1 - f) color. Not physical: independent of sun and sky, and the same for all channels.
///
/// `beer_lambert`: with a `absorption`, b `scattering`, p Henyey-Greenstein's phase function, z the
/// depth under the calm surface, E the sun's irradiance of a surface that faces it (pi times its
/// color, so that a white Lambert surface shows that color), each per channel:
///
///     transmitted *= exp(-(a + b) d) exp(-K z / cos_sun) crossing
///     in_scatter = b ambient integral of exp(-(a + b) s)
///                + b p E' integral of exp(-(a + b) s) exp(-K z(s) / cos_sun), s = 0 ... d
///
/// `absorption` belongs to the `water_type` custom; setting it selects that type. All other types
/// have their own absorption. Likewise `murkiness` belongs to case_1, which has its own scattering,
/// too (optics/water_types.h). `sediment` and `cdom` add to any type: sediment scatters light back
/// and makes the water bright, cdom absorbs blue and makes it brown and dark. K is the attenuation
/// of light on its path down: that of the `water_type` if it has one, else a + b (1 - g), since
/// most light is scattered forwards. `sunlight` leaves this attenuation out (`none`: K = 0, E' =
/// E), or takes the sun's unrefracted ray (E' = E) or its refracted ray: E' = (1 - F) E cos_i /
/// cos_t, the light that the surface transmits into a wider beam. `crossing` applies the change of
/// radiance at the surface or not: (1
/// - F_sun) / n^2 for the bottom (0.0664 for F_sun when the sky alone lights it), 1 / n^2 for the
///   sun's in-scatter; (1 - F) of the view belongs to fresnel_reflection. `ambient` is radiance as
///   seen from the air, without loss. A view from under water crosses no surface, and objects that
///   it sees through the surface get no attenuated light. A sun at or below the horizon gives no
///   light. The model has single scattering only, so murky water is too dark.
///
/// `radiative_transfer`: multiple scattering, with reflection at bottom and surface. Of the
/// scattering b the narrow forward peak of p counts as unscattered (narrow_share()), for the path
/// to the viewer and for K; single scattering is as above, with that extinction. Beyond that, from
/// a level layer as deep as the end of the path (optics/scattered_light.h: A is the albedo of the
/// bottom, I its irradiance, G the share of its light that passes up, B the share that returns to
/// it), for views from the air:
///
///     in_scatter += sun's and sky's light scattered more than once, by depth, view and angle
///                 + A I G / (1 - A B), less what `transmitted` has of a level Lambert floor
///
/// If the frame has a shadow, light of the last term that reaches the viewer unscattered is that of
/// the point's own albedo, by its color and light in the dry picture; the rest is that of the
/// bottom around. What of the former came by sky and surface is added to `transmitted`. With
/// `crossing` radiance the surface reflects from below by Fresnel's equations. The sky's radiance
/// is that of the environment, else the scene's, else the visible sky's, else `ambient`; surfaces
/// that the picture shows hide a part of it and send their own light. Views from
/// under water have the light of water over one level floor, as deep and bright as the visible
/// bottom in the mean, and a bottom that is lit as that of the level layer: with a shadow each
/// point by its own albedo, in its mirror image, too. Its unscattered light is all in
/// `transmitted`. Without the tables of complete/ for a frame there is single scattering only.
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
    double anisotropy = 0.92;  // scatters 1.8 % backwards, as Petzold's ocean water does
    Rgb<double> ambient{0.1, 0.1, 0.1};
    Sunlight sunlight = Sunlight::kRefracted;
    Crossing crossing = Crossing::kRadiance;
    /// Not a parameter: the coefficients of water_type, murkiness, sediment and cdom for primaries
    /// other than Rec.709, set by the planner.
    std::optional<FittedWater> fitted = {};
  };

  static constexpr std::string_view kName = "depth_fog";
  static constexpr std::string_view kAbout = "Dims and tints light by its path in the water.";
  static std::span<const Field<Params>> fields();
};

}  // namespace limpid
