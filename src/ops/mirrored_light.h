#pragma once
#include <optional>

#include "limpid/ops/fresnel_reflection.h"

#include "op/bilinear.h"
#include "op/mirror_search.h"
#include "op/operator.h"
#include "op/screen_ray.h"
#include "op/valid_lookup.h"
#include "op/water_medium.h"
#include "optics/refract.h"
#include "optics/surroundings.h"

/// @file
/// The light that a facet of the surface mirrors: from the reflection planes, the dry picture, the
/// surroundings or a constant. ops/fresnel_reflection_kernel.h chooses the facets and blends it.

namespace limpid {

struct MirroredLight : FresnelReflection {
  /// Light, and its source: Pixel::mirror_sources.
  template <class F>
  struct Mirrored {
    Rgb<F> light, sources;
  };
  template <class F>
  static LIMPID_INLINE Rgb<F> from_reflection() {
    return {F(1), F(0), F(0)};
  }
  template <class F>
  static LIMPID_INLINE Rgb<F> from_picture() {
    return {F(0), F(1), F(0)};
  }
  template <class F>
  static LIMPID_INLINE Rgb<F> from_far() {
    return {F(0), F(0), F(1)};
  }

  /// The depth plane over which mirrored rays march, or none.
  static std::optional<PlaneId> marched(const Params& params, const Pass& c) {
    if (params.source != Source::kAuto) return {};
    if (!reads_planes(params, c)) return PlaneId::kDepth;
    const bool follows = params.lookup == Lookup::kRay && c.planes.has(PlaneId::kReflectionDepth);
    if (!follows || c.submersible) return {};
    return PlaneId::kReflectionDepth;
  }

  template <class F>
  static LIMPID_INLINE Rgb<F> constant(const Params& params) {
    return {given<F>(params.color.r), given<F>(params.color.g), given<F>(params.color.b)};
  }

  static bool reads_planes(const Params& params, const Pass& c) {
    return params.source == Source::kPlanar ||
           (params.source == Source::kAuto && c.planes.covers(kReflectionPlanes));
  }
  /// Whether the place of the lookup is known without another lookup.
  static bool looks_once(const Params& params, const Pass& c) {
    const bool depths = params.lookup == Lookup::kRay && c.planes.has(PlaneId::kReflectionDepth);
    return reads_planes(params, c) && !depths && !c.planes.has(PlaneId::kReflectionValid) &&
           !c.submersible;
  }

  /// Light mirrored by the facet n, whose tilt is that of the operator wave_normals.
  template <class F, class Tap>
  static Mirrored<F> mirrored(const Params& params, const Pass& c, const Pixel<F>& p,
                              const Tap& tap, Vec3<F> n, Vec2<F> tilt) {
    if (params.source == Source::kConstant) return {constant<F>(params), from_far<F>()};
    if (params.source == Source::kEnvironment) return {surroundings(c, p, tap, n), from_far<F>()};
    if (marched(params, c)) return seen_on_march(params, c, p, tap, n, F(1), n);
    Mirrored<F> seen = params.lookup == Lookup::kRay
                           ? seen_at(c, p, tap, n, follow(c, p, tap, n))
                           : seen_at(c, p, tap, n, {given<F>(params.strength) * tilt, F(HUGE_VAL)});
    if (c.submersible) {
      const auto other_side = p.side * given<F>(c.eye_above) < F(0);
      if_any(other_side, [&] {
        const Mirrored<F> other = params.source == Source::kAuto
                                      ? seen_in_picture(params, c, p, tap, n, F(1), n)
                                      : Mirrored<F>{p.transmitted, from_picture<F>()};
        seen = {select(other_side, other.light, seen.light),
                select(other_side, other.sources, seen.sources)};
      });
    }
    return seen;
  }

  /// By a march over a depth plane, of the facets n: the share `part` of them may meet something,
  /// on the ray of the facet `low`. `thicker`: factor on the thickness of the picture's surfaces,
  /// not of a reflection's.
  template <class F, class Tap>
  static Mirrored<F> seen_on_march(const Params& params, const Pass& c, const Pixel<F>& p,
                                   const Tap& tap, Vec3<F> n, F part, Vec3<F> low,
                                   F thicker = F(1)) {
    return reads_planes(params, c) ? seen_in_image(c, p, tap, n, part, low)
                                   : seen_in_picture(params, c, p, tap, n, part, low, thicker);
  }

