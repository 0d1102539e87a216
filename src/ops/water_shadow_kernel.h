#pragma once
#include "limpid/ops/water_shadow.h"

#include "op/operator.h"
#include "op/screen_ray.h"
#include "op/sun_search.h"
#include "ops/path_light.h"

namespace limpid {

template <>
struct Kernel<WaterShadow> : WaterShadow {
  static constexpr StateSet kUses{StatePart::kPosition, StatePart::kPath, StatePart::kTransmitted,
                                  StatePart::kInScatter, StatePart::kSunScatter};
  static constexpr StateSet kMakes{StatePart::kTransmitted, StatePart::kInScatter};
  static PlaneSet reads(const Params& p) {
    if (p.model == Model::kDarken) return {PlaneId::kShadow};
    const PlaneSet shadows{PlaneId::kShadow, PlaneId::kSurfaceShadow};
    return p.strength > 0 ? shadows | PlaneSet{PlaneId::kDepth} : shadows;
  }
  static PlaneSet wants(const Params& p, const AtHand&) {
    return p.model == Model::kScatter ? PlaneSet{PlaneId::kSurfaceShadow} : PlaneSet{};
  }
  static Needs needs(const Params& p) {
    const bool scatters = p.model == Model::kScatter;
    return {.planes = scatters ? PlaneSet{} : PlaneSet{PlaneId::kShadow}, .sun = scatters};
  }
  static bool wants_shafts(const Params& p) { return p.model == Model::kScatter && p.shafts > 0; }
  /// Beyond the reach of refraction: sunlight may enter anywhere.
  static double reach(const Params& p) { return p.model == Model::kScatter ? HUGE_VAL : 0; }
  /// Whether it looks up the shadow on the surface, in frames that have it.
  static bool probes(const Params& p, StateSet made) {
    return p.model == Model::kScatter && !neutral(p, made);
  }
  static bool neutral(const Params& p, StateSet made) {
    return (p.strength == 0 && !wants_shafts(p)) ||
           (p.model == Model::kScatter && !made.has(StatePart::kSunScatter));
  }
  static double bound(const Params& params, const Pass& c, const Ranges& ranges);
  static void propagate_ranges(const Params& params, const Pass& c, Ranges& ranges);
  /// If the shadow is looked up at another place in reach, or as if no sunlight were scattered at
  /// the end of the path.
  static double displaced(const Params& params, const Ranges& ranges);

  static constexpr CellKind kSkipped{"lit", "no shadow falls on the water"};
  static double ns(const Params& p, const Running& running) {
    if (p.model == Model::kDarken) return 1.2;
    const bool entries = (running.planes | running.completed).has(PlaneId::kSurfaceShadow);
    const double search = p.strength > 0 ? 25 : 0;
    const double looks = entries ? 21.6 : running.planes.has(PlaneId::kShadow) ? 1.6 : search;
    return looks + (wants_shafts(p) ? 24.4 : 0);
  }

  template <class Strip>
  static void apply(const Params& params, const Pass& c, Strip& strip) {
    using F = typename Strip::Number;
    const F strength = given<F>(params.strength);
    const auto where = [](const Pixel<F>& p) { return p.shift; };
    if (params.model == Model::kDarken) {
      strip.bilinear(PlaneId::kShadow, where, [&](Pixel<F>& p, F shadow) {
        const F keep = F(1) - strength * (F(1) - shadow);
        p.transmitted = keep * p.transmitted;
        p.in_scatter = keep * p.in_scatter;
      });
      return;
    }
    const auto take = [&](Pixel<F>& p, F shade, Rgb<F> lit) {
      const Rgb<F> left = p.in_scatter - strength * shade * lit;
      p.in_scatter = {max(left.r, F(0)), max(left.g, F(0)), max(left.b, F(0))};
    };
    const CausticsTable* table = c.caustics ? c.caustics->in_water : nullptr;
    const bool focused = wants_shafts(params) && table && table->count > 0;
    if (c.planes.has(PlaneId::kSurfaceShadow)) {
      strip.probe([&](Pixel<F>& p, const auto& tap) { scatter(c, p, tap, take); });
      if (focused) add_shafts(params, c, strip);
      return;
    }
    if (!c.planes.has(PlaneId::kShadow)) {
      return strip.probe([&](Pixel<F>& p, const auto& tap) {
        const Rgb<F> light = p.sun_near + p.sun_far + p.sun_multiple;
        const auto sunlit = tap.wet() && p.side > F(0.5) && light.r + light.g + light.b > F(0);
        F hidden(0);
        if (params.strength > 0) {
          if_any(sunlit, [&] { hidden = sun_hidden(c, p, tap, sunlit); });
          take(p, hidden, light);
        }
        if (focused) add_shafts(params, c, p, tap, F(1) - strength * hidden);
      });
    }
    if (focused) add_shafts(params, c, strip);
    strip.own(PlaneId::kShadow, [&](Pixel<F>& p, F shadow) { take(p, F(1) - shadow, p.sun_near); });
    strip.bilinear(PlaneId::kShadow, where, [&](Pixel<F>& p, F shadow) {
      take(p, F(1) - shadow, p.sun_far + p.sun_multiple);
    });
  }

