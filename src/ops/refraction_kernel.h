#pragma once
#include <type_traits>

#include "limpid/ops/refraction.h"

#include "op/bottom_search.h"
#include "op/continuation.h"
#include "op/operator.h"
#include "op/screen_ray.h"
#include "op/valid_lookup.h"
#include "optics/refract.h"

namespace limpid {

template <>
struct Kernel<Refraction> : Refraction {
  /// Share of the distance from the surface to the end of snell's ray: a surface nearer than that
  /// hides the end.
  static constexpr double kShareOfPath = 0.4;
  /// The same where that end is a guess: a nearer surface is the object that hides the end, or the
  /// foot of that object.
  static constexpr double kShareOfGuess = 0.92;

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

  // --- what is seen there -----------------------------------------------------------------------

  /// Resets `lanes` to the pixel itself, at depth `own`.
  template <class F, class Lanes>
  static LIMPID_INLINE void go_back(Lanes lanes, F own, Pixel<F>& p) {
    const Vec2<F> none{F(0), F(0)};
    p.shift = select(lanes, none, p.shift);
    p.shift_r = select(lanes, none, p.shift_r);
    p.shift_g = select(lanes, none, p.shift_g);
    p.shift_b = select(lanes, none, p.shift_b);
    p.hit_depth = select(lanes, own, p.hit_depth);
    p.confidence = select(lanes, F(0), p.confidence);
  }

  template <class F>
  static LIMPID_INLINE void snap(Pixel<F>& p) {
    go_back(p.hit_depth < p.surface_depth, p.dry_depth, p);
  }

  /// The layer below is empty where an object rises out of the water, or stands in front of it.
  template <class F, class Tap>
  [[gnu::noinline]] static void snap_from_empty(const SeenPlanes& planes, Pixel<F>& p,
                                                const Tap& tap) {
    const auto empty = nothing(p.hit_depth);
    if_any(empty, [&] {
      const auto hidden = empty && !nothing(tap.nearest(PlaneId::kDepth, p.shift));
      go_back(hidden, tap.nearest(planes.depth, Vec2<F>{F(0), F(0)}), p);
    });
  }

  /// Makes the path of `lanes` endless.
  template <class F, class Lanes>
  static LIMPID_INLINE void see_no_end(Lanes lanes, Pixel<F>& p) {
    p.transmitted = select(lanes, Rgb<F>{F(0), F(0), F(0)}, p.transmitted);
    p.hit_depth = select(lanes, F(HUGE_VAL), p.hit_depth);
    p.path = select(lanes, F(HUGE_VAL), p.path);
    p.confidence = select(lanes, F(0), p.confidence);
  }

  /// Four texels of which some count.
  template <class F, class Quad>
  struct Counted {
    Quad quad;
    Four<F> depths, weights;
    F lost;  ///< weight of the texels without a hit: they do not count

    template <class Tap>
    F read(const Tap& tap, PlaneId plane) const {
      return mean(weights, tap.read(plane, quad));
    }
    /// The depth of the texels behind a surface; +inf where none is.
    F depth_behind(F surface) const {
      Four<F> behind = weights;
      F some = F(0);
      for (int k = 0; k < 4; ++k) {
        behind.at[k] = select(depths[k] > surface, weights[k], F(0));
        some = some + behind[k];
      }
      return select(some > F(0), mean(behind, depths), F(HUGE_VAL));
    }

   private:
    static F mean(Four<F> shares, Four<F> values) {
      F sum = F(0), weight = F(0);
      for (int k = 0; k < 4; ++k) {
        sum = sum + shares[k] * select(shares[k] > F(0), values[k], F(0));
        weight = weight + shares[k];
      }
      return sum / max(weight, F(1e-6));
    }
  };
  template <class F, class Tap>
  static auto counted(const SeenPlanes& planes, const Pixel<F>& p, const Tap& tap, Vec2<F> shift) {
    const auto quad = tap.quad(shift);
    Counted<F, std::decay_t<decltype(quad)>> taps{quad, tap.read(planes.depth, quad), {}, F(0)};
    for (int k = 0; k < 4; ++k) {
      const auto gone = nothing(taps.depths[k]) && p.side > F(-0.5);
      taps.weights.at[k] = select(gone, F(0), quad.weight(k));
      taps.lost = taps.lost + select(gone, quad.weight(k), F(0));
    }
    return taps;
  }