  /// The mirrored ray, unit, on the viewer's side of the surface.
  template <class F>
  static LIMPID_INLINE Vec3<F> mirrored_ray(const Pass& c, const Pixel<F>& p, Vec3<F> n) {
    const Vec3<F> up = vec3_of<F>(c.up), ray = mirror(p.to_viewer, n);
    return c.submersible ? lifted(ray, select(p.side < F(0), F(-1) * up, up)) : lifted(ray, up);
  }

  template <class F, class Tap>
  static LIMPID_INLINE Rgb<F> surroundings(const Pass& c, const Pixel<F>& p, const Tap& tap,
                                           Vec3<F> n) {
    const Vec3<F> ray = mirrored_ray(c, p, n);
    const Rgb<F> far = tap.lat_long_rgb(
        c.environment, lat_long(dot(vec3_of<F>(c.map_x), ray), dot(vec3_of<F>(c.map_y), ray),
                                dot(vec3_of<F>(c.up), ray)));
    return through_water<false>(c, p, tap, ray, F(HUGE_VAL), far, {F(0), F(0)});
  }

  // --- seen from within the water ---------------------------------------------------------------

  /// The light that the underside of the surface mirrors, after its path of length `distance`
  /// through the water to the surface: for pixels seen from within the water. `distance` may be
  /// infinite. `kEnds`: whether the path ends at a surface, whose albedo lies at the shift `at`.
  template <bool kEnds = true, class F, class Tap>
  static LIMPID_INLINE Rgb<F> through_water(const Pass& c, const Pixel<F>& p, const Tap& tap,
                                            const Vec3<F>& ray, F distance, Rgb<F> light,
                                            Vec2<F> at) {
    if (!c.medium) return light;
    const auto below = p.side < F(0);
    if_any(below, [&] {
      light = select(
          below,
          through_water_below<kEnds>(c, p, tap, ray, select(below, distance, F(0)), light, at),
          light);
    });
    return light;
  }
  template <bool kEnds, class F, class Tap>
  [[gnu::noinline]] static Rgb<F> through_water_below(const Pass& c, const Pixel<F>& p,
                                                      const Tap& tap, const Vec3<F>& ray,
                                                      F distance, Rgb<F> light, Vec2<F> at) {
    const Vec3<F> up = vec3_of<F>(c.up);
    const F height = given<F>(c.eye_above) + dot(up, p.surface_point);
    const F begin = max(F(0) - height, F(0)), sink = max(F(0) - dot(up, ray), F(0));
    const F length = min(distance, F(3e38));
    Rgb<F> albedo{F(0), F(0), F(0)}, detail{F(1), F(1), F(1)};
    if (kEnds && c.medium->multiple && c.planes.covers(kAlbedoPlanes)) {
      albedo = bilinear_rgb<F>(tap, PlaneId::kAlbedoR, at);
      if (c.planes.has(PlaneId::kShadow)) {
        // The shadow is that of the path's end if the picture shows that. Along grazing rays depth
        // changes much from one texel to the next.
        const F end = min(ScreenRay<F>(c, p, ray).depth_at(distance), F(1e30));
        const F off = abs(bilinear_depth<F>(tap, PlaneId::kDepth, tap.quad(at)) - end);
        const F known = saturate(F(2) - off / (F(0.1) * max(end, F(1e-6))));
        const F lit = bilinear<F>(tap, PlaneId::kShadow, at);
        const Rgb<F> dry = bilinear_rgb<F>(tap, PlaneId::kColorR, at);  // `light` may be focused
        detail = {albedo_detail(*c.medium, 0, dry.r, lit, albedo.r, known),
                  albedo_detail(*c.medium, 1, dry.g, lit, albedo.g, known),
                  albedo_detail(*c.medium, 2, dry.b, lit, albedo.b, known)};
      }
    }
    return seen_in_water(*c.medium, WaterPath<F>{length, sink, begin, begin + sink * length}, ray,
                         light, albedo, detail);
  }

