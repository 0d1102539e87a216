#pragma once
#include <array>

#include "limpid/ops/caustics.h"

#include "op/bilinear.h"
#include "op/bottom_layer.h"
#include "op/caustics_table.h"
#include "op/operator.h"
#include "op/screen_ray.h"
#include "op/seen_planes.h"
#include "op/seen_slope.h"
#include "ops/moved_sunlight.h"
#include "optics/refract.h"

namespace limpid {

template <>
struct Kernel<Caustics> : MovedSunlight {
  static constexpr StateSet kUses{StatePart::kNormal,    StatePart::kPrism,
                                  StatePart::kPosition,  StatePart::kPath,
                                  StatePart::kDryBottom, StatePart::kTransmitted};
  static constexpr StateSet kMakes{StatePart::kDryBottom, StatePart::kTransmitted};
  static PlaneSet reads(const Params& p) {
    const PlaneSet lit = kSunColorPlanes | PlaneSet{PlaneId::kShadow, PlaneId::kDepth};
    if (p.sunlight == Sunlight::kStraight) return p.strength == 0 ? PlaneSet{} : lit;
    return lit | PlaneSet{PlaneId::kSurfaceShadow, PlaneId::kSurfaceDepth};
  }
  static PlaneSet wants(const Params& p, const AtHand&) {
    return p.sunlight == Sunlight::kRefracted ? PlaneSet{PlaneId::kSurfaceShadow} : PlaneSet{};
  }
  static Needs needs(const Params&) { return {.planes = {}, .sun = true}; }
  /// The place that refraction looked up, and the entry point of sunlight.
  static double reach(const Params& p) { return p.sunlight == Sunlight::kRefracted ? HUGE_VAL : 0; }
  static bool neutral(const Params& p, StateSet made) {
    const bool focuses = p.strength != 0 && made.has(StatePart::kNormal);
    return !made.has(StatePart::kPosition) || (!focuses && p.sunlight == Sunlight::kStraight);
  }
  static std::string_view prefer(Params& params, const AtHand& has);
  static double bound(const Params& params, const Pass& c, const Ranges& ranges);
  /// Widens the light from below, from which later bounds are made.
  static void propagate_ranges(const Params& params, const Pass& c, Ranges& ranges);
  static double displaced(const Params& params, const Ranges& ranges);

  static constexpr CellKind kSkipped{"no_caustics", "no sunlight is focused"};
  static double ns(const Params& p, const Running&) {
    return p.sunlight == Sunlight::kRefracted ? 36 : 22;
  }

  static Light light_of(const Params& params, const Pass& c);
  /// The sun's light on a level bottom over the sky's, of red, green and blue.
  static std::array<double, 3> sun_over_sky(const Params& params, const Pass& c);
  /// Whether a frame with these planes tells what sunlight passes the surface where it enters.
  static bool knows_entries(const Params& params, const Pass& c, PlaneSet planes);
  /// Bound on sunlight on a slope over that on level bottom, and over the unrefracted light there.
  static constexpr double kMostTilt = 2;

