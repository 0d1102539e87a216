#pragma once
#include <array>

#include "limpid/ops/caustics.h"

#include "op/bilinear.h"
#include "op/caster_search.h"
#include "op/caustics_table.h"
#include "op/pass.h"
#include "op/pixel.h"
#include "op/screen_ray.h"

/// @file
/// The shadows on the bottom where the water bends the sun's light. ops/caustics_kernel.h has the
/// light itself.

namespace limpid {

struct MovedSunlight : Caustics {
  /// The sun, and what the frame tells of its light.
  struct Light {
    std::array<double, 3> sun, ambient;  ///< on a level bottom, up to a common factor
    double rise, sine;             ///< of the angle between the sun and the horizon, the vertical
    Vec2<double> level;            ///< the direction to the sun along map_x and map_y
    bool known;                    ///< the frame has the sun's light
    bool estimated;                ///< from its shadows: CausticsTable::sun_over_rest
    bool bends, moves;             ///< the water bends it, and shadows on the bottom are known
    bool entries;                  ///< knows_entries()
    std::array<double, 3> around;  ///< share of the light of sunlit bottoms, if it is known
  };
  /// Ratio of two depths below which the farther place counts as hidden by the nearer place.
  static constexpr double kSameDepth = 0.98;

  /// Shares of the sunlight that reach a place on the bottom.
  template <class F>
  struct Sunlit {
    F dry, arrives;  ///< straight, as in the dry picture, and refracted
    F known;         ///< share in which `arrives` was found; the rest of it is `dry`
    F hidden_known;  ///< 1 where `dry` is known of a hidden place
  };
  /// Refracted light enters at `entry`, straight light would enter at `level`; `lit` is the share
  /// for straight light. For a `hidden` place that is the share that passes the surface, if the
  /// picture shows water or land at both entries; else its light stays as in the dry picture. A
  /// place has all sunlight there in the share that is `filled`. `end` is the place.
  template <class F, class Tap, class Mask>
  static LIMPID_INLINE Sunlit<F> moved(const Pass& c, const Pixel<F>& p, const Tap& tap,
                                       const Vec3<F>& end, Vec2<F> entry, Vec2<F> level, F lit,
                                       Mask hidden, F filled) {
    const Vec3<F> up = vec3_of<F>(c.up), map_x = vec3_of<F>(c.map_x), map_y = vec3_of<F>(c.map_y);
    const Vec2<F> apart = entry - level;
    const F moved_by = sqrt(apart.x * apart.x + apart.y * apart.y);
    // The share of sunlight that passes the surface at a place, and whether it is known.
    struct Entry {
      F passes, known;
      F least;  ///< of the texels around, where `passes` is filtered
    };
    const auto point_at = [&](Vec2<F> at) {
      return at.x * map_x + at.y * map_y - given<F>(c.eye_above) * up;
    };
    const auto entry_at = [&](Vec2<F> at, auto land_counts) {
      const Vec3<F> point = point_at(at);
      const ScreenRay<F> ray(c, p, point - p.surface_point);
      const Vec2<F> shift = ray.shift_at(F(1));
      const auto quad = tap.quad(shift);
      const Four<F> lit_around = tap.read(PlaneId::kSurfaceShadow, quad);
      Entry found{F(0), known_at(c, p, shift), lit_around[0]};
      for (int k = 0; k < 4; ++k) {
        found.passes = found.passes + quad.weight(k) * lit_around[k];
        found.least = min(found.least, lit_around[k]);
      }
      // No light enters where there is no water, nor under land. Over a low camera, a wave in front
      // hides the place: the plane shows the shadow on that wave, which must be much nearer to the
      // place than shadows move.
      const F own = ray.depth_at(F(1));
      const bool surface = c.planes.has(PlaneId::kSurfaceDepth);
      const F seen = surface ? tap.nearest(PlaneId::kSurfaceDepth, shift) : own;
      const F off = abs(min(seen, F(1e30)) - own);
      const F shown = saturate(F(1.5) - F(2) * off / max(moved_by, F(1e-6)));
      const auto none = nothing(seen);
      const auto under_land = given<F>(c.caustics->under_land, "caustics.under_land") > F(0);
      F dry_there(HUGE_VAL);
      if_any(under_land, [&] { dry_there = tap.nearest(PlaneId::kDepth, shift); });
      const auto covered = under_land && dry_there < F(kSameDepth) * own;
      F land = select(none, F(1), F(0));
      const auto asks = (none || covered) && land_counts;
      if_any(asks,
             [&] { land = select(asks, is_land(c, p, tap, point, ray, shift, moved_by), land); });
      const auto closed = none || land > F(0.5);
      found.passes = select(closed, F(0), found.passes);
      found.known = found.known * select(closed, land, shown);
      return found;
    };
    const Entry refracted = entry_at(entry, F(0) < F(1));
    // A shadow that the surface's shadow does not explain is cast under water. Where no straight
    // light enters, that does not matter but for a hidden place, nor whether there is land.
    F below(1), dry = lit, known = refracted.known;
    const auto shaded = lit < F(1 - 1e-6) && !hidden;
    if_any(shaded || hidden, [&] {
      const Entry straight = entry_at(level, hidden);
      const auto unexplained = straight.passes > F(0.05) && lit < straight.least - F(1e-3);
      const F cast = select(unexplained, min(lit / max(straight.passes, F(0.05)), F(1)), F(1));
      below = select(shaded, F(1) + straight.known * (cast - F(1)), F(1));
      known = select(hidden, straight.known * known, known);
      dry = select(hidden, F(1) + known * (straight.passes - F(1)), dry);
      const auto cast_below = shaded && below < F(1 - 1e-3);
      if_any(cast_below, [&] {
        const F leaves = leaves_shade(c, p, tap, cast_below, end, point_at(level) - end,
                                      point_at(entry) - end, lit);
        below = below + leaves * (F(1) - below);
      });
    });
    const F told = filled_in(select(hidden, known, F(0)), filled);
    known = known + filled * (refracted.known - known);
    dry = filled_in(dry, filled), below = filled_in(below, filled);
    return {dry, dry + known * (refracted.passes * below - dry), known, told};
  }
  /// The share of the shade at `end` that an object under water casts with straight light, and does
  /// not cast with refracted light: under a low sun its shadow is much shorter then. `straight` and
  /// `refracted` are the ways of the light from there to the surface, `lit` is the share for
  /// straight light. 0 for lanes other than `lanes`.
  template <class F, class Tap, class Mask>
  [[gnu::noinline]] static F leaves_shade(const Pass& c, const Pixel<F>& p, const Tap& tap,
                                          const Mask& lanes, const Vec3<F>& end,
                                          const Vec3<F>& straight, const Vec3<F>& refracted,
                                          F lit) {
    constexpr double kMargin = 0.009;  // outlines are rounded to texels
    F casts = caster_on(c, p, tap, lanes, end, straight, kMargin);
    // Light at a shadow's edge passes the object by a pixel: over it, or beside it.
    const auto at_edge = lanes && lit > F(0.02) && casts < F(1);
    if_any(at_edge, [&] {
      const Vec3<F> up = vec3_of<F>(c.up);
      const Vec3<F> sunwards = normalize_or(straight - dot(up, straight) * up, vec3_of<F>(c.map_x));
      const Vec3<F> across = cross(up, sunwards);
      const F beside = F(1.5) * caustics_texel(c, p.hit_depth, F(1));
      each<F>(3, [&](auto i) {
        const F on = beside * pick<F>(i, F(0), F(0), F(1));
        const F aside = beside * pick<F>(i, F(1), F(-1), F(0));
        const Vec3<F> there = end + on * sunwards + aside * across;
        const F found = caster_on(c, p, tap, at_edge, there, straight, kMargin);
        casts = max(casts, select(at_edge, found, F(0)));
      });
    });
    F stays(0);
    const auto cast = casts > F(0);
    if_any(cast, [&] { stays = caster_on(c, p, tap, cast, end, refracted, 0); });
    return casts * (F(1) - stays);
  }