 private:
  static constexpr int kAround = 4;
  static double brightened(const Params& params, const Pass& c, const Ranges& ranges);

  template <class Strip>
  static void add_shafts(const Params& params, const Pass& c, Strip& strip) {
    using F = typename Strip::Number;
    strip.probe([&](Pixel<F>& p, const auto& tap) { add_shafts(params, c, p, tap, F(1)); });
  }
  /// `lit`: the share of the sun that reaches the pixel's water, besides that of the planes.
  template <class F, class Tap>
  static void add_shafts(const Params& params, const Pass& c, Pixel<F>& p, const Tap& tap, F lit) {
    const PathLight<F> more = path_light(c, p, tap, given<F>(params.strength));
    const F shafts = lit * given<F>(params.shafts);
    const Rgb<F> all = p.in_scatter + shafts * (more.near * p.sun_near + more.far * p.sun_far);
    p.in_scatter = {max(all.r, F(0)), max(all.g, F(0)), max(all.b, F(0))};
  }

  template <class F, class Tap, class Take>
  static LIMPID_INLINE void scatter(const Pass& c, Pixel<F>& p, const Tap& tap, Take&& take) {
    // In full light the light removed is exactly 0.
    const auto is_lit = [&](Vec2<F> from, Vec2<F> to) {
      return tap.range(PlaneId::kSurfaceShadow, tap.wet(), from, to).low >= 1;
    };
    const auto shade = [&](Vec2<F> shift) {
      F sum(0);
      const auto quad = tap.quad(shift);
      const Four<F> lit = tap.read(PlaneId::kSurfaceShadow, quad);
      for (int k = 0; k < 4; ++k) sum = sum + quad.weight(k) * (F(1) - lit[k]);
      return sum;
    };
    const F mean = p.mean_scatter_distance, whole = min(p.path, F(1e30));
    const ScreenRay<F> line(c, p, p.sun_entry);
    if (!is_lit(Vec2<F>{F(0), F(0)}, line.shift_at(whole))) {
      // All parts send equal light in clear water, where the mean path is half of the whole; they
      // fade exponentially in murky water.
      const F even_share = min(F(2) * mean / max(whole, F(1e-30)), F(1));
      F near_shade(0), far_shade(0), near_sum(0), far_sum(0);
      for (int i = 0; i < kPathSamples; ++i) {
        const F even((2 * i + 1) / double(kPathSamples)), fading(kPathFalloff[i]);
        const F distance = min(mean * (fading + even_share * (even - fading)), whole);
        const F there = distance / max(whole, F(1e-30)), lost = shade(line.shift_at(distance));
        near_shade = near_shade + (F(1) - there) * lost, near_sum = near_sum + (F(1) - there);
        far_shade = far_shade + there * lost, far_sum = far_sum + there;
      }
      take(p, near_shade / max(near_sum, F(1e-6)), p.sun_near);
      take(p, far_shade / max(far_sum, F(1e-6)), p.sun_far);
    }
    const Rgb<F>& multiple = p.sun_multiple;
    if_any(multiple.r + multiple.g + multiple.b > F(0), [&] {
      // Around the entry point for the mean path, at the distance of that path.
      const Vec3<F> map_x = vec3_of<F>(c.map_x), map_y = vec3_of<F>(c.map_y);
      Vec2<F> around[kAround], low, high;
      for (int i = 0; i < kAround; ++i) {
        const Vec3<F> side = i % 2 == 0 ? map_x : map_y;
        const ScreenRay<F> ray(c, p, p.sun_entry + F(i < 2 ? 1 : -1) * side);
        const Vec2<F> at = around[i] = ray.shift_at(mean);
        low = i == 0 ? at : Vec2<F>{min(low.x, at.x), min(low.y, at.y)};
        high = i == 0 ? at : Vec2<F>{max(high.x, at.x), max(high.y, at.y)};
      }
      if (is_lit(low, high)) return;
      F lost(0);
      for (const Vec2<F>& shift : around) lost = lost + F(1.0 / kAround) * shade(shift);
      take(p, lost, p.sun_multiple);
    });
  }
};

}  // namespace limpid
