#pragma once
#include <type_traits>

#include "limpid/ops/refraction.h"

#include "op/bottom_search.h"
#include "op/continuation.h"
#include "op/operator.h"
#include "op/screen_ray.h"
#include "ops/refracted_light.h"
#include "optics/refract.h"

/// @file
/// Where refracted rays end. ops/refracted_light.h has what the picture shows there.

namespace limpid {

template <>
struct Kernel<Refraction> : RefractedLight {
  static constexpr StateSet kUses{StatePart::kNormal, StatePart::kPrism, StatePart::kTransmitted};
  static constexpr StateSet kMakes{StatePart::kPosition, StatePart::kPath, StatePart::kDryBottom,
                                   StatePart::kTransmitted, StatePart::kConfidence};
  static PlaneSet reads(const Params& p) {
    PlaneSet planes = kColorPlanes | kBelowPlanes | PlaneSet{PlaneId::kDepth};
    if (p.rejection == Rejection::kShorten) planes = planes | PlaneSet{PlaneId::kSurfaceDepth};
    return planes;
  }
  static Needs needs(const Params&) { return {.planes = kColorPlanes}; }
  static double reach(const Params& p) {
    if (p.model == Model::kSnell) return HUGE_VAL;
    return abs(p.strength) + (p.model == Model::kDudvOffset ? kDudvShift / kLeastDeviceDepth : 0);
  }
  static bool neutral(const Params& p, StateSet made) {
    return p.model == Model::kNormalOffset && !made.has(StatePart::kPrism) &&
           (p.strength == 0 || !made.has(StatePart::kNormal));
  }
  static double bound(const Params& params, const Pass& c, const Ranges& ranges);
  static void propagate_ranges(const Params& params, const Pass& c, Ranges& ranges);

  static bool foreground_free(const Params& params, const InReach& reach);
  static double ns(const Params& params, const Running& running);

  template <class Strip>
  static void apply(const Params& params, const Pass& c, Strip& strip) {
    using F = typename Strip::Number;
    const SeenPlanes planes = SeenPlanes::of(c);
    switch (params.model) {
      case Model::kNormalOffset:
      case Model::kDudvOffset:
        aim_by_offset(params, c, strip);
        break;
      case Model::kSnell:
        aim_by_snell(params, c, planes, strip);
        break;
    }
    // A march knows the depth where it ends; but snap needs the depth seen there.
    const bool knows = params.model == Model::kSnell && params.steps != 0;
    if (!knows || params.rejection == Rejection::kSnap) {
      strip.nearest(
          planes.depth, [](const Pixel<F>& p) { return p.shift; },
          [](Pixel<F>& p, F depth) { p.hit_depth = depth; });
    }
    strip.each([&](Pixel<F>& p) {
      keep_in_frame(params, planes.bounds, p);
      p.dry_lit = F(1), p.dry_lit_known = F(0), p.filled = F(0);
    });
    if (params.rejection == Rejection::kSnap && !planes.below && c.foreground) {
      strip.each([](Pixel<F>& p) { snap(p); });
    }
    if (params.rejection == Rejection::kSnap && planes.below && c.bottomless) {
      strip.probe([&](Pixel<F>& p, const auto& tap) { snap_from_empty(planes, p, tap); });
    }
    if (params.rejection == Rejection::kShorten) {
      if (c.bottomless) {
        strip.probe(
            [&](Pixel<F>& p, const auto& tap) { look_up_valid_if_any(params, c, planes, p, tap); });
      } else {
        strip.probe(
            [&](Pixel<F>& p, const auto& tap) { look_up_valid<false>(params, c, planes, p, tap); });
      }
    } else {
      look_up(c, planes, strip);
      if (c.bottomless) {
        strip.probe([&](Pixel<F>& p, const auto& tap) { leave_out_nothing(c, planes, p, tap); });
      }
    }
    strip.each([&](Pixel<F>& p) {
      if (params.model != Model::kSnell) measure_path(c, p);
      if (params.off_frame == OffFrame::kFog) fog_off_frame(planes.bounds, p);
    });
    if (params.continues_bottom() && c.continuation) {
      strip.probe([&](Pixel<F>& p, const auto& tap) {
        // Beyond the frame no texel confirms the end of a ray.
        if_any(p.confidence <= F(0), [&] { go_on_off_frame(c, planes, p, tap); });
      });
    }
    if (c.made.has(StatePart::kDryBottom)) {
      strip.each([](Pixel<F>& p) { p.dry_bottom = p.transmitted; });
    }
  }