  /// The place of the picture next to `shift`.
  template <class F>
  static LIMPID_INLINE Vec2<F> next_to(const Pass& c, const Pixel<F>& p, Vec2<F> shift) {
    return {min(max(shift.x, given<F>(c.dry.low.x) - p.uv.x), given<F>(c.dry.high.x) - p.uv.x),
            min(max(shift.y, given<F>(c.dry.low.y) - p.uv.y), given<F>(c.dry.high.y) - p.uv.y)};
  }

  /// The dry picture along a ray that is mirrored down in the water. Where the ray meets no visible
  /// surface, the level of the surface visible next to its end continues.
  template <class F, class Tap>
  [[gnu::noinline]] static Mirrored<F> seen_below(const Pass& c, const Pixel<F>& p, const Tap& tap,
                                                  Vec3<F> n, const ScreenRay<F>& ray, F met,
                                                  Rgb<F> beyond) {
    constexpr int kGuesses = 3;
    const Vec3<F> up = vec3_of<F>(c.up), direction = mirrored_ray(c, p, n);
    const F top = given<F>(c.eye_above) + dot(up, p.surface_point);
    const F fall = max(F(0) - dot(up, direction), F(0.02));
    const auto unseen = !(met < F(1e20));
    F distance = met;
    if_any(unseen, [&] {
      repeat<F>(kGuesses, [&] {
        const Vec2<F> at = next_to(c, p, ray.shift_at(distance));
        const F depth = tap.nearest(PlaneId::kDepth, at);
        const F drop = top - height_at(c, p, at, depth);
        distance = select(unseen && drop > F(0) && depth < F(1e30), drop / fall, distance);
      });
    });
    const Vec2<F> at = next_to(c, p, ray.shift_at(distance));
    const Rgb<F> shown = through_water(c, p, tap, direction, distance,
                                       bilinear_rgb<F>(tap, PlaneId::kColorR, at), at);
    const auto ends = distance < F(1e20);
    return {select(ends, shown, beyond),
            {F(0), select(ends, F(1), F(0)), select(ends, F(0), F(1))}};
  }

  // --- the reflection planes --------------------------------------------------------------------

  /// The mirrored ray in the reflection planes: in the mirrored scene it goes down into the mirror.
  template <class F>
  static LIMPID_INLINE ScreenRay<F> image_ray(const Pass& c, const Pixel<F>& p, Vec3<F> n) {
    const Vec3<F> up = vec3_of<F>(c.up), ray = mirrored_ray(c, p, n);
    return ScreenRay<F>(c, p, ray - (F(2) * dot(up, ray)) * up);
  }

  /// The shift at s scene units along the ray, or at the edge of the planes before that.
  template <class F>
  static LIMPID_INLINE Vec2<F> place_at(const Pass& c, const Pixel<F>& p, const ScreenRay<F>& ray,
                                        F s) {
    return kept_in(c.reflection, p, ray, s);
  }
  template <class F>
  static LIMPID_INLINE Vec2<F> kept_in(const Bounds& bounds, const Pixel<F>& p,
                                       const ScreenRay<F>& ray, F s) {
    const Vec2<F> shift = ray.shift_at(s);
    return min(reach_in(bounds, p.uv, shift), F(1)) * shift;
  }

  /// A place of the planes and its distance, +inf where there is no surface or none is known.
  template <class F>
  struct End {
    Vec2<F> shift;
    F distance;
  };

  /// Where the mirrored ray ends. With views that may begin in the water it is not marched: beside
  /// the water's level a march over flat rays is decided by roundings.
  template <class F, class Tap>
  static End<F> follow(const Pass& c, const Pixel<F>& p, const Tap& tap, Vec3<F> n) {
    const ScreenRay<F> ray = image_ray(c, p, n);
    F distance(HUGE_VAL);
    if (!c.planes.has(PlaneId::kReflectionDepth)) return {place_at(c, p, ray, distance), distance};
    constexpr int kSteps = 3;
    distance = distance_to(c, p, tap, Vec2<F>{F(0), F(0)}, distance);
    repeat<F>(kSteps,
              [&] { distance = distance_to(c, p, tap, place_at(c, p, ray, distance), distance); });
    return {place_at(c, p, ray, distance), distance};
  }