  /// Without a shadow on the surface: the shadows on the bottom where straight light through the
  /// refracted light's entry falls, at the place `end + by`, which is as deep as `end`. Known if
  /// the picture shows the bottom there, and that bottom does not shade itself: it rises towards
  /// the sun less than kSteep times as steeply as sunlight falls.
  template <class F, class Tap, class Mask>
  static LIMPID_INLINE Sunlit<F> shifted(const Pass& c, const Pixel<F>& p, const Tap& tap,
                                         const Light& light, const Vec3<F>& end, const Vec3<F>& by,
                                         F lit, Mask hidden, F filled) {
    constexpr double kBeside = 0.25, kSteep = 0.3;
    const Vec3<F> place = end + by;
    const ScreenRay<F> ray(c, p, place - p.surface_point);
    const Vec2<F> shift = ray.shift_at(F(1));
    const F depth = ray.depth_at(F(1));
    const F off = abs(bilinear_depth<F>(tap, PlaneId::kDepth, tap.quad(shift)) - depth);
    const F shown = saturate(F(2) - off / (F(1 - kSameDepth) * max(depth, F(1e-6))));
    F known = select(hidden, F(0), shown * known_at(c, p, shift));
    const F dry = filled_in(lit, filled), there = bilinear<F>(tap, PlaneId::kShadow, shift);
    const auto darker = known > F(0) && there < dry;
    if_any(darker, [&] {
      const auto height_of = [&](Vec2<F> at) {
        return height_at(c, p, at, bilinear_depth<F>(tap, PlaneId::kDepth, tap.quad(at)));
      };
      // Refraction moves light away from the sun.
      const Vec3<F> towards = F(-kBeside) * by;
      const F beside =
          height_of(ScreenRay<F>(c, p, place + towards - p.surface_point).shift_at(F(1)));
      const F steep = given<F>(kSteep * light.rise / std::max(light.sine, 1e-3), "caustics.steep");
      const F rises = (beside - height_of(shift)) / max(steep * length(towards), F(1e-6));
      // A caster of shade above the water tells of no slope.
      const auto slope = darker && beside < F(0);
      known = select(slope, known * saturate(F(2) - rises), known);
    });
    const F arrives = dry + known * (there - dry);
    return {dry, arrives, known, filled};
  }
  /// A value of the bottom that is shown, mixed with 1 of the bottom that is filled in.
  template <class F>
  static LIMPID_INLINE F filled_in(F shown, F filled) {
    return shown + filled * (F(1) - shown);
  }

