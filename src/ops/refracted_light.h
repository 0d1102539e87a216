#pragma once
#include <type_traits>

#include "limpid/ops/refraction.h"

#include "op/bottom_layer.h"
#include "op/pass.h"
#include "op/pixel.h"
#include "op/screen_ray.h"
#include "op/seen_planes.h"
#include "op/valid_lookup.h"

/// @file
/// What the picture shows where refracted rays end: which texels count there, and what is shown in
/// place of the others. ops/refraction_kernel.h has the rays.

namespace limpid {

struct RefractedLight : Refraction {
  /// Share of the distance from the surface to the end of snell's ray: a surface nearer than that
  /// hides the end.
  static constexpr double kShareOfPath = 0.4;
  /// The same where that end is a guess: a nearer surface is the object that hides the end, or the
  /// foot of that object.
  static constexpr double kShareOfGuess = 0.92;

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

  /// Depth of the water before texel k of a lookup, where the picture shows a surface at `depth`;
  /// `drawn`: what the plane of the surface's depths has there, if there is one.
  template <class F, class Tap, class Quad>
  static LIMPID_INLINE F water_before(const Pass& c, const SeenPlanes& planes, const Pixel<F>& p,
                                      const Tap& tap, const Quad& quad, int k, F depth, F drawn) {
    const bool surface_plane = c.planes.has(PlaneId::kSurfaceDepth);
    const auto calm = [&] { return calm_depth_at(c, p, tap.place(planes.depth, quad, k)); };
    F surface = surface_plane ? drawn : calm();
    if (surface_plane && planes.below) {
      // The layer below continues under the shore, the drawn water does not.
      if_any(surface > F(1e30), [&] { surface = select(surface > F(1e30), calm(), surface); });
    }
    if (surface_plane && c.surface_ends) {
      // The outermost texels say nothing about the water beyond them.
      const auto known = reach_in(c.surface, p.uv, tap.place(planes.depth, quad, k)) >= F(1);
      if_any(!known, [&] { surface = select(known, surface, calm()); });
    }
    if (c.submersible) {
      // Where the view begins in the water, surfaces in the water have no water surface in front.
      const F height = height_at(c, p, tap.place(planes.depth, quad, k), depth);
      surface = select(depth <= surface && p.side * height <= F(0), F(0), surface);
    }
    return surface;
  }

  /// In which share the bottom layer is seen at a shift, in place of texels that do not count. Not
  /// over an object in the water, which may hide its own parts, unless the end of the ray is hidden
  /// by an object that is above the water and apart from it; and not where the layer itself shows a
  /// surface far in front of the end of the ray.
  template <class F, class Tap, class Mask>
  static LIMPID_INLINE F layer_share(const BottomLayer& layer, const Pass& c,
                                     const SeenPlanes& planes, const Pixel<F>& p, const Tap& tap,
                                     Vec2<F> shift, F ray_end, const Mask& lanes) {
    F fills(0);
    if_any(lanes && p.side > F(0), [&] {
      const BottomLayerTaps<F, Tap> taps(layer, p, tap);
      const Vec2<F> here{F(0), F(0)};
      F clear = select(taps.is_bottom(here, F(0) - height_at(c, p, here, p.dry_depth)), F(1), F(0));
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
        const F surface = water_before(c, planes, p, tap, quad, k, depth,
                                       surface_plane ? surfaces[k] : F(HUGE_VAL));
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
      const auto fill = [&](const auto& lanes) {
        return layer ? layer_share(*layer, c, planes, p, tap, shift, ray_end, lanes) : F(0);
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
      // Green mostly lies on the common path: then no fourth lookup is needed.
      const auto apart = abs(p.shift.x - g.x) > F(0) || abs(p.shift.y - g.y) > F(0);
      const F more = select(apart, F(1), F(0));
      steps<F>(0, 4, [&](auto i) {
        Vec2<F> shift{pick<F>(i, r.x, g.x, b.x), pick<F>(i, r.y, g.y, b.y)};
        only<F>(i, 3, [&] { shift = p.shift; });
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
        only<F>(i, 3, [&] { taps_common = taps; });
        return pick<F>(i, F(1), F(1), more) > F(0.5);
      });
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
};

}  // namespace limpid
