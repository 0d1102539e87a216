#pragma once
#include <span>
#include <string_view>

#include "limpid/core/field.h"
#include "limpid/core/vec.h"

namespace limpid {

/// Adds the reflected surroundings: multiplies the light from below the surface by 1 - F, and adds
/// F times the mirrored light.
///
/// F by `reflectance`, of the angle between the wave normal and the viewer: `rim` ("Realistic
/// Water"; exponent `power`), `linear` (Digiorgio 2024, of the calm normal), `inverse_power`
/// (Rito15 2021; `intensity`, `power`), `schlick` (with `f0`), `exact` (with water.ior). The
/// underside of the surface always has the exact reflectance, total beyond the critical angle: the
/// other models are for views from above. From below, the water is in front of the surface: its
/// in-scatter is not dimmed, and the mirrored light is multiplied by `transmittance`. Before that
/// the mirrored light passes through the water from the mirrored point to the surface: depth_fog
/// (unless `linear`) attenuates it and adds in-scatter by the length of that path, as for a view
/// that begins at the surface (op/water_medium.h). Light of the source `constant`, of a reflection
/// without a depth, and of the lookup `offset` stays as it is; the `color` of `auto` counts as
/// infinitely far.
///
/// Source `planar`: the frame's reflection planes, the view of a flat mirror at the calm surface.
/// `environment`: the frame's map of the infinitely far surroundings, along the mirrored ray.
/// `constant`: `color`. Rays that waves mirror below the horizon (above it, from below) would read
/// the wrong half of the surroundings: they are made horizontal.
///
/// `auto`: the reflection planes if the frame has them, with the environment or `color` where they
/// have no data; else the dry picture along the mirrored ray, marched over its depth
/// (op/mirror_search.h). Beyond that surfaces at its edge go on (op/edge_surfaces.h), before the
/// environment or the sky planes, which are computed (complete/sky.h) and go on to change with
/// elevation. If the picture shows no sky, these rays end in `color`; if that is 0, in the radiance
/// of the scene's sky, or else in a guess from the picture's brightness and the sun. Its `ray`
/// marches over the depth of the reflection, computed if missing (complete/mirror_depth.h).
/// A ray without a hit in that depth ends infinitely far. If the planes show a near object there, 4
/// pixels or more from where the ray passes the object, the ray takes what it meets in the dry
/// picture, else the last empty position; without one, and without an environment, the picture in
/// its direction. Past planes of a rendered depth a ray ends in the environment, if there is one,
/// unless a surface at their edge, behind the ray, may go on. From below, rays go down to the
/// bottom; a ray without a hit ends at the level of the bottom that the picture shows next to the
/// end of the ray.
///
/// `facets` `spread` averages reflectance times mirrored light over the slopes that the pixel does
/// not resolve (slope_variance), by three facets along the view (optics/facets.h); on a raised
/// surface over the visible slopes. A facet whose mirrored ray would go into the water is tilted
/// until the ray is parallel to it. A variance along the view below 1e-4 counts as none. Where
/// waves of known slopes raise the surface and rays are marched (`auto`), rays that rise less than
/// these slopes meet other waves, unless an object stands before them: these waves mirror a part of
/// them further up, and let light from the water pass instead of the rest (next_meeting() in
/// optics/facets.h). `mean`: the mean normal only.
///
/// The planar lookup, by `lookup`: `offset` at uv + strength * tilt, clamped at the edge. `ray`: at
/// the end of the mirrored ray in the mirrored scene, where the planes show it. Its distance comes
/// from the reflection's depth plane, read at the pixel and then three times at the last estimate;
/// without that plane the mirrored scene is infinitely far. The surface counts as the mirror plane.
/// A ray that leaves the planes shows the last texel along it, unless it ends in the environment
/// (`auto`).
///
/// If the frame has reflection_valid, only texels with at least half of it count, and only their
/// depths: geometry behind the clip at the surface is never shown. It is replaced by the last valid
/// texel along the ray from the pixel (op/valid_lookup.h). If not even the pixel is valid: by what
/// the picture shows (`ray` of `auto`), else by the environment; without one, by black. The planes
/// show the eye's side of the surface. A camera half in the water sees a little of the other side,
/// at grazing angles: there the dry picture (`auto`) or the transmitted light (`planar`) is shown.
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
  static constexpr std::string_view kAbout = "Blends in the reflection by the viewing angle.";
  static std::span<const Field<Params>> fields();
};

}  // namespace limpid