  /// Mixes look_up()'s result, which ignored depths, again where some texels do not count.
  template <class F, class Tap>
  [[gnu::noinline]] static void leave_out_nothing(const Pass& c, const SeenPlanes& planes,
                                                  Pixel<F>& p, const Tap& tap) {
    const bool split = c.made.has(StatePart::kPrism);
    const auto misses = [&](Vec2<F> shift) {
      const Four<F> depths = tap.read(planes.depth, tap.quad(shift));
      return nothing(depths[0]) || nothing(depths[1]) || nothing(depths[2]) || nothing(depths[3]);
    };
    auto some = misses(p.shift);
    if (split) some = some || misses(p.shift_r) || misses(p.shift_g) || misses(p.shift_b);
    if_any(some, [&] { mix_again(split, planes, p, tap); });
  }
  template <class F, class Tap>
  static void mix_again(bool split, const SeenPlanes& planes, Pixel<F>& p, const Tap& tap) {
    const PlaneId red = planes.color, green = plane_after(red, 1), blue = plane_after(red, 2);
    const auto mend = [&](const auto& taps, PlaneId plane, F& value) {
      if_any(taps.lost > F(0), [&] {
        const F kept = select(taps.lost < F(0.5), taps.read(tap, plane), F(0));
        value = select(taps.lost > F(0), kept, value);
      });
    };
    const auto common = counted(planes, p, tap, p.shift);
    if (split) {
      mend(counted(planes, p, tap, p.shift_r), red, p.transmitted.r);
      mend(counted(planes, p, tap, p.shift_g), green, p.transmitted.g);
      mend(counted(planes, p, tap, p.shift_b), blue, p.transmitted.b);
    } else {
      mend(common, red, p.transmitted.r);
      mend(common, green, p.transmitted.g);
      mend(common, blue, p.transmitted.b);
    }
    const auto some = common.lost > F(0);
    if_any(some, [&] {
      const F behind = common.depth_behind(p.surface_depth);
      p.hit_depth = select(some && nothing(p.hit_depth), behind, p.hit_depth);
      p.confidence = p.confidence * (F(1) - common.lost);
      see_no_end(common.lost >= F(0.5) || (some && nothing(p.hit_depth)), p);
    });
  }

  template <class Strip>
  static void look_up(const Pass& c, const SeenPlanes& planes, Strip& strip) {
    using F = typename Strip::Number;
    if (!c.made.has(StatePart::kPrism)) {
      return strip.bilinear_rgb(
          planes.color, [](const Pixel<F>& p) { return p.shift_g; },
          [](Pixel<F>& p, Rgb<F> color) { p.transmitted = color; });
    }
    strip.bilinear(
        planes.color, [](const Pixel<F>& p) { return p.shift_r; },
        [](Pixel<F>& p, F red) { p.transmitted.r = red; });
    strip.bilinear(
        plane_after(planes.color, 1), [](const Pixel<F>& p) { return p.shift_g; },
        [](Pixel<F>& p, F green) { p.transmitted.g = green; });
    strip.bilinear(
        plane_after(planes.color, 2), [](const Pixel<F>& p) { return p.shift_b; },
        [](Pixel<F>& p, F blue) { p.transmitted.b = blue; });
  }

