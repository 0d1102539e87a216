#pragma once
#include <span>
#include <string_view>

#include "limpid/core/field.h"
#include "limpid/core/vec.h"

namespace limpid {

/// Mirrors the surroundings: what comes through the surface keeps the share 1 - F, and F times the
/// mirrored light comes in.
///
/// F by `reflectance`, of the angle between the wave normal and the viewer: `rim` ("Realistic
/// Water"; exponent `power`), `linear` (Digiorgio 2024, of the calm normal), `inverse_power`
/// (Rito15 2021; `intensity`, `power`), `schlick` (with `f0`), `exact` (with water.ior). The
/// underside of the surface is mirrored exactly whatever is chosen, beyond the critical angle
/// totally: the other models are made for above. Seen from below, the water lies in front of the
/// surface: its own light is not dimmed, and what is mirrored is by `transmittance`.
///
/// Source `planar`: the frame's reflection planes, what a flat mirror at the calm surface shows.
/// `environment`: the frame's map of the surroundings, as far away as can be, where the mirrored
/// ray goes. `constant`: `color`. Rays that the waves mirror below the horizon (above it, seen from
/// below) see nothing of what the surroundings hold there: they are laid flat.
///
/// `auto`: the reflection planes, where the frame has them, the environment or `color` for what
/// they lack; else what the dry picture shows of the mirrored ray, marched over its depth
/// (op/mirror_search.h), and beyond that the environment, the sky planes, or `color`. Its `ray` is
/// marched over the depth of the mirrored scene, which is made where the plate has none
/// (complete/mirror_depth.h). A ray that meets nothing there ends infinitely far; should something
/// near stand at that place, 4 pixels or more from where the ray passes it, the lookup walks back
/// to the last place with nothing.
///
/// `facets` `spread` averages reflectance times mirrored light over the slopes that the pixel
/// cannot resolve (slope_variance), by three facets along the view (optics/facets.h); of a moved
/// surface over the slopes that are seen. One whose mirrored ray would go into the water is leaned
/// until the ray goes along it. A variance below 1e-4 is none. `mean`: the mean normal alone.
///
/// Where planar looks, by `lookup`: `offset` at uv + strength * tilt, clamped at the edge. `ray`:
/// where the mirrored ray ends in the mirrored scene, which is where the planes show it. How far
/// that is comes from the reflection's depth plane, read at the pixel and then three times where
/// the last guess landed; without one the mirrored scene is infinitely far. The surface is taken to
/// lie on the mirror. A ray that leaves the planes sees the last texel on its way.
///
/// Where the frame tells which texels of the reflection the mirror really saw (at least half), only
/// those count, and only their depths: what stands behind the cut at the surface is never shown. In
/// its place is the last valid one on the way from the pixel (op/valid_lookup.h); should there be
/// none, not even at the pixel, the environment; without one, black. The planes show the eye's side
/// of the surface. A camera half in the water sees a little of the other one, always at flat
/// angles: there, what comes through stands for what is mirrored.
struct FresnelReflection {
  enum class Reflectance { kRim, kLinear, kInversePower, kSchlick, kExact };
  enum class Source { kPlanar, kEnvironment, kConstant, kAuto };
  enum class Lookup { kOffset, kRay };
  enum class Facets { kMean, kSpread };
  struct Params {
    Reflectance reflectance = Reflectance::kExact;
    double power = 3;
    double intensity = 1;
    double f0 = 0.020373;
    Source source = Source::kPlanar;
    Lookup lookup = Lookup::kRay;
    Facets facets = Facets::kMean;
    double strength = 0.02;
    Rgb<double> color{0, 0, 0};
  };

  static constexpr std::string_view kName = "fresnel_reflection";
  static constexpr std::string_view kAbout = "Mixes in the mirrored surroundings by angle.";
  static std::span<const Field<Params>> fields();
};

}  // namespace limpid