  /// Distance from the surface point to the surface that the planes show at `shift`; `otherwise`
  /// where the texels there are not valid. Depths are mixed as 1 / depth, which is linear across a
  /// plane and finite beside the sky.
  template <class F, class Tap>
  static F distance_to(const Pass& c, const Pixel<F>& p, const Tap& tap, Vec2<F> shift,
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
    return select(seen, length(offset_to(c, p, shift, weight / max(inverse, F(1e-30)))), otherwise);
  }

  /// What the planes show by a march in the depth of the mirrored scene.
  template <class F, class Tap>
  static Mirrored<F> seen_in_image(const Pass& c, const Pixel<F>& p, const Tap& tap, Vec3<F> n,
                                   F part, Vec3<F> low) {
    Vec2<F> met{F(0), F(0)};
    F hit(0);
    const auto meets = part > F(0);
    if_any(meets, [&] {
      const ScreenRay<F> ray = image_ray(c, p, low);
      // A ray away from the viewer meets nothing that stands before the pixel's water.
      const auto ahead = [&](Vec2<F>, F depth) {
        return depth > F(0) && (depth > F(kAhead) * ray.depth || ray.depth_step < F(0));
      };
      const auto found =
          MirrorSearch<F, Tap>::march(c, tap, tap.wet() && meets, PlaneId::kReflectionDepth,
                                      c.reflection, p, ray, kImageSteps, ahead);
      hit = select(meets, part * found.hit, hit);
      met = found.shift;
    });
    const auto whole = hit >= F(1), parted = hit > F(0) && !whole;
    const ScreenRay<F> own = image_ray(c, p, n);
    const Vec2<F> infinity = place_at(c, p, own, F(HUGE_VAL));
    const F end_depth = tap.nearest(PlaneId::kReflectionDepth, infinity);
    const auto strays = hit < F(1) && passes_behind(c, p, own, infinity, end_depth);
    const Vec2<F> far = far_landing(c, p, tap, own, infinity, end_depth, strays);
    // Where the mirror saw into an object, the picture shows the outside at the same place.
    const auto from_outside = [&](const auto& meets_it, Mirrored<F> seen) {
      if (!c.planes.has(PlaneId::kReflectionValid) || !c.planes.covers(kColorPlanes)) return seen;
      const auto hollow = meets_it && tap.nearest(PlaneId::kReflectionValid, met) < F(0.5);
      if_any(hollow, [&] {
        const F stands = tap.nearest(PlaneId::kDepth, met);
        const F image = tap.nearest(PlaneId::kReflectionDepth, met);
        const auto shown = hollow && stands <= image && stands >= image;
        const Rgb<F> outside{tap.nearest(PlaneId::kColorR, met), tap.nearest(PlaneId::kColorG, met),
                             tap.nearest(PlaneId::kColorB, met)};
        seen.light = select(shown, outside, seen.light);
        seen.sources = select(shown, from_picture<F>(), seen.sources);
      });
      return seen;
    };
    Mirrored<F> seen =
        from_outside(whole, seen_at(c, p, tap, n, {select(whole, met, far), F(HUGE_VAL)}));
    const auto lacks = seen.sources.b > F(kLacks);
    if (c.environment) {
      const auto misses = hit < F(1);
      if_any(misses, [&] { seen = beyond_edge(c, p, tap, n, own, misses, seen); });
    }
    seen = shown_instead(c, p, tap, n, (hit <= F(0) && strays) || lacks, seen);
    if_any(parted, [&] {
      const Mirrored<F> there = from_outside(parted, seen_at(c, p, tap, n, {met, F(HUGE_VAL)}));
      const F share = select(parted, hit, F(0));
      seen.light = seen.light + share * (there.light - seen.light);
      seen.sources = seen.sources + share * (there.sources - seen.sources);
    });
    return seen;
  }