  template <class Strip>
  static void apply(const Params& params, const Pass& c, Strip& strip) {
    using F = typename Strip::Number;
    if (!c.caustics) return;
    const CausticsTable& table = *c.caustics;
    const Light light = light_of(params, c);
    if (!light.bends && (table.count == 0 || params.strength == 0)) return;
    const Vec3<F> up = vec3_of<F>(c.up), map_x = vec3_of<F>(c.map_x), map_y = vec3_of<F>(c.map_y);
    const SeenPlanes planes = SeenPlanes::of(c);
    const Vec2<F> sunwards{given<F>(light.level.x, "caustics.sunwards", 0),
                           given<F>(light.level.y, "caustics.sunwards", 1)};
    const bool split = c.made.has(StatePart::kPrism), shadowed = c.planes.has(PlaneId::kShadow);
    const auto sees_bottom = [](const Pixel<F>& p) {
      const auto from_air = p.side > F(0.5), has_path = p.path > F(0) && p.path < F(1e20);
      return p.side > F(-0.5) && p.hit_depth < F(1e30) && (!from_air || has_path);
    };
    if (light.known) {
      // A probe of its own, so short that a processor makes lookups of later pixels meanwhile.
      strip.probe([&](Pixel<F>& p, const auto& tap) {
        p.dry_sun = {F(0), F(0), F(0)};
        if_any(sees_bottom(p), [&] {
          p.dry_sun = {bilinear<F>(tap, PlaneId::kSunColorR, p.shift_r),
                       bilinear<F>(tap, plane_after(PlaneId::kSunColorR, 1), p.shift_g),
                       bilinear<F>(tap, plane_after(PlaneId::kSunColorR, 2), p.shift_b)};
        });
      });
    }
    strip.probe([&](Pixel<F>& p, const auto& tap) {
      const F surface = given<F>(c.eye_above) + dot(up, p.surface_point);
      // From within the water the view is straight.
      const Vec3<F> straight = p.surface_point + offset_to(c, p, p.shift, p.hit_depth);
      const auto from_air = p.side > F(0.5);
      const auto seen_bottom = sees_bottom(p);
      if_any(seen_bottom, [&] {
        const Aim<F> aim = aim_of(c, p, given<F>(c.ior));
        const F drop = select(seen_bottom && from_air, p.path * aim.fall, F(0));
        const F along = dot(vec3_of<F>(c.forward), aim.direction);
        const F eye_depth =
            select(from_air, p.surface_depth + min(p.path, F(1e6)) * along, p.hit_depth);
        const F texel = caustics_texel(c, eye_depth, abs(dot(up, p.to_viewer)));
        const F deep =
            select(from_air, drop - surface, F(0) - (given<F>(c.eye_above) + dot(up, straight)));
        const auto lit_bottom = seen_bottom && deep > F(0);
        const F depth = select(lit_bottom, deep, F(0));

        const auto end_of = [&](const Aim<F>& ended) {
          return select(from_air, p.surface_point + (drop / ended.fall) * ended.direction,
                        straight);
        };
        /// The entry point under calm water of the sunlight that reaches a place.
        const auto entry_of = [&](Vec3<F> end, F index) {
          const F sine = given<F>(light.sine, "caustics.sine") / index;
          const F aside = depth / (index * sqrt(F(1) - sine * sine));
          return Vec2<F>{dot(map_x, end) + aside * sunwards.x,
                         dot(map_y, end) + aside * sunwards.y};
        };
        // The shadow plane shows the object that hides a place of the layer below, or of the bottom
        // that is filled in, in the share `filled`.
        const F dry =
            planes.below ? bilinear_depth<F>(tap, PlaneId::kDepth, tap.quad(p.shift)) : p.hit_depth;
        const F filled = p.filled, mixed = saturate(F(8) * filled);
        // On a layer that is not lit no shadow moves.
        const bool in_sun_alone = c.bottom_layer && c.bottom_layer->lit;
        const F in_sun = in_sun_alone ? filled : F(0);
        const auto hidden = dry < F(kSameDepth) * p.hit_depth;
        const F of_plane = shadowed ? bilinear<F>(tap, PlaneId::kShadow, p.shift) : F(1);
        const F lit = select(lit_bottom && !hidden, of_plane, F(1));
        Tilt<F> tilt{F(1), F(1)};
        if (light.bends) {
          const auto sloped =
              lit_bottom && !hidden && given<F>(table.slopes, "caustics.slopes") > F(0);
          if_any(sloped, [&] {
            const Tilt<F> own = tilt_of(c, p, tap, light, sunwards);
            const auto if_sloped = [&](F of_slope) {
              return select(sloped, filled_in(of_slope, filled), F(1));
            };
            tilt = {if_sloped(own.of_level), if_sloped(own.gain)};
          });
        }
        const Vec3<F> end = end_of(aim);
        const Vec2<F> entry = entry_of(end, given<F>(c.ior));
        Sunlit<F> sunlit{lit, F(1), F(1), F(0)};
        if (light.moves) {
          const F per_rise = given<F>(1 / light.rise, "caustics.per_rise");
          const Vec2<F> level{dot(map_x, end) + depth * per_rise * sunwards.x,
                              dot(map_y, end) + depth * per_rise * sunwards.y};
          const auto of_bottom = [&] {
            const Vec2<F> by = entry - level;
            return shifted(c, p, tap, light, end, by.x * map_x + by.y * map_y, lit, hidden, in_sun);
          };
          if (light.entries) {
            sunlit = moved(c, p, tap, end, entry, level, lit, hidden, in_sun);
            const auto unknown = lit_bottom && !hidden && sunlit.known < F(1);
            if_any(unknown, [&] {
              const F more = (F(1) - sunlit.known) * (of_bottom().arrives - sunlit.dry);
              sunlit.arrives = sunlit.arrives + select(unknown, more, F(0));
            });
          } else {
            sunlit = of_bottom();
          }
        }
        if (!in_sun_alone) {
          sunlit.dry = filled_in(sunlit.dry, filled);
          sunlit.arrives = filled_in(sunlit.arrives, filled);
        }
        if (light.moves) {
          p.dry_lit = select(lit_bottom, sunlit.dry, p.dry_lit);
          p.dry_lit_known = select(lit_bottom, sunlit.hidden_known, p.dry_lit_known);
        }
        const auto of_channel = [&](auto i, const std::array<double, 3>& values, const char* name) {
          return pick<F>(i, given<F>(values[0], name, 0), given<F>(values[1], name, 1),
                         given<F>(values[2], name, 2));
        };
        Rgb<F> focused{F(1), F(1), F(1)};
        if (params.strength != 0 && split) {
          std::array<Vec2<F>, 3> entries{entry, entry, entry};
          each<F>(3, [&](auto i) {
            const F apart = pick<F>(i, p.dispersion.r, p.dispersion.g, p.dispersion.b);
            if_any(abs(apart) > F(0), [&] {
              const F index = given<F>(c.ior) + apart;
              const Vec2<F> own = entry_of(end_of(aim_of(c, p, index)), index);
              only<F>(i, 0, [&] { entries[0] = own; });
              only<F>(i, 1, [&] { entries[1] = own; });
              only<F>(i, 2, [&] { entries[2] = own; });
            });
          });
          focused = caustics_of_colors(table, tap, entries, texel);
        } else if (params.strength != 0) {
          const F of_all = caustics_at(table, tap, entry, texel);
          focused = {of_all, of_all, of_all};
        }
        const auto& scattered = table.scattered;
        const bool scatters = scattered[0] > 0 || scattered[1] > 0 || scattered[2] > 0;
        Rgb<F> made = p.transmitted;
        each<F>(3, [&](auto i) {
          const F transmitted = pick<F>(i, p.transmitted.r, p.transmitted.g, p.transmitted.b);
          F strength = given<F>(params.strength);
          if (scatters) {
            const F rate = of_channel(i, scattered, "caustics.scattered");
            strength = strength * exp((F(0) - rate) * depth);
          }
          const F light_here = pick<F>(i, focused.r, focused.g, focused.b);
          const F gain = F(1) + strength * (light_here - F(1));
          F sun(0);
          if (light.known) {
            const F shown = pick<F>(i, p.dry_sun.r, p.dry_sun.g, p.dry_sun.b);
            const F around = of_channel(i, light.around, "caustics.around");
            const F part = sunlit.dry * around;
            const F as_around = part / max(part + F(1) - around, F(1e-6)) * transmitted;
            const F seen = select(hidden, as_around, shown + mixed * (as_around - shown));
            sun = min(max(seen, F(0)), max(transmitted, F(0)));
          } else {
            const F direct = sunlit.dry * of_channel(i, light.sun, "caustics.sun");
            const F ambient = of_channel(i, light.ambient, "caustics.ambient");
            sun = direct / max(direct + ambient, F(1e-30)) * transmitted;
          }
          const F rest = transmitted - sun;
          F whole = tilt.gain * sun;
          if (light.moves) {
            const F over_rest = of_channel(i, table.sun_over_rest, "caustics.sun_over_rest");
            const F removed = (F(1) - sunlit.dry) * max(rest, F(0)) * over_rest * tilt.of_level;
            whole = sunlit.arrives * (whole + removed);
          }
          const F all = select(lit_bottom, rest + gain * whole, transmitted);
          only<F>(i, 0, [&] { made.r = all; });
          only<F>(i, 1, [&] { made.g = all; });
          only<F>(i, 2, [&] { made.b = all; });
        });
        p.transmitted = made;
      });
    });
  }