 private:
  static constexpr double kDudvShift = 0.001, kLeastDeviceDepth = 0.01;

  template <class F>
  static LIMPID_INLINE void place_channels(Vec2<F> r, Vec2<F> g, Vec2<F> b, Pixel<F>& p) {
    p.shift_r = r + p.prism_r;
    p.shift_g = g + p.prism_g;
    p.shift_b = b + p.prism_b;
  }

  // --- where to look ----------------------------------------------------------------------------

  /// In a thin prism the deviation grows with n - 1, and so do the channels' offsets.
  template <class Strip>
  static void aim_by_offset(const Params& params, const Pass& c, Strip& strip) {
    using F = typename Strip::Number;
    const F strength = given<F>(params.strength);
    const F per_index = given<F>(c.ior > 1 ? 1 / (c.ior - 1) : 0, "refraction.per_index");
    const bool dudv = params.model == Model::kDudvOffset;
    strip.each([&](Pixel<F>& p) {
      p.shift = strength * p.tilt;
      if (dudv) {
        const F shift = F(-kDudvShift) / max(c.device_depth(p.surface_depth), F(kLeastDeviceDepth));
        p.shift = p.shift + Vec2<F>{shift, shift};
      }
      p.shift = select(abs(p.side) > F(0.5), p.shift, Vec2<F>{F(0), F(0)});
      p.confidence = F(1);
      const auto bent = [&](F index) { return (F(1) + index * per_index) * p.shift; };
      place_channels(bent(p.dispersion.r), bent(p.dispersion.g), bent(p.dispersion.b), p);
    });
  }

  /// The refracted ray of one pixel, and how fast it falls away from the surface.
  template <class F>
  struct Bent {
    Vec3<F> direction;
    F fall;  ///< distance from the calm surface gained per unit of the ray
    F goes;  ///< 1, or 0 where nothing is refracted
  };
  template <class F>
  static LIMPID_INLINE Bent<F> bend(const Pass& c, const Pixel<F>& p, F ior) {
    const auto from_air = p.side > F(0);
    const Vec3<F> normal = select(from_air, p.normal, F(-1) * p.normal);
    const Refracted<F> ray = refract(p.to_viewer, normal, select(from_air, F(1) / ior, ior));
    const F rise = dot(vec3_of<F>(c.up), ray.direction);
    const auto goes = ray.total < F(0.5) && abs(p.side) > F(0.5);
    // A nearly level ray would never end; waves may even send a ray upwards.
    return {ray.direction, max(select(from_air, F(0) - rise, rise), F(0.02)),
            select(goes, F(1), F(0))};
  }

  template <class Strip>
  static void aim_by_snell(const Params& params, const Pass& c, const SeenPlanes& planes,
                           Strip& strip) {
    using F = typename Strip::Number;
    const F ior = given<F>(c.ior);
    const bool split = c.made.has(StatePart::kPrism);
    int expected = 0;
    strip.probe([&](Pixel<F>& p, const auto& tap) {
      const Bent<F> bent = bend(c, p, ior);
      const ScreenRay<F> ray(c, p, bent.direction);
      const BottomSearch<F, std::decay_t<decltype(tap)>> search{
          c, planes, p, tap, ray, bent.fall, params.thickness, expected};
      const auto found = params.marches() ? search.march() : search.iterate(params.steps);
      const auto goes = bent.goes > F(0.5);
      const Vec2<F> none{F(0), F(0)};
      p.path = select(goes, found.distance, F(0));
      p.shift = select(goes, ray.shift_at(found.distance), none);
      p.hit_depth = select(goes, ray.depth_at(found.distance), p.dry_depth);
      p.confidence = select(goes, found.sure, F(1));
      if (!split) return place_channels(p.shift, p.shift, p.shift, p);
      const auto channel = [&](F index) {
        Vec2<F> shift = p.shift;
        if_any(abs(index) > F(0), [&] {
          const Bent<F> own = bend(c, p, ior + index);
          const ScreenRay<F> own_ray(c, p, own.direction);
          shift = select(goes, own_ray.shift_at(found.distance * bent.fall / own.fall), none);
        });
        return shift;
      };
      place_channels(channel(p.dispersion.r), channel(p.dispersion.g), channel(p.dispersion.b), p);
    });
  }

