#pragma once
#include "limpid/op/operator.h"
#include "limpid/op/screen_ray.h"
#include "limpid/op/valid_lookup.h"
#include "limpid/optics/fresnel.h"
#include "limpid/optics/refract.h"
#include "limpid/optics/surroundings.h"

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
  enum class Source { kPlanar, kEnvironment, kConstant };
  enum class Lookup { kOffset, kRay };
  struct Params {
    Reflectance reflectance = Reflectance::kExact;
    double power = 3;
    double intensity = 1;
    double f0 = 0.020373;
    Source source = Source::kPlanar;
    Lookup lookup = Lookup::kRay;
    double strength = 0.02;
    Rgb<double> color{0, 0, 0};
  };

  static constexpr std::string_view kName = "fresnel_reflection";
  static constexpr std::string_view kAbout = "Mixes in the mirrored surroundings by angle.";
  static constexpr StateSet kUses{StatePart::kNormal, StatePart::kTransmittance,
                                  StatePart::kTransmitted, StatePart::kInScatter};
  static constexpr StateSet kMakes{StatePart::kFresnel, StatePart::kReflected,
                                   StatePart::kTransmitted, StatePart::kInScatter};
  static std::span<const Field<Params>> fields();
  static PlaneSet reads(const Params& p) {
    if (p.source != Source::kPlanar) return {};
    const PlaneSet seen = kReflectionPlanes | PlaneSet{PlaneId::kReflectionValid};
    return p.lookup == Lookup::kRay ? seen | PlaneSet{PlaneId::kReflectionDepth} : seen;
  }
  static Needs needs(const Params& p) {
    return {.planes = p.source == Source::kPlanar ? kReflectionPlanes : PlaneSet{},
            .environment = p.source == Source::kEnvironment};
  }
  static double reach(const Params& p) {
    if (p.source != Source::kPlanar) return 0;
    return p.lookup == Lookup::kRay ? HUGE_VAL : abs(p.strength);
  }
  static bool neutral(const Params&, StateSet) { return false; }
  static double bound(const Params& params, const Context& c, const Ranges& ranges);
  static void reckon(const Params& params, const Context& c, Ranges& ranges);

  template <class Strip>
  static void apply(const Params& params, const Context& c, Strip& strip) {
    using F = typename Strip::Number;
    strip.each([&](Pixel<F>& p) { p.fresnel = reflectance(params, c, p); });
    switch (params.source) {
      case Source::kPlanar:
        return mirror_planes(params, c, strip);
      case Source::kEnvironment:
        return strip.probe(
            [&](Pixel<F>& p, const auto& tap) { blend(c, surroundings(c, p, tap), p); });
      case Source::kConstant: {
        const Rgb<F> color{F(params.color.r), F(params.color.g), F(params.color.b)};
        return strip.each([&](Pixel<F>& p) { blend(c, color, p); });
      }
    }
  }

 private:
  template <class F>
  static LIMPID_INLINE F from_above(const Params& params, const Context& c, const Pixel<F>& p) {
    const F cosine = dot(p.to_viewer, p.normal);
    switch (params.reflectance) {
      case Reflectance::kRim:
        return fresnel_rim(cosine, params.power);
      case Reflectance::kLinear:
        return fresnel_linear(dot(p.to_viewer, vec3_of<F>(c.up)));
      case Reflectance::kInversePower:
        return fresnel_inverse_power(cosine, F(params.intensity), params.power);
      case Reflectance::kSchlick:
        return fresnel_schlick(cosine, F(params.f0));
      case Reflectance::kExact:
        break;
    }
    return fresnel_exact(cosine, F(c.ior));
  }

  template <class F>
  static LIMPID_INLINE F reflectance(const Params& params, const Context& c, const Pixel<F>& p) {
    const F above = from_above(params, c, p);
    if (!c.submersible) return above;
    const F below = fresnel_exact(F(0) - dot(p.to_viewer, p.normal), F(1 / c.ior));
    return select(p.side > F(0), above, select(p.side < F(0), below, F(0)));
  }

  template <class F>
  static LIMPID_INLINE void blend(const Context& c, Rgb<F> mirrored, Pixel<F>& p) {
    const F through = F(1) - p.fresnel;
    p.transmitted = through * p.transmitted;
    p.reflected = p.fresnel * mirrored;
    const Rgb<F> dimmed = through * p.in_scatter;
    if (!c.submersible) {
      p.in_scatter = dimmed;
      return;
    }
    const auto below = p.side < F(0);
    p.in_scatter = select(below, p.in_scatter, dimmed);
    p.reflected = select(below, p.transmittance * p.reflected, p.reflected);
  }

  /// The mirrored ray, unit, on the viewer's side of the surface.
  template <class F>
  static LIMPID_INLINE Vec3<F> mirrored_ray(const Context& c, const Pixel<F>& p) {
    const Vec3<F> up = vec3_of<F>(c.up), ray = mirror(p.to_viewer, p.normal);
    return c.submersible ? lifted(ray, select(p.side < F(0), F(-1) * up, up)) : lifted(ray, up);
  }

  template <class F, class Tap>
  static LIMPID_INLINE Rgb<F> surroundings(const Context& c, const Pixel<F>& p, const Tap& tap) {
    const Vec3<F> ray = mirrored_ray(c, p);
    return tap.lat_long_rgb(c.environment,
                            lat_long(dot(vec3_of<F>(c.map_x), ray), dot(vec3_of<F>(c.map_y), ray),
                                     dot(vec3_of<F>(c.up), ray)));
  }

  // --- the reflection planes --------------------------------------------------------------------

  template <class Strip>
  static void mirror_planes(const Params& params, const Context& c, Strip& strip) {
    using F = typename Strip::Number;
    const F strength(params.strength);
    const bool ray = params.lookup == Lookup::kRay;
    const bool depths = ray && c.planes.has(PlaneId::kReflectionDepth);
    if (!depths && !c.planes.has(PlaneId::kReflectionValid) && !c.submersible) {
      return strip.bilinear_rgb(
          PlaneId::kReflectionR,
          [&](const Pixel<F>& p) {
            return ray ? place_at(c, p, image_ray(c, p), F(HUGE_VAL)) : strength * p.tilt;
          },
          [&](Pixel<F>& p, Rgb<F> mirrored) { blend(c, mirrored, p); });
    }
    strip.probe([&](Pixel<F>& p, const auto& tap) {
      const Vec2<F> shift = ray ? follow(c, p, tap, depths) : strength * p.tilt;
      blend(c, seen_at(c, p, tap, shift), p);
    });
  }

  /// The mirrored ray as the planes show it: in the mirrored scene it goes down into the mirror.
  template <class F>
  static LIMPID_INLINE ScreenRay<F> image_ray(const Context& c, const Pixel<F>& p) {
    const Vec3<F> up = vec3_of<F>(c.up), ray = mirrored_ray(c, p);
    return ScreenRay<F>(c, p, ray - (F(2) * dot(up, ray)) * up);
  }

  /// The shift at s scene units along the ray, or at the planes' edge before that.
  template <class F>
  static LIMPID_INLINE Vec2<F> place_at(const Context& c, const Pixel<F>& p,
                                        const ScreenRay<F>& ray, F s) {
    const Vec2<F> shift = ray.shift_at(s);
    return min(reach_in(c.reflection, p.uv, shift), F(1)) * shift;
  }

  /// Where the mirrored ray ends.
  template <class F, class Tap>
  static Vec2<F> follow(const Context& c, const Pixel<F>& p, const Tap& tap, bool depths) {
    const ScreenRay<F> ray = image_ray(c, p);
    F way(HUGE_VAL);
    if (!depths) return place_at(c, p, ray, way);
    constexpr int kSteps = 3;
    way = distance_to(c, p, tap, Vec2<F>{F(0), F(0)}, way);
    for (int i = 0; i < kSteps; ++i) way = distance_to(c, p, tap, place_at(c, p, ray, way), way);
    return place_at(c, p, ray, way);
  }

  /// From the surface point to what the planes show at `shift`; `otherwise` where that is not
  /// valid. Depths are mixed as 1 / depth, which is even across a plane and finite beside the sky.
  template <class F, class Tap>
  static F distance_to(const Context& c, const Pixel<F>& p, const Tap& tap, Vec2<F> shift,
                       F otherwise) {
    const auto quad = tap.quad(shift);
    const Four<F> counts = valid<F>(c, tap, quad);
    const Four<F> depths = tap.read(PlaneId::kReflectionDepth, quad);
    F inverse = F(0), weight = F(0);
    for (int k = 0; k < 4; ++k) {
      const F share = quad.weight(k) * counts[k];
      inverse = inverse + share / max(depths[k], F(1e-6));
      weight = weight + share;
    }
    const auto seen = weight > F(1e-3);
    return select(seen, length(way_to(c, p, shift, weight / max(inverse, F(1e-30)))), otherwise);
  }

  template <class F, class Tap, class Quad>
  static LIMPID_INLINE Four<F> valid(const Context& c, const Tap& tap, const Quad& quad) {
    if (!c.planes.has(PlaneId::kReflectionValid)) return {F(1), F(1), F(1), F(1)};
    Four<F> seen = tap.read(PlaneId::kReflectionValid, quad);
    for (F& share : seen.at) share = select(share >= F(0.5), F(1), F(0));
    return seen;
  }

  template <class F, class Tap>
  static Rgb<F> seen_at(const Context& c, const Pixel<F>& p, const Tap& tap, Vec2<F> shift) {
    const auto taps =
        valid_taps(tap, shift, [&](const auto& quad) { return valid<F>(c, tap, quad); });
    Rgb<F> seen{taps.read(tap, PlaneId::kReflectionR), taps.read(tap, PlaneId::kReflectionG),
                taps.read(tap, PlaneId::kReflectionB)};
    F lacks = taps.some_made_up ? F(1) - taps.weight() : F(0);
    if (c.submersible) {
      const auto other_side = p.side * F(c.eye_above) < F(0);
      seen = select(other_side, p.transmitted, seen);
      lacks = select(other_side, F(0), lacks);
    }
    const auto lacking = lacks > F(1e-5);
    if (!c.environment || !any(lacking)) return seen;
    return seen + select(lacking, lacks, F(0)) * surroundings(c, p, tap);
  }
};

}  // namespace limpid
