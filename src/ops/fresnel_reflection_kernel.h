#pragma once
#include <cmath>
#include <numbers>

#include "limpid/ops/fresnel_reflection.h"

#include "op/operator.h"
#include "op/skyline.h"
#include "ops/mirrored_light.h"
#include "optics/facets.h"
#include "optics/fresnel.h"
#include "optics/refract.h"
#include "optics/surroundings.h"

namespace limpid {

template <>
struct Kernel<FresnelReflection> : MirroredLight {
  static constexpr StateSet kUses{StatePart::kNormal, StatePart::kSlopeVariance,
                                  StatePart::kTransmittance, StatePart::kTransmitted,
                                  StatePart::kInScatter};
  static constexpr StateSet kMakes{StatePart::kFresnel, StatePart::kReflected,
                                   StatePart::kMirrorSources, StatePart::kTransmitted,
                                   StatePart::kInScatter};
  static PlaneSet reads(const Params& p) {
    PlaneSet planes;
    if (p.source == Source::kAuto) planes = kColorPlanes | PlaneSet{PlaneId::kDepth} | kSkyPlanes;
    const bool finds_ends = p.source == Source::kPlanar && p.lookup == Lookup::kRay;
    if (p.source == Source::kAuto || finds_ends) {
      planes = planes | kAlbedoPlanes | kColorPlanes | PlaneSet{PlaneId::kDepth, PlaneId::kShadow};
    }
    if (p.source == Source::kAuto || p.source == Source::kPlanar) {
      planes = planes | kReflectionPlanes | PlaneSet{PlaneId::kReflectionValid};
      if (p.lookup == Lookup::kRay) planes = planes | PlaneSet{PlaneId::kReflectionDepth};
    }
    return planes;
  }
  static PlaneSet wants(const Params& p, const AtHand& has) {
    if (p.source != Source::kAuto) return {};
    if (has.planes.covers(kReflectionPlanes)) {
      if (p.lookup == Lookup::kOffset) return {};
      return {PlaneId::kReflectionDepth, PlaneId::kReflectionValid};
    }
    return has.environment ? PlaneSet{} : kSkyPlanes;
  }
  static Needs needs(const Params& p) {
    return {.planes = p.source == Source::kPlanar ? kReflectionPlanes : PlaneSet{},
            .environment = p.source == Source::kEnvironment};
  }
  static double reach(const Params& p) {
    if (p.source == Source::kAuto) return HUGE_VAL;
    if (p.source != Source::kPlanar) return 0;
    return p.lookup == Lookup::kRay ? HUGE_VAL : abs(p.strength);
  }
  static bool neutral(const Params&, StateSet) { return false; }
  static double bound(const Params& params, const Pass& c, const Ranges& ranges);
  static void propagate_ranges(const Params& params, const Pass& c, Ranges& ranges);

  static constexpr bool kLooksAbove = true;
  /// The light that it dims is counted already.
  static double displaced(const Params&, const Ranges&) { return 0; }
  /// Without a reflection, a picture of the surroundings is the best mirror.
  static std::string_view prefer(Params& params, const AtHand& has);
  /// Where the mirror has no valid texel, the surroundings are reflected, if the job has a picture
  /// of them.
  static std::string_view looks_around(const Params& params, const AtHand& has);
  /// For a reflection without a depth: its rays end infinitely far.
  static std::string_view warning(const Params& params, const AtHand& has);
  static double ns(const Params& params, const Running& running);

  template <class Strip>
  static void apply(const Params& params, const Pass& c, Strip& strip) {
    using F = typename Strip::Number;
    if (params.facets == Facets::kSpread && c.made.has(StatePart::kSlopeVariance)) {
      return strip.probe([&](Pixel<F>& p, const auto& tap) { mirror_facets(params, c, p, tap); });
    }
    strip.each([&](Pixel<F>& p) { p.fresnel = reflectance(params, c, p, p.normal); });
    if (params.source == Source::kConstant) {
      return strip.each([&](Pixel<F>& p) {
        tell(c, from_far<F>(), p);
        blend(c, p.fresnel * constant<F>(params), p);
      });
    }
    if (looks_once(params, c)) {
      return strip.bilinear_rgb(
          PlaneId::kReflectionR,
          [&](const Pixel<F>& p) {
            return params.lookup == Lookup::kRay
                       ? place_at(c, p, image_ray(c, p, p.normal), F(HUGE_VAL))
                       : given<F>(params.strength) * p.tilt;
          },
          [&](Pixel<F>& p, Rgb<F> mirrored) {
            tell(c, from_reflection<F>(), p);
            blend(c, p.fresnel * mirrored, p);
          });
    }
    strip.probe([&](Pixel<F>& p, const auto& tap) {
      const Mirrored<F> seen = mirrored(params, c, p, tap, p.normal, p.tilt);
      tell(c, seen.sources, p);
      blend(c, p.fresnel * seen.light, p);
    });
  }