  // --- off the frame ----------------------------------------------------------------------------

  template <class F>
  static LIMPID_INLINE void keep_in_frame(const Params& params, const Bounds& bounds, Pixel<F>& p) {
    const auto inside = [&](Vec2<F> shift) { return reach_in(bounds, p.uv, shift) >= F(1); };
    p.confidence = select(inside(p.shift), p.confidence, F(0));
    if (params.off_frame == OffFrame::kClamp) return;
    const auto shortened = [&](Vec2<F> shift) {
      return min(reach_in(bounds, p.uv, shift), F(1)) * shift;
    };
    const bool shortens = params.off_frame == OffFrame::kShorten;
    if (shortens || params.off_frame == OffFrame::kContinue) p.shift = shortened(p.shift);
    p.shift_r = shortened(p.shift_r);
    p.shift_g = shortened(p.shift_g);
    p.shift_b = shortened(p.shift_b);
  }

  template <class F>
  static LIMPID_INLINE void fog_off_frame(const Bounds& b, Pixel<F>& p) {
    const auto beyond = [](F at, F low, F high) { return max(max(low - at, at - high), F(0)); };
    const F over = max(beyond(p.uv.x + p.shift.x, given<F>(b.low.x), given<F>(b.high.x)),
                       beyond(p.uv.y + p.shift.y, given<F>(b.low.y), given<F>(b.high.y)));
    const F kept = saturate(F(1) - F(20) * over);
    p.transmitted = kept * p.transmitted;
    p.path = select(kept > F(0), p.path / max(kept, F(1e-30)), F(HUGE_VAL));
  }

  /// Replaces the guess beyond the frame: the path of these rays still ends where the picture's
  /// depths would end it.
  template <class F, class Tap>
  [[gnu::noinline]] static void go_on_off_frame(const Pass& c, const SeenPlanes& planes,
                                                Pixel<F>& p, const Tap& tap) {
    const Bent<F> bent = bend(c, p, given<F>(c.ior));
    const ScreenRay<F> ray(c, p, bent.direction);
    const auto ends = bent.goes > F(0.5) && p.side > F(0) && p.path < F(1e20);
    const auto off =
        ends && p.confidence <= F(0) && reach_in(planes.bounds, p.uv, ray.shift_at(p.path)) < F(1);
    if_any(off, [&] {
      const OffFrameRay<F, Tap> end(c, planes, p, tap, ray, bent.direction, bent.fall);
      const auto seen = end.look(select(off, p.path, F(1)));
      p.path = select(off, seen.distance, p.path);
      p.hit_depth = select(off, ray.depth_at(seen.distance), p.hit_depth);
      p.transmitted = select(off, seen.color, p.transmitted);
      p.shift = select(off, seen.shift, p.shift);
      p.dry_lit_known = select(off, F(0), p.dry_lit_known);
      p.filled = select(off, F(0), p.filled);
      p.shift_r = select(off, seen.shift, p.shift_r);
      p.shift_g = select(off, seen.shift, p.shift_g);
      p.shift_b = select(off, seen.shift, p.shift_b);
    });
  }

  // --- the path ---------------------------------------------------------------------------------

  /// The path to a flat bottom at the depth found, below a calm surface.
  template <class F>
  static LIMPID_INLINE void measure_path(const Pass& c, Pixel<F>& p) {
    const F cosine = abs(dot(vec3_of<F>(c.up), p.to_viewer));
    const F bent = refracted_cosine(
        cosine, select(p.side > F(0), given<F>(1 / c.ior, "water.per_ior"), given<F>(c.ior)));
    const F straight = p.ray_length * max(p.hit_depth - p.surface_depth, F(0));
    p.path = straight * cosine / max(bent, F(0.02));
  }
};

}  // namespace limpid
