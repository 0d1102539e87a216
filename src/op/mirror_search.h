#pragma once
#include "op/pass.h"
#include "op/screen_ray.h"

/// @file
/// The intersection of mirrored rays with the surfaces in a depth plane.

namespace limpid {

/// Parameters of a march over a depth plane: McGuire & Mara 2014, "Efficient GPU Screen-Space Ray
/// Tracing", in `steps` that grow with the distance from the pixel, the last three times as long as
/// the first, then bisection. The thickness of a visible surface is `thick` times its depth, plus
/// the same again up to `thin` times the eye's height over the calm water: a ray that was farther
/// behind one pixel before has passed the surface. (Far away, a ray along the water crosses much
/// depth in a pixel.)
struct MirrorSteps {
  int steps;
  double thin, thick;
};

/// The share of a march's length at a step, of `count` steps.
template <class F, class Step>
LIMPID_INLINE F share_of_step(Step step, int count) {
  const F even = Loop<F>::ratio(step, count);
  return F(0.5) * (even + even * even);
}

/// Skips steps of a march that need no lookup.
class Leaps {
 public:
  LIMPID_INLINE explicit Leaps(int steps) : steps_(steps), length_(steps), asks_(steps / 4) {}

  /// The first step after i - 1 that may need a lookup. passes(begin, last): whether the steps
  /// after `begin` up to `last` need none.
  template <class Passes>
  LIMPID_INLINE int from(int i, Passes&& passes) {
    while (i >= next_ask_ && i <= steps_ && asks_-- > 0) {
      const int after = i - 1 + length_ < steps_ ? i - 1 + length_ : steps_;
      if (after > i && passes(i - 1, after)) {
        i = after + 1;
      } else if (length_ >= 2 * kLeast) {
        length_ /= 2;
      } else {
        next_ask_ = i + steps_ / 4;
      }
    }
    return i;
  }

 private:
  static constexpr int kLeast = 4;
  int steps_, length_, next_ask_ = 1, asks_;
};

/// The search along the ray of one pixel, or of one vector of pixels.
template <class F, class Tap>
class MirrorSearch {
 public:
  struct Found {
    F distance;  ///< distance along the ray, +inf where it meets no surface
    F hit;       ///< 1 or 0
  };

