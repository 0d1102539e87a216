#pragma once
#include <optional>

#include "op/valid_lookup.h"
#include "ops/mirrored_picture.h"

/// @file
/// The light that a facet of the surface mirrors: from the reflection planes, or from
/// the sources of ops/mirrored_picture.h. ops/fresnel_reflection_kernel.h chooses the facets and
/// blends it.

namespace limpid {

struct MirroredLight : MirroredPicture {
  /// The depth plane over which mirrored rays march, or none.
  static std::optional<PlaneId> marched(const Params& params, const Pass& c) {
    if (params.source != Source::kAuto) return {};
    if (!reads_planes(params, c)) return PlaneId::kDepth;
    const bool follows = params.lookup == Lookup::kRay && c.planes.has(PlaneId::kReflectionDepth);
    if (!follows || c.submersible) return {};
    return PlaneId::kReflectionDepth;
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
    if (marched(params, c)) return seen_on_march(params, c, p, tap, n, F(1), n, n);
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
  /// on the ray of the facet `low`. If they do, in the planes of a reflection the rest look along
  /// the ray of the facet `over`, because n's may show that object, too. `thicker`: factor on the
  /// thickness of the picture's surfaces, not of a reflection's.
  template <class F, class Tap>
  static Mirrored<F> seen_on_march(const Params& params, const Pass& c, const Pixel<F>& p,
                                   const Tap& tap, Vec3<F> n, F part, Vec3<F> low, Vec3<F> over,
                                   F thicker = F(1)) {
    return reads_planes(params, c) ? seen_in_image(params, c, p, tap, n, part, low, over)
                                   : seen_in_picture(params, c, p, tap, n, part, low, thicker);
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
  static Mirrored<F> seen_in_image(const Params& params, const Pass& c, const Pixel<F>& p,
                                   const Tap& tap, Vec3<F> n, F part, Vec3<F> low, Vec3<F> over) {
    // Looks with one facet leave out the search for narrow things, a seventh of their time.
    MirrorSteps how = kImageSteps;
    how.narrow = params.facets == Facets::kSpread;
    Vec2<F> met{F(0), F(0)};
    F hit(0), distance(HUGE_VAL);
    const auto meets = part > F(0);
    if_any(meets, [&] {
      const ScreenRay<F> ray = image_ray(c, p, low);
      // A ray away from the viewer meets nothing that stands before the pixel's water.
      const auto ahead = [&](Vec2<F>, F depth) {
        return depth > F(0) && (depth > F(kAhead) * ray.depth || ray.depth_step < F(0));
      };
      const auto found = MirrorSearch<F, Tap>::march(
          c, tap, tap.wet() && meets, PlaneId::kReflectionDepth, c.reflection, p, ray, how, ahead);
      hit = select(meets, part * found.hit, hit);
      met = found.shift;
      distance = select(hit > F(0), found.distance, distance);
    });
    const auto whole = hit >= F(1), parted = hit > F(0) && !whole;
    const Vec3<F> open_facet = select(parted, over, n);
    const ScreenRay<F> own = image_ray(c, p, open_facet);
    const Vec2<F> infinity = place_at(c, p, own, F(HUGE_VAL));
    const F end_depth = tap.nearest(PlaneId::kReflectionDepth, infinity);
    const auto strays = hit < F(1) && passes_behind(c, p, own, infinity, end_depth);
    const Landing<F> far = far_landing(params, c, p, tap, own, infinity, end_depth, strays);
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
    // Where the rays end that meet nothing, or the only place; then what the part of them meets.
    Mirrored<F> seen{{F(0), F(0), F(0)}, {F(0), F(0), F(0)}};
    steps<F>(0, params.facets == Facets::kSpread ? 2 : 1, [&](auto k) {
      const auto second = pick<F>(k, F(0), F(1), F(1)) > F(0.5), meets_it = whole || second;
      F lacking(0);
      Mirrored<F> there =
          from_outside(meets_it && hit > F(0),
                       seen_at(c, p, tap, select(second, n, open_facet),
                               {select(meets_it, met, far.place), F(HUGE_VAL)}, &lacking));
      only<F>(k, 0, [&] {
        const auto lacks = lacking > F(kLacks) && there.sources.g < F(0.5);
        if (c.environment) {
          const auto misses = hit < F(1);
          if_any(misses, [&] { there = beyond_edge(c, p, tap, open_facet, own, misses, there); });
        }
        const auto asks = (hit <= F(0) && strays) || lacks;
        there = shown_instead(c, p, tap, open_facet, asks, far.lost, there);
      });
      const F share = select(second, select(parted, hit, F(0)), F(1));
      seen.light = seen.light + share * (there.light - seen.light);
      seen.sources = seen.sources + share * (there.sources - seen.sources);
      seen.distance = min(seen.distance, there.distance);
      return parted;
    });
    seen.distance = min(distance, seen.distance);
    return seen;
  }

  /// What the picture shows of the rays of `lanes`, which pass behind a surface of the planes, or
  /// end where the planes have no data, as at an object's foot. `lost`: 1 for rays that meet
  /// nothing, and for which the planes show no place without a surface. Without an environment it
  /// is what the picture shows in their direction: sky, close beyond its edge, too, or a far
  /// surface.
  template <class F, class Tap, class Mask>
  static Mirrored<F> shown_instead(const Pass& c, const Pixel<F>& p, const Tap& tap, Vec3<F> n,
                                   const Mask& lanes, F lost, Mirrored<F> seen) {
    if (!c.planes.covers(kColorPlanes)) return seen;
    const auto wanted = tap.wet() && lanes;
    if_any(wanted, [&] {
      const InPicture<F> there = met_in_picture(c, p, tap, n, wanted, kLostSteps);
      const auto met = wanted && there.hit > F(0.5);
      seen.light = select(met, there.light, seen.light);
      seen.sources = select(met, from_picture<F>(), seen.sources);
      seen.distance = select(met, there.distance, seen.distance);
      if (c.environment) return;
      const auto open = wanted && !met && lost > F(0.5);
      if_any(open, [&] {
        const ScreenRay<F> ray(c, p, mirrored_ray(c, p, n));
        const Vec2<F> end = ray.shift_at(F(HUGE_VAL)), at = next_to(c, p, end);
        const F depth = tap.nearest(PlaneId::kDepth, at);
        const F beyond = abs(end.x - at.x) + abs(end.y - at.y);
        const auto far_off = depth > F(kAhead) * p.surface_depth || ray.depth_step < F(0);
        const auto surface = beyond <= F(0) && far_off && height_at(c, p, at, depth) > F(0);
        const auto sky = beyond < F(kNearEdge) && nothing(depth);
        const auto shown = open && (sky || surface);
        const Rgb<F> far{tap.nearest(PlaneId::kColorR, at), tap.nearest(PlaneId::kColorG, at),
                         tap.nearest(PlaneId::kColorB, at)};
        seen.light = select(shown, far, seen.light);
        seen.sources = select(shown, from_picture<F>(), seen.sources);
      });
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

  template <class F>
  struct Landing {
    Vec2<F> place;
    F lost;  ///< 1 where it is the pixel itself, for want of another place
  };
  /// Where a ray ends that meets nothing: infinitely far, should the planes show something that far
  /// in its place. Else it is the nearest such place before it on the ray's line, a little apart
  /// from the surface's outline, or the pixel itself. `far` is the ray's place at infinity, `seen`
  /// the depth there; `strays`: the rays that meet nothing, and of which passes_behind() is true.
  /// What stands nearer to the viewer than the pixel's water is certainly not mirrored there: then
  /// the places beyond it count, too, which have a higher sky.
  template <class F, class Tap, class Mask>
  static Landing<F> far_landing(const Params& params, const Pass& c, const Pixel<F>& p,
                                const Tap& tap, const ScreenRay<F>& ray, Vec2<F> far, F seen,
                                const Mask& strays) {
    Vec2<F> landing = far;
    F lost(0);
    if_any(strays, [&] {
      const auto place_of = [&](F share) {
        const Vec2<F> there = share * far;
        return min(reach_in(c.reflection, p.uv, there), F(1)) * there;
      };
      const auto is_free = [&](F share) {
        return tap.nearest(PlaneId::kReflectionDepth, place_of(share)) > F(1e30);
      };
      // Shares of the way to `far`: of a place with a surface, and of one without beside it.
      F surface(1), free(0), open = select(strays, F(1), F(0));
      const auto take = [&](const auto& wanted, F toward, F away) {
        const auto good = wanted && is_free(F(1) + toward * away);
        free = select(good, F(1) + toward * away, free);
        surface = select(good, F(1) + toward * (away - F(kFarthest / kPlaces)), surface);
        open = select(good, F(0), open);
      };
      steps<F>(1, kPlaces + 1, [&](auto i) {
        const F away = F(kFarthest) * Loop<F>::ratio(i, kPlaces);
        const auto beyond = open > F(0.5) && seen < ray.depth;
        if_any(beyond, [&] { take(beyond, F(1), away); });
        take(open > F(0.5), F(-1), away);
        return open > F(0.5);
      });
      // Looks with one facet are for speed: they leave out the halving.
      repeat<F>(params.facets == Facets::kSpread ? kHalvings : 0, [&] {
        const F middle = F(0.5) * (surface + free);
        const auto good = is_free(middle);
        free = select(good, middle, free);
        surface = select(good, surface, middle);
      });
      // A computed depth does not end exactly where the picture's surface ends.
      const F x = given<F>(c.size.x) * far.x, y = given<F>(c.size.y) * far.y;
      const F pixel = F(1) / max(sqrt(x * x + y * y), F(1));
      const F clear = max(free + select(free > surface, F(kWrong), F(-kWrong)) * pixel, F(0));
      const F share = select(is_free(clear), clear, free);
      const auto found = strays && open < F(0.5);
      const Vec2<F> at = place_of(share);
      landing = select(found, at, select(strays, Vec2<F>{F(0), F(0)}, far));
      lost = open;
    });
    return {landing, lost};
  }
  static constexpr int kPlaces = 6, kHalvings = 4;  ///< on each side, and between two places
  static constexpr double kFarthest = 0.9;
  /// Pixels. The depth that complete/mirror_depth.h makes is two pixels wider than its objects.
  static constexpr double kWrong = 4;
  static constexpr double kLacks = 0.3;  ///< share of the planes' texels
  /// Share of the picture, up to which the sky beyond its edge is taken for that at its edge.
  static constexpr double kNearEdge = 0.25;
  /// Share of the depth of a pixel's water; less than 1 because depths of surfaces are rounded.
  static constexpr double kAhead = 0.99;
  static constexpr MirrorSteps kImageSteps{16, 0.2, 0.05};

  template <class F, class Tap, class Quad>
  static LIMPID_INLINE Four<F> valid(const Pass& c, const Tap& tap, const Quad& quad) {
    if (!c.planes.has(PlaneId::kReflectionValid)) return {F(1), F(1), F(1), F(1)};
    Four<F> seen = tap.read(PlaneId::kReflectionValid, quad);
    for (F& share : seen.at) share = select(share >= F(0.5), F(1), F(0));
    return seen;
  }

  /// What the planes show at the end of the ray of the facet n, and the surroundings for the share
  /// `lacking` of the texels there that are not valid, if it is known.
  template <class F, class Tap>
  static Mirrored<F> seen_at(const Pass& c, const Pixel<F>& p, const Tap& tap, Vec3<F> n,
                             const End<F>& end, F* lacking = nullptr) {
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
    if (lacking) *lacking = lacks;
    if (!c.environment) return {seen, sources};
    const auto some = lacks > F(1e-5);
    if_any(some, [&] {
      const F far = select(some, lacks, F(0));
      seen = seen + far * surroundings(c, p, tap, n);
      sources = {sources.r - far, sources.g, far};
    });
    return {seen, sources};
  }
};

}  // namespace limpid
