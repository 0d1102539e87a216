#pragma once
#include "limpid/ops/fresnel_reflection.h"

#include "op/bilinear.h"
#include "op/edge_surfaces.h"
#include "op/mirror_search.h"
#include "op/operator.h"
#include "op/round_edge.h"
#include "op/screen_ray.h"
#include "op/seen_slope.h"
#include "op/water_medium.h"
#include "optics/clear_sky.h"
#include "optics/refract.h"
#include "optics/surroundings.h"

/// @file
/// The light that a facet of the surface mirrors from the dry picture, the surroundings or a
/// constant, where there are no reflection planes.

namespace limpid {

struct MirroredPicture : FresnelReflection {
  template <class F>
  struct Mirrored {
    Rgb<F> light, sources;     ///< light, and its source: Pixel::mirror_sources
    F distance = F(HUGE_VAL);  ///< to the surface that the ray meets, in scene units
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

  template <class F>
  static LIMPID_INLINE Rgb<F> constant(const Params& params) {
    return {given<F>(params.color.r), given<F>(params.color.g), given<F>(params.color.b)};
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

  // --- the dry picture ---------------------------------------------------------------------------

  static constexpr MirrorSteps kPictureSteps{48, 0.06, 0.03, true, true},
      kLostSteps{8, 0.06, 0.03, false, false};

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
    Rgb<F> light{F(0), F(0), F(0)};
    const auto hit = found.hit > F(0);
    // A ray that meets a surface from behind ends at the hidden side of a thing, like the underside
    // of a deck, which is mostly in the shade.
    if_any(hit, [&] {
      constexpr double kHidden = 0.3;  // of the light of the visible side
      constexpr double kFull = 10;     // per cosine between ray and normal
      const SeenSlope<F> slope = seen_slope(c, p, tap, found.shift);
      const F hidden = saturate(F(kFull) * dot(slope.normal, mirrored_ray(c, p, n)));
      Rgb<F> shown = bilinear_rgb<F>(tap, PlaneId::kColorR, found.shift);
      const auto borders = hit && abs(slope.clear.x) + abs(slope.clear.y) > F(0);
      if_any(borders, [&] {
        const auto limited = [&](F color, PlaneId plane) {
          constexpr double kBrighter = 2;
          const F clear = tap.nearest(plane, found.shift + slope.clear);
          return select(borders, min(color, F(kBrighter) * max(clear, F(0))), color);
        };
        shown = {limited(shown.r, PlaneId::kColorR), limited(shown.g, PlaneId::kColorG),
                 limited(shown.b, PlaneId::kColorB)};
      });
      light = select(hit, (F(1) - F(1 - kHidden) * hidden) * shown, light);
    });
    return {light, found.hit, found.distance};
  }

  /// What the dry picture itself shows of the mirrored ray, and the surroundings for the rest: of
  /// the facets n those beyond the share `part`, whose ray is that of the facet `low`.
  template <class F, class Tap>
  static Mirrored<F> seen_in_picture(const Params& params, const Pass& c, const Pixel<F>& p,
                                     const Tap& tap, Vec3<F> n, F part, Vec3<F> low,
                                     F thicker = F(1)) {
    const ScreenRay<F> own(c, p, mirrored_ray(c, p, n));
    const Rgb<F> far = far_away(params, c, p, tap, n, own);
    const auto below = p.side < F(0);
    Mirrored<F> all{far, from_far<F>()};
    F distance(HUGE_VAL);
    InPicture<F> there{far, F(0), distance};
    const auto meets = part > F(0);
    if_any(meets, [&] {
      there = met_in_picture(c, p, tap, low, tap.wet() && meets, kPictureSteps, thicker);
      distance = select(meets, there.distance, distance);
    });
    const F hit = select(meets, part * there.hit, F(0));
    const auto misses = hit < F(1);
    if_any(misses, [&] { all = goes_on(c, p, tap, own, misses, all); });
    all.light = select(meets, all.light + hit * (there.light - all.light), all.light);
    all.sources = select(meets, all.sources + hit * (from_picture<F>() - all.sources), all.sources);
    if (c.submersible) {
      if_any(below, [&] {
        const Mirrored<F> under = seen_below(c, p, tap, n, own, distance, far);
        all = {select(below, under.light, all.light), select(below, under.sources, all.sources)};
      });
    }
    all.distance = select(hit > F(0), distance, all.distance);
    return all;
  }