  /// For a place of the calm surface that the picture does not show: 1 if the surface that it shows
  /// at `shift` instead rises above that place, 0 if it only stands in front of it. On land the
  /// picture shows the point above the place that is as high as what it shows there, and nothing
  /// farther two pixels behind that point. Places as near behind a wall's foot as a quarter of the
  /// way by which shadows move (`moved_by`) count as land.
  template <class F, class Tap>
  static LIMPID_INLINE F is_land(const Pass& c, const Pixel<F>& p, const Tap& tap,
                                 const Vec3<F>& place, const ScreenRay<F>& ray, Vec2<F> shift,
                                 F moved_by) {
    constexpr int kRises = 3;
    const Vec3<F> up = vec3_of<F>(c.up);
    const F depth = ray.depth_at(F(1));
    const F off = abs(min(tap.nearest(PlaneId::kDepth, shift), F(1e30)) - depth);
    struct Past {
      F height, distance;  ///< of what is seen at a point: over the water, and behind the point
    };
    const auto past = [&](const Vec3<F>& point) {
      const ScreenRay<F> to(c, p, point - p.surface_point);
      const Vec2<F> at = to.shift_at(F(1));
      const F seen = min(tap.nearest(PlaneId::kDepth, at), F(1e30));
      return Past{max(height_at(c, p, at, seen), F(0)), seen - to.depth_at(F(1))};
    };
    Vec3<F> point = place;
    for (int i = 0; i < kRises; ++i) point = place + past(point).height * up;
    const F sink = max(abs(dot(up, p.to_viewer)), F(0.05));
    const Vec3<F> level = sink * up - p.to_viewer;  // away from the viewer
    const F pixel = caustics_texel(c, depth, F(1)) / sink;
    const F two_pixels = F(2) * pixel, per_length = F(1) / max(sqrt(dot(level, level)), F(1e-3));
    const F near = F(0.5) * off + two_pixels + F(0.25) * moved_by;
    const auto land = abs(past(point).distance) <= near &&
                      past(point + (two_pixels * per_length) * level).distance <= near;
    return select(land, F(1), F(0));
  }

  /// 1 in the picture, 0 beyond it, a ramp near its edge.
  template <class F>
  static LIMPID_INLINE F known_at(const Pass& c, const Pixel<F>& p, Vec2<F> shift) {
    const F x = p.uv.x + shift.x, y = p.uv.y + shift.y;
    const F inside = min(min(x - given<F>(c.dry.low.x), given<F>(c.dry.high.x) - x),
                         min(y - given<F>(c.dry.low.y), given<F>(c.dry.high.y) - y));
    return saturate(F(20) * inside);
  }
};

}  // namespace limpid