 private:
  template <class F>
  static LIMPID_INLINE F from_above(const Params& params, const Pass& c, const Pixel<F>& p,
                                    Vec3<F> n) {
    const F cosine = dot(p.to_viewer, n);
    switch (params.reflectance) {
      case Reflectance::kRim:
        return fresnel_rim(cosine, params.power);
      case Reflectance::kLinear:
        return fresnel_linear(dot(p.to_viewer, vec3_of<F>(c.up)));
      case Reflectance::kInversePower:
        return fresnel_inverse_power(cosine, given<F>(params.intensity), params.power);
      case Reflectance::kSchlick:
        return fresnel_schlick(cosine, given<F>(params.f0));
      case Reflectance::kExact:
        break;
    }
    return fresnel_exact(cosine, given<F>(c.ior));
  }

  template <class F>
  static LIMPID_INLINE F reflectance(const Params& params, const Pass& c, const Pixel<F>& p,
                                     Vec3<F> n) {
    const F above = from_above(params, c, p, n);
    if (!c.submersible) return above;
    const F below = fresnel_exact(F(0) - dot(p.to_viewer, n), given<F>(1 / c.ior, "water.per_ior"));
    return select(p.side > F(0), above, select(p.side < F(0), below, F(0)));
  }

  template <class F>
  static LIMPID_INLINE void tell(const Pass& c, Rgb<F> sources, Pixel<F>& p) {
    if (c.made.has(StatePart::kMirrorSources)) p.mirror_sources = sources;
  }

  /// The share left of the light from below, and the mirrored light times the reflectance.
  template <class F>
  static LIMPID_INLINE void blend(const Pass& c, Rgb<F> reflected, Pixel<F>& p) {
    const F through = F(1) - p.fresnel;
    p.transmitted = through * p.transmitted;
    p.reflected = reflected;
    const Rgb<F> dimmed = through * p.in_scatter;
    if (!c.submersible) {
      p.in_scatter = dimmed;
      return;
    }
    const auto below = p.side < F(0);
    p.in_scatter = select(below, p.in_scatter, dimmed);
    p.reflected = select(below, p.transmittance * p.reflected, p.reflected);
  }

  // --- facets -----------------------------------------------------------------------------------