  /// What the picture shows of the rays of `lanes`, which pass behind a surface of the planes, or
  /// end where the planes have no data, as at an object's foot.
  template <class F, class Tap, class Mask>
  static Mirrored<F> shown_instead(const Pass& c, const Pixel<F>& p, const Tap& tap, Vec3<F> n,
                                   const Mask& lanes, Mirrored<F> seen) {
    if (!c.planes.covers(kColorPlanes)) return seen;
    const auto wanted = tap.wet() && lanes;
    if_any(wanted, [&] {
      const InPicture<F> there = met_in_picture(c, p, tap, n, wanted, kLostSteps);
      const auto met = wanted && there.hit > F(0.5);
      seen.light = select(met, there.light, seen.light);
      seen.sources = select(met, from_picture<F>(), seen.sources);
    });
    return seen;
  }

  /// The surroundings for the rays of `lanes` that leave the planes, unless the surface that the
  /// planes show at their edge stands behind the ray there, and may go on.
  template <class F, class Tap, class Mask>
  static Mirrored<F> beyond_edge(const Pass& c, const Pixel<F>& p, const Tap& tap, Vec3<F> n,
                                 const ScreenRay<F>& ray, const Mask& lanes, Mirrored<F> seen) {
    const F leaves = ray.s_at(reach_in(c.reflection, p.uv, ray.across));
    const auto off = lanes && tap.wet() && leaves < F(1e20);
    if_any(off, [&] {
      const F edge = tap.nearest(PlaneId::kReflectionDepth, ray.shift_at(leaves));
      // A depth that was computed from the dry picture is infinite where it is not known, too.
      const auto open = c.reflection_ends ? edge > F(1e30) : F(0) > F(0);
      const auto beyond = off && (open || edge <= ray.depth_at(leaves));
      seen.light = select(beyond, surroundings(c, p, tap, n), seen.light);
      seen.sources = select(beyond, from_far<F>(), seen.sources);
    });
    return seen;
  }

  /// Whether the surface at the depth `seen`, which the planes show at the ray's place at infinity,
  /// is so near that the ray reaches its depth at another place, and so passes behind it.
  template <class F>
  static LIMPID_INLINE auto passes_behind(const Pass& c, const Pixel<F>& p, const ScreenRay<F>& ray,
                                          Vec2<F> far, F seen) {
    const Vec2<F> off = place_at(c, p, ray, max((seen - ray.depth) / ray.depth_step, F(0))) - far;
    const F x = given<F>(c.size.x) * off.x, y = given<F>(c.size.y) * off.y;
    return seen < F(1e30) && x * x + y * y > F(kWrong * kWrong);
  }

  /// Where a ray ends that meets nothing: infinitely far, should the planes show something that far
  /// in its place. Else it is the nearest such place before it on the ray's line, or the pixel
  /// itself. `far` is the ray's place at infinity, `seen` the depth there; `strays`: the
  /// rays that meet nothing, and of which passes_behind() is true. What stands nearer to
  /// the viewer than the pixel's water is certainly not mirrored there: then the places beyond it
  /// count, too, which have a higher sky.
  template <class F, class Tap, class Mask>
  static Vec2<F> far_landing(const Pass& c, const Pixel<F>& p, const Tap& tap,
                             const ScreenRay<F>& ray, Vec2<F> far, F seen, const Mask& strays) {
    Vec2<F> landing = far;
    if_any(strays, [&] {
      F open = select(strays, F(1), F(0));
      const auto take = [&](const auto& wanted, Vec2<F> at) {
        const auto good = wanted && tap.nearest(PlaneId::kReflectionDepth, at) > F(1e30);
        landing = select(good, at, landing);
        open = select(good, F(0), open);
      };
      steps<F>(1, kPlaces + 1, [&](auto i) {
        const F away = F(0.9) * Loop<F>::ratio(i, kPlaces);
        const auto beyond = open > F(0.5) && seen < ray.depth;
        if_any(beyond, [&] {
          const Vec2<F> there = (F(1) + away) * far;
          take(beyond, min(reach_in(c.reflection, p.uv, there), F(1)) * there);
        });
        take(open > F(0.5), (F(1) - away) * far);
        return open > F(0.5);
      });
      landing = select(open > F(0.5), Vec2<F>{F(0), F(0)}, landing);
    });
    return landing;
  }
  static constexpr int kPlaces = 6;  ///< on each side
  /// Pixels. The depth that complete/mirror_depth.h makes is two pixels wider than its objects.
  static constexpr double kWrong = 4;
  static constexpr double kLacks = 0.3;  ///< share of the planes' texels
  /// Share of the depth of a pixel's water; less than 1 because depths of surfaces are rounded.
  static constexpr double kAhead = 0.99;
  static constexpr MirrorSteps kImageSteps{16, 0.2, 0.05, false},
      kPictureSteps{48, 0.06, 0.03, true}, kLostSteps{8, 0.06, 0.03, false};