  /// The light from beyond the picture, for `lanes`: the surfaces that the picture shows at its
  /// edge go on there, if the ray leaves the picture before them: less, the more sky is seen among
  /// them around the place of the edge next to the ray, as far to both sides as the ray is beyond
  /// the edge, and the higher the ray meets them. In a room these rays
  /// meet its ceiling.
  template <class F, class Tap, class Mask>
  static Mirrored<F> goes_on(const Pass& c, const Pixel<F>& p, const Tap& tap,
                             const ScreenRay<F>& ray, const Mask& lanes, Mirrored<F> beyond) {
    constexpr int kGuesses = 2;
    constexpr double kJustBehind = 0.25;  // of the ray's depth
    if (!c.edge_surfaces) return beyond;
    const EdgeSurfaces& surfaces = *c.edge_surfaces;
    const F leaves = ray.s_at(reach_ahead(c, c.dry, p.uv, ray.across));
    const auto off =
        lanes && tap.wet() && p.side > F(0) && leaves < F(1e20) && ray.depth_step > F(0);
    if_any(off, [&] {
      const F edge = ray.depth_at(leaves);
      Vec2<F> at{F(0), F(0)}, place = at;
      Rgb<F> shape{F(0), F(0), F(0)};
      F depth(0);
      const auto look = [&](F distance) {
        const Vec2<F> end = ray.shift_at(distance);
        at = next_to(c, p, end);
        const F x = given<F>(c.size.x) * (end.x - at.x), y = given<F>(c.size.y) * (end.y - at.y);
        const F beyond_edge = sqrt(x * x + y * y) / given<F>(surfaces.reach);
        constexpr int kRows = EdgeSurfaces::kRows;
        place = {round_edge(c.dry, p.uv + at, "edge_surfaces.size"),
                 F((kRows - 1.0) / kRows) * sqrt(min(beyond_edge, F(1))) + F(0.5 / kRows)};
        shape = tap.lat_long_rgb(surfaces.shape, place);
        depth = shape.g / max(shape.r, F(1e-6));
      };
      F distance = leaves;
      look(distance);
      repeat<F>(kGuesses, [&] {
        const F ahead = (depth - ray.depth) / max(ray.depth_step, F(1e-6));
        distance = select(depth > edge, max(ahead, leaves), F(HUGE_VAL));
        look(distance);
      });
      const F closed = given<F>(surfaces.closed);
      // A ray that leaves a little behind a ceiling has met it between two steps of the march.
      const auto meets = off && depth > (F(1) - F(kJustBehind) * closed) * edge;
      if_any(meets, [&] {
        // Gaps of sky are wider beyond the edge than at the edge. Of heights of which nothing is
        // known but that they are larger, half are more than twice as large.
        const F goes = saturate(F(2) * shape.r / max(shape.b, F(1e-6)) - F(1));
        const F known = max(height_at(c, p, at, depth), F(0));
        const F wanted = height_at(c, p, ray.shift_at(distance), ray.depth_at(distance));
        const F higher = min(known / max(wanted, F(1e-6)), F(1));
        const F share = select(meets, max(goes * goes * higher, closed), F(0)), rest = F(1) - share;
        const Rgb<F> shown = tap.lat_long_rgb(surfaces.colors, place);
        beyond = {rest * beyond.light + (share / max(shape.r, F(1e-6))) * shown,
                  rest * beyond.sources + share * from_picture<F>(),
                  select(share > F(0.5), distance, beyond.distance)};
      });
    });
    return beyond;
  }

  /// The planes of the sky. Beyond their edge the sky goes on to change as the visible sky does, in
  /// multiples of a clear sky's change: clear skies darken and overcast ones brighten towards the
  /// zenith, and clear skies are brighter around the sun.
  template <class F, class Tap>
  static Rgb<F> sky(const Pass& c, const Pixel<F>& p, const Tap& tap, Vec3<F> n,
                    const ScreenRay<F>& ray) {
    const Vec2<F> end = ray.shift_at(F(HUGE_VAL)), at = next_to(c, p, end);
    Rgb<F> seen = bilinear_rgb<F>(tap, PlaneId::kSkyR, end);
    const auto beyond = abs(end.x - at.x) + abs(end.y - at.y) > F(0);
    if_any(beyond, [&] {
      const Vec3<F> up = vec3_of<F>(c.up), to_sun = vec3_of<F>(c.sun.direction);
      const Vec3<F> view = ray_gain(c, at) - p.ray_length * p.to_viewer;
      const Vec3<F> edge = (F(1) / sqrt(dot(view, view))) * view, far = mirrored_ray(c, p, n);
      // The texel at the edge may lie below the ray, and below the horizon.
      const F low = max(dot(up, edge), F(0)), high = max(dot(up, far), low);
      const F by_elevation = clear_sky_by_elevation(high) - clear_sky_by_elevation(low);
      const F by_sun = clear_sky_by_sun(dot(to_sun, far)) - clear_sky_by_sun(dot(to_sun, edge));
      const auto on = [&](double elevation, double sun, int i, F light) {
        const F changed = light * exp(by_elevation * given<F>(elevation, "sky.with_elevation", i) +
                                      by_sun * given<F>(sun, "sky.with_sun", i));
        return select(beyond, changed, light);
      };
      const Rgb<double>&elevation = c.sky_change.with_elevation, &sun = c.sky_change.with_sun;
      seen = {on(elevation.r, sun.r, 0, seen.r), on(elevation.g, sun.g, 1, seen.g),
              on(elevation.b, sun.b, 2, seen.b)};
    });
    return seen;
  }

  /// The surroundings of the frame, or else of the look.
  template <class F, class Tap>
  static Rgb<F> far_away(const Params& params, const Pass& c, const Pixel<F>& p, const Tap& tap,
                         Vec3<F> n, const ScreenRay<F>& ray) {
    if (c.environment) return surroundings(c, p, tap, n);
    const Rgb<F> far = c.planes.covers(kSkyPlanes) ? sky(c, p, tap, n, ray) : constant<F>(params);
    return through_water<false>(c, p, tap, mirrored_ray(c, p, n), F(HUGE_VAL), far, {F(0), F(0)});
  }
};

}  // namespace limpid