  /// A texel counts where it lies under the surface, and not so far in front of the end of a ray
  /// that it must hide that end. Where nothing was hit, or the layer below is empty, no texel
  /// counts.
  template <bool kBottomless, class F, class Tap>
  static void look_up_valid(const Params& params, const Pass& c, const SeenPlanes& planes,
                            Pixel<F>& p, const Tap& tap) {
    const bool surface_plane = c.planes.has(PlaneId::kSurfaceDepth);
    const F ray_end = min(p.hit_depth, F(1e30));
    const auto is_empty = [&](F depth) { return nothing(depth) && p.side > F(-0.5); };
    const BottomLayer* layer = params.uses_bottom_layer() ? c.bottom_layer : nullptr;
    const F snell(params.model == Model::kSnell ? kShareOfPath : 0);
    const F path_fraction = layer ? select(p.confidence < F(1), F(kShareOfGuess), snell) : snell;
    // In open water only surfaces under it can hide the end of a ray.
    const bool all_seen = !layer || !any(tap.wet() && p.confidence < F(1));
    const bool all_count = all_seen && all_texels_count(c, planes, p, tap);
    const auto hidden = layer && !c.foreground ? p.confidence < F(1) : p.confidence < F(-1);
    const auto lies = [&](const auto& quad, F share) -> Four<F> {
      if (all_count || (!kBottomless && !c.foreground && !any(hidden)))
        return {F(1), F(1), F(1), F(1)};
      const Four<F> depths = tap.read(planes.depth, quad);
      Four<F> surfaces, counts;
      if (kBottomless && !c.foreground && !any(hidden)) {
        for (int k = 0; k < 4; ++k) counts.at[k] = select(is_empty(depths[k]), F(0), F(1));
        return counts;
      }
      if (surface_plane) surfaces = tap.read(PlaneId::kSurfaceDepth, quad);
      for (int k = 0; k < 4; ++k) {
        const F depth = depths[k];
        F surface =
            surface_plane ? surfaces[k] : calm_depth_at(c, p, tap.place(planes.depth, quad, k));
        if (surface_plane && planes.below) {
          // The layer below continues under the shore, the drawn water does not.
          if_any(surface > F(1e30), [&] {
            const F calm = calm_depth_at(c, p, tap.place(planes.depth, quad, k));
            surface = select(surface > F(1e30), calm, surface);
          });
        }
        if (surface_plane && c.surface_ends) {
          // The outermost texels say nothing about the water beyond them.
          const Vec2<F> place = tap.place(planes.depth, quad, k);
          const auto known = reach_in(c.surface, p.uv, place) >= F(1);
          if_any(!known, [&] { surface = select(known, surface, calm_depth_at(c, p, place)); });
        }
        if (c.submersible) {
          // Where the view begins in the water, surfaces in the water have no water surface in
          // front.
          const F height = height_at(c, p, tap.place(planes.depth, quad, k), depth);
          surface = select(depth <= surface && p.side * height <= F(0), F(0), surface);
        }
        const F least = surface + share * max(ray_end - surface, F(0));
        const F below = planes.below ? select(depth < F(1e30), depth, F(0)) : depth;
        const F seen = kBottomless ? select(is_empty(depth), F(0), depth) : below;
        const auto there = seen > surface && (seen > least || share <= F(0));
        counts.at[k] = select(there, F(1), F(0));
        if (c.foreground) continue;
        const F is_there = kBottomless ? select(is_empty(depth), F(0), F(1)) : F(1);
        counts.at[k] = select(hidden, counts[k], is_there);
      }
      return counts;
    };
    const auto valid = [&](const auto& quad) { return lies(quad, path_fraction); };
    const auto bearable = [&](const auto& quad) { return lies(quad, F(0)); };
    const auto taps_at = [&](Vec2<F> shift) {
      // Does not fill over an object in the water, which may hide its own parts, unless the end of
      // the ray is hidden by an object that is above the water and apart from it; and not where the
      // layer itself shows a surface far in front of the end of the ray.
      const auto fill = [&](const auto& lanes) {
        F fills(0);
        if (!layer) return fills;
        if_any(lanes && p.side > F(0), [&] {
          const BottomLayerTaps<F, Tap> taps(*layer, p, tap);
          const Vec2<F> here{F(0), F(0)};
          F clear =
              select(taps.is_bottom(here, F(0) - height_at(c, p, here, p.dry_depth)), F(1), F(0));
          if_any(lanes && clear < F(0.5), [&] {
            const auto other = height_at(c, p, shift, tap.nearest(planes.depth, shift)) >= F(0) &&
                               taps.is_apart(c, planes, shift);
            clear = select(other || taps.is_far_behind(c, planes, shift), F(1), clear);
          });
          const auto bottom = p.side > F(0) && clear > F(0.5);
          const F calm = min(calm_depth_at(c, p, shift), ray_end);
          const F distance = ray_end - calm;
          const F deeper =
              depth_at_drop(c, p, shift, taps.shape(shift).drop) - calm - F(0.3) * distance;
          fills = select(bottom, saturate(F(5) * deeper / max(distance, F(1e-3) * ray_end)), F(0));
        });
        return fills;
      };
      // True over a layer below that is empty, or has only surfaces higher than all water.
      const auto never = [&](const auto& lanes) {
        return planes.below &&
               tap.heights(planes.depth, lanes, Vec2<F>{F(0), F(0)}, shift).highest <= -HUGE_VAL;
      };
      return valid_taps(tap, shift, valid, bearable, fill, never);
    };
    const auto behind = [&](const auto& taps, Vec2<F> shift) {
      Rgb<F> color{F(0), F(0), F(0)};
      if (!layer) return color;
      if_any(taps.filled > F(0),
             [&] { color = taps.filled * BottomLayerTaps<F, Tap>(*layer, p, tap).color(shift); });
      return color;
    };
    const auto depth_of = [&](const auto& taps) {
      const F depth = taps.read_depth(tap, planes.depth);
      const F whole = select(taps.filled > F(0), depth + taps.filled * ray_end, depth);
      return of_whole<kBottomless>(taps, whole);
    };
    const auto tell_light = [&](const auto& taps) {
      if (!layer) return;
      const F share = of_whole<kBottomless>(taps, taps.filled);
      p.filled = select(taps.weight() > F(0.5), share, F(0));
      if (layer->lit) p.dry_lit_known = p.filled;
    };
    const PlaneId red = planes.color, green = plane_after(red, 1), blue = plane_after(red, 2);
    // Where even the pixel's own texel of the layer below is empty, the dry color stays.
    const Rgb<F> own = p.transmitted;
    const auto color = [&](const auto& taps, F read, F filled, F stays) {
      const F sum = read + filled;
      return select(taps.weight() > F(0.5), of_whole<kBottomless>(taps, sum), stays);
    };
    const F lost = kBottomless && !all_count ? share_of_nothing(planes, p, tap) : F(0);
    F share(1), weight(1);
    if (c.made.has(StatePart::kPrism)) {
      const Vec2<F> r = p.shift_r, g = p.shift_g, b = p.shift_b;
      F shares[3] = {F(0), F(0), F(0)};
      auto taps_common = no_taps<F>(tap, g);
      each<F>(3, [&](auto i) {
        const Vec2<F> shift{pick<F>(i, r.x, g.x, b.x), pick<F>(i, r.y, g.y, b.y)};
        const auto taps = taps_at(shift);
        const Rgb<F> filled = behind(taps, shift);
        const auto channel = [&](int k, PlaneId plane, F filled_k, F stays, Vec2<F>& place,
                                 F& transmitted) {
          only<F>(i, k, [&] {
            transmitted = color(taps, taps.read(tap, plane), filled_k, stays);
            place = taps.place;
            shares[k] = taps.share;
          });
        };
        channel(0, red, filled.r, own.r, p.shift_r, p.transmitted.r);
        channel(1, green, filled.g, own.g, p.shift_g, p.transmitted.g);
        channel(2, blue, filled.b, own.b, p.shift_b, p.transmitted.b);
        only<F>(i, 1, [&] { taps_common = taps; });
      });
      // Green mostly lies on the common path: then no second lookup is needed.
      const auto apart = abs(p.shift.x - g.x) > F(0) || abs(p.shift.y - g.y) > F(0);
      if_any(apart, [&] { taps_common = taps_at(p.shift); });
      p.shift = taps_common.place;
      p.hit_depth = depth_of(taps_common);
      tell_light(taps_common);
      if (kBottomless) weight = taps_common.weight();
      share = F(1.0 / 3) * (shares[0] + shares[1] + shares[2]);
    } else {
      const auto taps = taps_at(p.shift_g);
      const Rgb<F> filled = behind(taps, p.shift_g);
      p.transmitted.r = color(taps, taps.read(tap, red), filled.r, own.r);
      p.transmitted.g = color(taps, taps.read(tap, green), filled.g, own.g);
      p.transmitted.b = color(taps, taps.read(tap, blue), filled.b, own.b);
      p.shift = p.shift_r = p.shift_g = p.shift_b = taps.place;
      p.hit_depth = depth_of(taps);
      tell_light(taps);
      share = taps.share;
      if (kBottomless) weight = taps.weight();
    }
    p.confidence = p.confidence * share;
    if (!kBottomless || all_count) return;
    see_no_end(lost >= F(0.5) || (weight <= F(0.5) && is_empty(p.dry_depth)), p);
  }