  /// Reflectance times mirrored light, and the reflectance, of the mean facet or, where the pixel
  /// cannot resolve the waves, averaged over three facets along the view, the direction in which
  /// the reflectance changes most.
  template <class F, class Tap>
  static void mirror_facets(const Params& params, const Pass& c, Pixel<F>& p, const Tap& tap) {
    const Vec3<F> up = vec3_of<F>(c.up);
    const Vec3<F> level = p.to_viewer - dot(up, p.to_viewer) * up;
    const Vec3<F> near = normalize_or(level, vec3_of<F>(c.b));
    const F variance = along(
        p.slope_variance, Vec2<F>{dot(near, vec3_of<F>(c.map_x)), dot(near, vec3_of<F>(c.map_y))});
    const auto rough = variance > F(kLeastVariance);
    const F deviation = sqrt(max(variance, F(kLeastVariance))), rise = dot(up, p.normal);
    ThreeFacets<F> facets{{F(0), F(0), F(0)}, {F(1), F(0), F(0)}};
    const bool looks = marched(params, c).has_value();
    Outlook<F> outlook{{F(1), F(1), F(1)}, F(0), F(0)};
    if_any(rough, [&] {
      const ThreeFacets<F> some = facets_of(c, p, near, length(level), deviation);
      for (int i = 0; i < 3; ++i) {
        facets.lean[i] = select(rough, deviation * some.lean[i], facets.lean[i]);
        facets.share[i] = select(rough, some.share[i], facets.share[i]);
      }
      if (looks) {
        const auto above = rough && tap.wet() && p.side > F(0);
        if_any(above, [&] {
          const Outlook<F> to =
              outlook_of(params, c, p, tap, some, above, near, length(level), deviation);
          outlook.parts = select(above, to.parts, outlook.parts);
          outlook.low = select(above, to.low, outlook.low);
          outlook.high = select(above, to.high, outlook.high);
        });
      }
    });
    const Rgb<F> black{F(0), F(0), F(0)};
    Rgb<F> light = black, sources = black;
    F reflected(0);
    steps<F>(0, 3, [&](auto i) {
      const F lean = pick<F>(i, facets.lean[0], facets.lean[1], facets.lean[2]);
      const F share = pick<F>(i, facets.share[0], facets.share[1], facets.share[2]);
      const auto leaned = [&](F by) {
        Vec3<F> facet = p.normal;
        if_any(rough, [&] {
          facet = select(rough, normalize_or(facet + (by * rise) * near, facet), facet);
        });
        return facet;
      };
      const Vec3<F> facet = leaned(lean), n = bent(c, p, facet);
      const F fresnel = share * reflectance(params, c, p, n);
      const Vec2<F> tilt{dot(facet, vec3_of<F>(c.t)), F(0) - dot(facet, vec3_of<F>(c.b))};
      Mirrored<F> one{black, black};
      if (looks) {
        const F part = pick<F>(i, outlook.parts.x, outlook.parts.y, outlook.parts.z);
        const F low = select(part < F(1), min(lean, outlook.low), lean);
        const F over = reads_planes(params, c)
                           ? max(lean_over(facets, i, part, low), max(lean, outlook.high))
                           : lean;
        const Vec3<F> lower = bent(c, p, leaned(low)), higher = bent(c, p, leaned(over));
        const Again<F> again = again_of(c, p, tap, facet);
        F meets_again(0);
        // The reflection's planes show where the rays of the next wave end without a march.
        const bool marches = c.raised && !reads_planes(params, c);
        steps<F>(0, marches ? 2 : 1, [&](auto turn) {
          const auto second = pick<F>(turn, F(0), F(1), F(1)) > F(0.5);
          const F again_part = select(meets_again > F(0), F(1), F(0));
          // A ray below the skyline that meets nothing has passed behind a visible object, like a
          // tree's crown, and ends where the picture shows nothing. If it passes not far behind, it
          // sees that object.
          F open(1);
          Mirrored<F> now{black, black};
          steps<F>(0, reads_planes(params, c) ? 1 : 2, [&](auto k) {
            const F thicker = pick<F>(k, F(1), F(kThicker), F(kThicker));
            const Mirrored<F> seen = seen_on_march(
                params, c, p, tap, select(second, again.facet, n), select(second, again_part, part),
                select(second, again.facet, lower), select(second, again.facet, higher), thicker);
            const auto take = open > F(0.5);
            now = {select(take, seen.light, now.light), select(take, seen.sources, now.sources),
                   select(take, seen.distance, now.distance)};
            const auto passed = rough && p.side > F(0) && part >= F(1) && !second;
            const auto lost = take && passed && seen.sources.g < F(0.5);
            open = select(lost, F(1), F(0));
            return lost;
          });
          only<F>(turn, 0, [&] {
            one = now;
            if (!c.raised) return;
            // A ramp from 0: what hardly any ray meets is not looked up.
            const F meets = again.share * (F(1) - part * again.before(c, now.distance));
            meets_again = max(meets - F(kSeldom), F(0)) * F(1 / (1 - kSeldom));
          });
          only<F>(turn, 1, [&] { one = again.mixed(p, meets_again, one, now); });
          return meets_again > F(0);
        });
        if (c.raised && !marches) {
          const auto meets = meets_again > F(0);
          if_any(meets, [&] {
            const End<F> end = follow(c, p, tap, again.facet);
            one = again.mixed(p, meets_again, one, seen_at(c, p, tap, again.facet, end));
          });
        }
      } else {
        one = mirrored(params, c, p, tap, n, tilt);
      }
      reflected = reflected + fresnel;
      light = light + fresnel * one.light, sources = sources + share * one.sources;
      return rough;
    });
    p.fresnel = reflected;
    tell(c, sources, p);
    blend(c, light, p);
  }