 private:
  /// Sunlight on a slope, refracted by calm water.
  template <class F>
  struct Tilt {
    F of_level;  ///< over that on level bottom
    F gain;      ///< over the unrefracted light there
  };
  /// Lambert's law: light that falls along (aside, -1) onto a slope with the normal (level, rise)
  /// gives rise + level aside of its light on level bottom.
  template <class F, class Tap>
  static LIMPID_INLINE Tilt<F> tilt_of(const Pass& c, const Pixel<F>& p, const Tap& tap,
                                       const Light& light, Vec2<F> sunwards) {
    const SeenSlope<F> slope = seen_slope(c, p, tap, p.shift);
    const F level = dot(vec3_of<F>(c.map_x), slope.normal) * sunwards.x +
                    dot(vec3_of<F>(c.map_y), slope.normal) * sunwards.y;
    const F rise = dot(vec3_of<F>(c.up), slope.normal);
    const F sine = given<F>(light.sine, "caustics.sine") / given<F>(c.ior);
    const F refracted = rise + level / (given<F>(c.ior) * sqrt(F(1) - sine * sine));
    const F straight = rise + level * given<F>(1 / light.rise, "caustics.per_rise");
    const F of_level = min(max(refracted, F(0)), F(kMostTilt));
    const F gain = min(of_level / max(straight, F(1e-3)), F(kMostTilt));
    // The ray's end may lie half a texel from the texel's centre.
    const F off =
        abs(F(1) - p.hit_depth / slope.depth) / (F(1 - kSameDepth) + F(0.5) * slope.steps);
    const F share = saturate(F(2) - off);
    const auto known = share > F(0) && dot(slope.normal, slope.normal) > F(0);
    const auto if_known = [&](F of_slope) {
      return select(known, F(1) + share * (of_slope - F(1)), F(1));
    };
    return {if_known(of_level), if_known(gain)};
  }

  template <class F>
  struct Aim {
    Vec3<F> direction;
    F fall;  ///< distance from the calm surface gained per unit of the ray
  };
  template <class F>
  static LIMPID_INLINE Aim<F> aim_of(const Pass& c, const Pixel<F>& p, F index) {
    const Vec3<F> direction = refract(p.to_viewer, p.normal, F(1) / index).direction;
    return {direction, max(F(0) - dot(vec3_of<F>(c.up), direction), F(0.02))};
  }
};

}  // namespace limpid