  /// Whether Pass::heights shows that all texels of the pixel's lookups count. A texel's view ray
  /// reaches the depth of the ray's end a little higher or lower than the view ray at the lookup
  /// does; the two are at most one texel apart.
  template <class F, class Tap>
  static LIMPID_INLINE bool all_texels_count(const Pass& c, const SeenPlanes& planes,
                                             const Pixel<F>& p, const Tap& tap) {
    if (!c.heights.known) return false;
    const F end = min(p.hit_depth, F(1e30));
    const auto texel = [&](const glm::dvec2& step, const char* name) {
      return given<F>(std::abs(step.x) / c.size.x + std::abs(step.y) / c.size.y, name);
    };
    const auto lowest = [](F a, F b, F d) { return min(min(a, b), d); };
    const auto greatest_of = [](F a, F b, F d) { return max(max(a, b), d); };
    const Vec2<F>&r = p.shift_r, &g = p.shift_g, &b = p.shift_b;
    const F height = lowest(height_at(c, p, r, end), height_at(c, p, g, end),
                            min(height_at(c, p, b, end), height_at(c, p, p.shift, end)));
    const F surely = height - texel(c.over_step, "camera.over_texel") -
                     end * texel(c.under_step, "camera.under_texel");
    const Vec2<F> low{lowest(r.x, g.x, min(b.x, p.shift.x)), lowest(r.y, g.y, min(b.y, p.shift.y))};
    const Vec2<F> high{greatest_of(r.x, g.x, max(b.x, p.shift.x)),
                       greatest_of(r.y, g.y, max(b.y, p.shift.y))};
    return least(select(tap.wet(), surely, F(HUGE_VAL))) >
           tap.heights(planes.depth, tap.wet(), low, high).covers;
  }