  /// The facets that represent a pixel's slopes, whose deviation is taken along `near`, the level
  /// direction to the viewer; `level` is the view's length along it.
  template <class F>
  static LIMPID_INLINE ThreeFacets<F> facets_of(const Pass& c, const Pixel<F>& p, Vec3<F> near,
                                                F level, F deviation) {
    const Vec3<F> up = vec3_of<F>(c.up);
    const F rise = max(dot(up, p.normal), F(1e-6)), per_rise = F(1) / (rise * deviation);
    // The facet half way between the view and a ray along the water leans away by half its angle.
    const F half = dot(up, p.to_viewer) / (F(1) + level);
    const auto above = p.side > F(0);
    const F lowest = select(above, dot(near, p.normal) * per_rise + half / deviation, F(9));
    ThreeFacets<F> facets = plane_facets(lowest);
    const F raised = given<F>(c.plate_waves.raised, "plate_waves.raised");
    const auto blends = above && raised > F(0);
    if_any(blends, [&] {
      const ThreeFacets<F> seen =
          seen_facets(dot(p.to_viewer, p.normal) * per_rise / max(level, F(1e-6)));
      const auto blend = [&](F from, F to) {
        return select(blends, from + raised * (to - from), from);
      };
      for (int i = 0; i < 3; ++i) {
        facets.lean[i] = blend(facets.lean[i], seen.lean[i]);
        facets.share[i] = blend(facets.share[i], seen.share[i]);
      }
    });
    return facets;
  }
  static constexpr double kLeastVariance = 1e-4, kThicker = 4;

  /// The skyline as a pixel that cannot resolve its waves mirrors it. Three rays meet a bank or
  /// pass over it, all or none of a third of the facets, and would draw dashes at its foot: so the
  /// facets are parted where their rays pass the skyline.
  template <class F>
  struct Outlook {
    Vec3<F> parts;  ///< for each facet, the share of its facets whose rays stay below the skyline
    F low, high;  ///< slopes from the mean facet to facets whose rays meet the object there or not
  };
  /// Rays of a facet of which only a part meets the object are followed to the share kWithin of
  /// its height. The rays of the other part rise at least to kOver times its height, because the
  /// object's edge is not known better.
  static constexpr double kWithin = 0.75, kOver = 1.05;

  template <class F, class Tap, class Mask>
  static Outlook<F> outlook_of(const Params& params, const Pass& c, const Pixel<F>& p,
                               const Tap& tap, const ThreeFacets<F>& facets, const Mask& lanes,
                               Vec3<F> near, F level, F deviation) {
    const Vec3<F> up = vec3_of<F>(c.up), ray = mirrored_ray(c, p, bent(c, p, p.normal));
    const Vec3<F> ahead = normalize_or(ray - dot(up, ray) * up, F(-1) * near);
    const F sine = skyline(c, tap, lanes, PlaneId::kDepth, c.dry, p, ScreenRay<F>(c, p, ahead + up),
                           ahead, reads_planes(params, c) ? kImageSteps.steps : kPictureSteps.steps,
                           !reads_planes(params, c));
    const F rise = max(dot(up, p.normal), F(1e-6)), eye = dot(up, p.to_viewer);
    // From the mean facet to the one half way between the view and a ray that rises so far.
    const auto lean_to = [&](F s) {
      return (s - eye) / (level + sqrt(max(F(1) - s * s, F(1e-6)))) - dot(near, p.normal) / rise;
    };
    const F lean = lean_to(sine) / deviation;
    F under = plane_share_under(lean);
    const F raised = given<F>(c.plate_waves.raised, "plate_waves.raised");
    const auto blends = raised > F(0);
    if_any(blends, [&] {
      const F facing = dot(p.to_viewer, p.normal) / (rise * deviation * max(level, F(1e-6)));
      under = select(blends, under + raised * (seen_share_under(facing, lean) - under), under);
    });
    Vec3<F> parts = parts_under(facets, select(sine > F(0), under, F(0)));
    if (reads_planes(params, c)) {
      // A reflection may show what the picture does not, as above its upper edge.
      const auto own = [](F part) { return select(part > F(0), part, F(1)); };
      parts = {own(parts.x), own(parts.y), own(parts.z)};
    }
    return {parts, lean_to(F(kWithin) * sine), lean_to(min(F(kOver) * sine, F(1)))};
  }

  /// The lean of those of the i-th of the facets that pass over the skyline, if the share `part` of
  /// them leans `low`: the mean lean of both stays, but this lean ends half way to the next facet,
  /// or as far beyond the highest.
  template <class F, class Step>
  static LIMPID_INLINE F lean_over(const ThreeFacets<F>& facets, Step i, F part, F low) {
    const auto& [middle, highest, lowest] = facets.lean;
    const F lean = pick<F>(i, middle, highest, lowest);
    const F end = F(0.5) * pick<F>(i, middle + highest, F(3) * highest - middle, lowest + middle);
    return min(end, (lean - part * low) / max(F(1) - part, F(1e-3)));
  }