  /// `accept(shift, depth)`: whether the ray may hit this visible surface. `thicker`:
  /// factor on the thickness `how.thick`. Lanes other than `lanes` have no hit.
  template <class Mask, class Accept>
  static Found march(const WaterView& c, const Tap& tap, const Mask& lanes, PlaneId plane,
                     const Bounds& bounds, const Pixel<F>& p, const ScreenRay<F>& ray,
                     const MirrorSteps& how, Accept&& accept, F thicker = F(1)) {
    const F most = min(ray.s_at(reach_ahead(c, bounds, p.uv, ray.across)), F(1e30));
    const Vec2<F> end = ray.shift_at(most);
    // The ray's depth at a share t of its length on screen is ray.depth + t gain / (1 - t bend);
    // comparisons with other depths need no division.
    const F scale = F(1) / max(ray.w + most * ray.w_step, F(1e-6) * ray.w);
    const F gain = (most * scale) * (ray.w * ray.depth_step), bend = (most * scale) * ray.w_step;
    const auto is_behind = [&](F t, F depth) {
      return t * gain >= (depth - ray.depth) * (F(1) - t * bend);
    };
    const auto seen_at = [&](F t) {
      const Vec2<F> shift = t * end;
      const F seen = min(tap.nearest(plane, shift), F(1e30));
      return select(accept(shift, seen), seen, F(1e30));
    };
    // The share of the length that lies in one pixel.
    const F pixel =
        F(1) / max(max(given<F>(c.size.x) * abs(end.x), given<F>(c.size.y) * abs(end.y)), F(1));
    // Whether the ray lies between front and back of the visible surface.
    const F thin = F(how.thin) * abs(given<F>(c.eye_above));
    const auto back_of = [&](F seen) {
      const F thick = F(how.thick) * thicker * seen;
      return seen + (thick + min(thin, thick));
    };
    const auto within = [&](F t, F seen) {
      return is_behind(t, seen) && !is_behind(max(t - pixel, F(0)), back_of(seen)) &&
             seen < F(1e29);
    };
    // The share at which `hits` changes, between two shares of the length.
    const auto edge = [&](F low, F high, auto&& hits) {
      repeat<F>(kHalvings, [&] {
        const F t = F(0.5) * (low + high);
        const auto hit = hits(t, seen_at(t));
        high = select(hit, t, high);
        low = select(hit, low, t);
      });
      return high;
    };
    const auto share_of = [&](auto step) { return share_of_step<F>(step, how.steps); };
    // Whether all steps after `begin` up to `last_one` need no lookup: all surfaces there are
    // farther away than the ray, or so near that the ray has passed them. Where the ray is far away
    // 1 - t bend is a small difference, with the rounding error of 1.
    const auto passes = [&](int begin, int last_one, auto&& open) {
      const F a = share_of(begin), b = share_of(last_one), before = max(a - pixel, F(0));
      const auto depth_at = [&](F t, double off) {
        return ray.depth + t * gain / max(F(1 + off) - t * bend, F(1e-30));
      };
      const F first = depth_at(before, -1e-6), second = depth_at(before, 1e-6);
      const F third = depth_at(b, -1e-6), fourth = depth_at(b, 1e-6);
      const F low = min(min(first, second), min(third, fourth));
      const F high = max(max(first, second), max(third, fourth));
      const SeenRange seen = tap.range(plane, open, a * end, b * end);
      if (seen.low > greatest(select(open, F(1 + 1e-5) * high, F(-HUGE_VAL)))) return true;
      const F back = back_of(F(seen.high));
      return !any(open && !(F(1 - 1e-5) * low > back));
    };
    F before = F(0), met = F(0), found = F(0), last = F(0), last_nearest = F(1e30);
    Leaps leaps(how.steps);
    const auto leap = [&](int i) {
      return leaps.from(i, [&](int begin, int last_one) {
        const bool over = passes(begin, last_one, lanes && found < F(0.5));
        if (over) {
          last = share_of(last_one);
          last_nearest = min(tap.nearest(plane, last * end), F(1e30));
        }
        return over;
      });
    };
    const auto step = [&](auto i) {
      const F t = share_of(i);
      const Vec2<F> shift = t * end;
      const F nearest = min(tap.nearest(plane, shift), F(1e30));
      // Most steps lie in front of all that is seen, and so did the steps before them.
      const auto enters = is_behind(t, nearest) && nearest < F(1e29);
      const auto leaves =
          is_behind(t, last_nearest) && !is_behind(last, last_nearest) && last_nearest < F(1e29);
      const auto open = lanes && found < F(0.5) && (enters || leaves);
      if_any(open, [&] {
        const F seen = select(accept(shift, nearest), nearest, F(1e30));
        const auto behind = is_behind(t, seen);
        const auto hit = open && within(t, seen);
        // A long step may lead through a whole object, or behind an object and out again past its
        // edge.
        const auto through =
            open && !hit && behind && !is_behind(last, back_of(seen)) && seen < F(1e29);
        const auto past_edge = open && leaves && !behind && accept(last * end, last_nearest);
        met = select(hit, t, met);
        before = select(hit, last, before);
        found = select(hit, F(1), found);
        const auto leads = through || past_edge;
        if_any(leads, [&] {
          F low = last, high = t, front = seen;
          repeat<F>(kHalvings, [&] {
            const F middle = F(0.5) * (low + high), there = seen_at(middle);
            const auto in = is_behind(middle, there);
            // Beyond the edge is what the ray has not yet passed at the end of the step.
            const auto beyond = past_edge && !in && !is_behind(t, there) && !is_behind(high, front);
            const auto back = in || beyond;
            high = select(back, middle, high);
            low = select(back, low, middle);
            front = select(back, there, front);
          });
          const auto meets = leads && within(high, front);
          met = select(meets, high, met);
          before = select(meets, low, before);
          found = select(meets, F(1), found);
        });
      });
      last = t;
      last_nearest = nearest;
      return lanes && found < F(0.5);
    };
    if_any(lanes, [&] { steps<F>(1, how.steps + 1, leap, step); });
    if_any(found > F(0.5), [&] { met = edge(before, met, within); });
    return {select(found > F(0.5), ray.at_share(met, most), F(HUGE_VAL)), found};
  }

 private:
  static constexpr int kHalvings = 5;
};

}  // namespace limpid