  /// Lookups of a cell that may have pixels without a hit. A function of its own, like its
  /// siblings, to keep the code small that nearly all cells run.
  template <class F, class Tap>
  [[gnu::noinline]] static void look_up_valid_if_any(const Params& params, const Pass& c,
                                                     const SeenPlanes& planes, Pixel<F>& p,
                                                     const Tap& tap) {
    look_up_valid<true>(params, c, planes, p, tap);
  }

  /// Share of the four texels at the pixel's shift at which nothing was hit, in the dry scene as
  /// well.
  template <class F, class Tap>
  static F share_of_nothing(const SeenPlanes& planes, const Pixel<F>& p, const Tap& tap) {
    const auto taps = counted(planes, p, tap, p.shift);
    F share = taps.lost;
    if (!planes.below) return share;
    if_any(taps.lost > F(0), [&] {
      const Four<F> dry = tap.read(PlaneId::kDepth, taps.quad);
      share = F(0);
      for (int k = 0; k < 4; ++k) {
        const auto gone = nothing(taps.depths[k]) && nothing(dry[k]);
        share = share + select(gone, taps.quad.weight(k), F(0));
      }
    });
    return share;
  }

  /// A sum over taps with a weight below 1, where no valid texel could replace the others.
  template <bool kBottomless, class F, class Taps>
  static LIMPID_INLINE F of_whole(const Taps& taps, F sum) {
    if (!kBottomless) return sum;
    const F weight = taps.weight();
    return select(weight > F(0.5) && weight < F(0.999), sum / max(weight, F(0.5)), sum);
  }

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