  /// What a mirrored ray meets in the dry picture.
  template <class F>
  struct InPicture {
    Rgb<F> light;
    F hit, distance;  ///< 1 or 0; +inf where it meets nothing
  };
  template <class F, class Tap, class Mask>
  static InPicture<F> met_in_picture(const Pass& c, const Pixel<F>& p, const Tap& tap, Vec3<F> n,
                                     const Mask& lanes, const MirrorSteps& how, F thicker = F(1)) {
    const ScreenRay<F> ray(c, p, mirrored_ray(c, p, n));
    const auto below = p.side < F(0);
    const auto on_side = [&](Vec2<F> shift, F depth) {
      const F height = height_at(c, p, shift, depth);
      return (c.submersible ? select(below, F(0) - height, height) : height) > F(0);
    };
    const auto found = MirrorSearch<F, Tap>::march(c, tap, lanes, PlaneId::kDepth, c.dry, p, ray,
                                                   how, on_side, thicker);
    return {bilinear_rgb<F>(tap, PlaneId::kColorR, found.shift), found.hit, found.distance};
  }

  /// What the dry picture itself shows of the mirrored ray, and the surroundings for the rest: of
  /// the facets n those beyond the share `part`, whose ray is that of the facet `low`.
  template <class F, class Tap>
  static Mirrored<F> seen_in_picture(const Params& params, const Pass& c, const Pixel<F>& p,
                                     const Tap& tap, Vec3<F> n, F part, Vec3<F> low,
                                     F thicker = F(1)) {
    const ScreenRay<F> own(c, p, mirrored_ray(c, p, n));
    const Rgb<F> far = far_away(params, c, p, tap, n, own);
    const Mirrored<F> beyond = goes_on(c, p, tap, own, {far, from_far<F>()});
    const auto below = p.side < F(0);
    Mirrored<F> all = beyond;
    F hit(0), distance(HUGE_VAL);
    const auto meets = part > F(0);
    if_any(meets, [&] {
      const InPicture<F> there =
          met_in_picture(c, p, tap, low, tap.wet() && meets, kPictureSteps, thicker);
      hit = select(meets, part * there.hit, hit);
      distance = select(meets, there.distance, distance);
      all.light = select(meets, beyond.light + hit * (there.light - beyond.light), all.light);
      all.sources =
          select(meets, beyond.sources + hit * (from_picture<F>() - beyond.sources), all.sources);
    });
    if (c.submersible) {
      if_any(below, [&] {
        const Mirrored<F> under = seen_below(c, p, tap, n, own, distance, far);
        all = {select(below, under.light, all.light), select(below, under.sources, all.sources)};
      });
    }
    return all;
  }