  /// Where waves raise the water, the waves that the rays of a facet meet again.
  template <class F>
  struct Again {
    F share;        ///< of the rays, if nothing stands before these waves
    F reflectance;  ///< of these waves
    Vec3<F> facet;  ///< mirrors the view as facet and wave together do

    /// `own` light and that of the waves, which mirror `next`, in the share that meets them.
    Mirrored<F> mixed(const Pixel<F>& p, F meets, const Mirrored<F>& own,
                      const Mirrored<F>& next) const {
      const auto mix = [&](Rgb<F> from, Rgb<F> to) {
        return select(meets > F(0), from + meets * (to - from), from);
      };
      const Rgb<F> body = p.transmitted + p.in_scatter;
      return {mix(own.light, body + reflectance * (next.light - body)),
              mix(own.sources, next.sources), own.distance};
    }

    /// The share of the rays that meet something at a distance before they meet waves, which are
    /// half of the mean wavelength of the slopes away.
    F before(const Pass& c, F distance) const {
      const Sym2<double>& turn = c.plate_waves.turn;
      const double per_length = std::sqrt(std::max(turn.xx + turn.yy, 0.0)) / std::numbers::pi;
      const F ways = given<F>(per_length, "plate_waves.per_length") * min(distance, F(1e20));
      return select(distance < F(1e20), exp(F(0) - ways), F(0));
    }
  };
  template <class F, class Tap>
  static Again<F> again_of(const Pass& c, const Pixel<F>& p, const Tap& tap, Vec3<F> facet) {
    Again<F> again{F(0), F(1), facet};
    if (!c.raised) return again;
    const Vec3<F> up = vec3_of<F>(c.up), ray = mirror(p.to_viewer, facet);
    const F sine = dot(up, ray);
    const auto low = tap.wet() && p.side > F(0) && sine < F(kLowRay);
    if_any(low, [&] {
      const Vec3<F> level = ray - sine * up, ahead = normalize_or(level, vec3_of<F>(c.b));
      const Sym2<double>& v = c.plate_waves.variance;
      const Sym2<F> variance{given<F>(v.xx, "plate_waves.variance", 0),
                             given<F>(v.xy, "plate_waves.variance", 1),
                             given<F>(v.yy, "plate_waves.variance", 2)};
      const F square = along(
          variance, Vec2<F>{dot(ahead, vec3_of<F>(c.map_x)), dot(ahead, vec3_of<F>(c.map_y))});
      const auto some = low && square > F(kLeastWaves);
      const auto per_level = [&](const Vec3<F>& to) {
        const F high = dot(up, to);
        return high / max(length(to - high * up), F(1e-3));
      };
      const NextMeeting<F> next =
          next_meeting(per_level(ray), per_level(p.to_viewer), sqrt(max(square, F(kLeastWaves))));
      const F raised = given<F>(c.plate_waves.raised, "plate_waves.raised");
      const Vec3<F> on = normalize_or(ahead + next.rise * up, up);
      again.share = select(some, raised * next.share, F(0));
      again.reflectance = select(some, fresnel_exact(next.sine, given<F>(c.ior)), F(1));
      again.facet = select(some, normalize_or(p.to_viewer + on, facet), facet);
    });
    return again;
  }
  /// Slopes of 1e-3 mirror rays by less than a sun's breadth. Rays that rise more steeply do not
  /// meet waves of a slope that water has.
  static constexpr double kLeastWaves = 1e-6, kLowRay = 0.7, kSeldom = 0.01;

  /// A facet whose mirrored ray would go into the water, leaned until it goes along it: no such
  /// light comes from the waves of a flat plane. From below, as it is.
  template <class F>
  static LIMPID_INLINE Vec3<F> bent(const Pass& c, const Pixel<F>& p, Vec3<F> facet) {
    const Vec3<F> up = vec3_of<F>(c.up), ray = mirror(p.to_viewer, facet);
    const auto sunk = dot(up, ray) < F(0) && p.side > F(0);
    return select(sunk, normalize_or(p.to_viewer + lifted(ray, up), facet), facet);
  }
};

}  // namespace limpid