  /// What lies beyond the picture: the surface that the picture shows at its edge goes on there, if
  /// the ray leaves the picture before it, as far as no sky is seen to both sides. The texels of
  /// the edge next to the ray show where the ray meets it.
  template <class F, class Tap>
  static Mirrored<F> goes_on(const Pass& c, const Pixel<F>& p, const Tap& tap,
                             const ScreenRay<F>& ray, Mirrored<F> beyond) {
    constexpr int kGuesses = 2;
    const F leaves = ray.s_at(reach_ahead(c, c.dry, p.uv, ray.across));
    const auto off = tap.wet() && p.side > F(0) && leaves < F(1e20) && ray.depth_step > F(0);
    if_any(off, [&] {
      const F edge = ray.depth_at(leaves);
      F distance = leaves, seen(0);
      Vec2<F> at = next_to(c, p, ray.shift_at(leaves));
      const auto stands = [&](Vec2<F> there) {
        seen = tap.nearest(PlaneId::kDepth, there);
        return seen > edge && seen < F(1e30) && height_at(c, p, there, seen) > F(0);
      };
      auto meets = off && stands(at);
      repeat<F>(kGuesses, [&] {
        distance = max((seen - ray.depth) / max(ray.depth_step, F(1e-6)), leaves);
        at = next_to(c, p, ray.shift_at(distance));
        meets = meets && stands(at);
      });
      if_any(meets, [&] {
        const Vec2<F> apart = ray.shift_at(distance) - at;
        const F width = given<F>(c.size.x), height = given<F>(c.size.y);
        const auto upright = is_upright(c, ray.across);
        const Vec2<F> aside{select(upright, abs(apart.y) * height / width, F(0)),
                            select(upright, F(0), abs(apart.x) * width / height)};
        for (const double share : {-1.0, -0.5, 0.5, 1.0}) {
          const Vec2<F> beside = next_to(c, p, at + F(share) * aside);
          meets = meets && tap.nearest(PlaneId::kDepth, beside) < F(1e30);
        }
        const Rgb<F> shown{tap.nearest(PlaneId::kColorR, at), tap.nearest(PlaneId::kColorG, at),
                           tap.nearest(PlaneId::kColorB, at)};
        beyond = {select(meets, shown, beyond.light),
                  select(meets, from_picture<F>(), beyond.sources)};
      });
    });
    return beyond;
  }

  /// The surroundings of the frame, or else of the look.
  template <class F, class Tap>
  static Rgb<F> far_away(const Params& params, const Pass& c, const Pixel<F>& p, const Tap& tap,
                         Vec3<F> n, const ScreenRay<F>& ray) {
    if (c.environment) return surroundings(c, p, tap, n);
    const Rgb<F> far = c.planes.covers(kSkyPlanes)
                           ? bilinear_rgb<F>(tap, PlaneId::kSkyR, ray.shift_at(F(HUGE_VAL)))
                           : constant<F>(params);
    return through_water<false>(c, p, tap, mirrored_ray(c, p, n), F(HUGE_VAL), far, {F(0), F(0)});
  }

  template <class F, class Tap, class Quad>
  static LIMPID_INLINE Four<F> valid(const Pass& c, const Tap& tap, const Quad& quad) {
    if (!c.planes.has(PlaneId::kReflectionValid)) return {F(1), F(1), F(1), F(1)};
    Four<F> seen = tap.read(PlaneId::kReflectionValid, quad);
    for (F& share : seen.at) share = select(share >= F(0.5), F(1), F(0));
    return seen;
  }

  template <class F, class Tap>
  static Mirrored<F> seen_at(const Pass& c, const Pixel<F>& p, const Tap& tap, Vec3<F> n,
                             const End<F>& end) {
    const auto taps =
        valid_taps(tap, end.shift, [&](const auto& quad) { return valid<F>(c, tap, quad); });
    Rgb<F> seen{taps.read(tap, PlaneId::kReflectionR), taps.read(tap, PlaneId::kReflectionG),
                taps.read(tap, PlaneId::kReflectionB)};
    F lacks(0);
    if_any(taps.made_up, [&] { lacks = F(1) - taps.weight(); });
    Rgb<F> sources = from_reflection<F>();
    if (c.medium) {
      const auto below = p.side < F(0);
      const auto known =
          end.distance < F(1e20) || (c.reflection_ends ? below : end.distance < F(0));
      if_any(below && known, [&] {
        const Vec3<F> ray = mirrored_ray(c, p, n);
        const Vec2<F> at = kept_in(c.dry, p, ScreenRay<F>(c, p, ray), end.distance);
        const Rgb<F> through = through_water(c, p, tap, ray, end.distance, seen, at);
        seen = select(known, through, seen);
        lacks = select(below && known, F(0), lacks);  // the water before it is there
      });
    }
    if (!c.environment) return {seen, sources};
    const auto lacking = lacks > F(1e-5);
    if_any(lacking, [&] {
      const F far = select(lacking, lacks, F(0));
      seen = seen + far * surroundings(c, p, tap, n);
      sources = {sources.r - far, sources.g, far};
    });
    return {seen, sources};
  }
};

}  // namespace limpid
