#pragma once
#include <algorithm>

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
  /// Whether, from above the water, objects are as thick as they are narrow.
  bool narrow = false;
  /// Whether, from there, rays may meet surfaces that other objects hide.
  bool guesses = false;
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
    F distance;     ///< distance along the ray, +inf where it meets no surface
    F hit;          ///< 1 or 0
    Vec2<F> shift;  ///< the place that shows the surface; 0 without one
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
    const auto seen_at = [&](Vec2<F> shift) {
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
    const auto thins = F(how.narrow ? 1 : 0) > F(0.5) && p.side > F(0);
    const auto guesses = F(how.guesses ? 1 : 0) > F(0.5) && p.side > F(0);
    // The same for an object that may be thinner than that.
    const auto meets_at = [&](F t, F seen, const auto& asked) {
      const F back = back_of(seen), whole = back - seen, nearer = max(t - pixel, F(0));
      auto meets = asked && within(t, seen);
      const auto doubtful = thins && meets && is_behind(nearer, seen + F(kNarrowest) * whole);
      if_any(doubtful, [&] {
        const F thick = thickness_of(c, tap, plane, t * end, seen, whole);
        meets = meets && !(doubtful && is_behind(nearer, seen + thick));
      });
      return meets;
    };
    // The share at which `hits` changes, between two shares of the length.
    const auto edge = [&](F low, F high, auto&& hits) {
      repeat<F>(kHalvings, [&] {
        const F t = F(0.5) * (low + high);
        const auto hit = hits(t, seen_at(t * end));
        high = select(hit, t, high);
        low = select(hit, low, t);
      });
      return high;
    };
    const auto share_of = [&](auto step) { return share_of_step<F>(step, how.steps); };
    F before = F(0), met = F(0), found = F(0), last = F(0), last_nearest = F(1e30);
    // Whether the ray is behind something that it has not met, and the last step before that.
    F hidden = F(0), clear = F(0);
    F covers = F(0);  // the greatest depth of the backs of the objects that hide it
    // Whether something nearer borders on the place that shows the surface, which may lie off the
    // ray.
    F borders = F(0);
    Vec2<F> to_side{F(0), F(0)};
    // Whether all steps after `begin` up to `last_one` need no lookup: all surfaces there are
    // farther away than the ray. Where the ray is far away 1 - t bend is a small difference, with
    // the rounding error of 1.
    const auto passes = [&](int begin, int last_one, auto&& open) {
      if (how.guesses && any(open && hidden > F(0.5))) return false;
      const F a = share_of(begin), b = share_of(last_one);
      const auto depth_at = [&](F t, double off) {
        return ray.depth + t * gain / max(F(1 + off) - t * bend, F(1e-30));
      };
      const F high = max(max(depth_at(a, -1e-6), depth_at(a, 1e-6)),
                         max(depth_at(b, -1e-6), depth_at(b, 1e-6)));
      return tap.range(plane, open, a * end, b * end).low >
             greatest(select(open, F(1 + 1e-5) * high, F(-HUGE_VAL)));
    };
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
      F blocked(0);
      if_any(open, [&] {
        const F seen = select(accept(shift, nearest), nearest, F(1e30));
        const auto behind = is_behind(t, seen);
        const auto hit = meets_at(t, seen, open);
        // A long step may lead through a whole object, or behind an object and out again past its
        // edge.
        const auto through =
            open && !hit && behind && !is_behind(last, back_of(seen)) && seen < F(1e29);
        const auto past_edge = open && leaves && !behind && accept(last * end, last_nearest);
        met = select(hit, t, met);
        before = select(hit, last, before);
        found = select(hit, F(1), found);
        // A step may also lead through a surface that comes nearer along the ray's path, like a
        // ceiling, but not past the outline of something round, where the depth that is seen jumps.
        const auto overhead = open && !hit && behind && !is_behind(last, last_nearest) &&
                              is_behind(last, back_of(seen)) && seen < F(1e29);
        const auto leads = through || past_edge || overhead;
        // A surface that the ray crossed behind something else, like a wall behind a pole.
        const auto emerges = guesses && open && !hit && behind && hidden > F(0.5) &&
                             seen > covers && !is_behind(clear, seen) && seen < F(1e29);
        if_any(leads, [&] {
          F low = last, high = t, front = seen;
          repeat<F>(kHalvings, [&] {
            const F middle = F(0.5) * (low + high), there = seen_at(middle * end);
            const auto in =
                is_behind(middle, there) && (overhead || !is_behind(last, back_of(there)));
            // Beyond the edge is what the ray has not yet passed at the end of the step.
            const auto beyond = past_edge && !in && !is_behind(t, there) && !is_behind(high, front);
            const auto back = in || beyond;
            high = select(back, middle, high);
            low = select(back, low, middle);
            front = select(back, there, front);
          });
          const F jump = seen_at(max(high - pixel, F(0)) * end) - front;
          const auto smooth = jump < F(kSlope) * (back_of(front) - front);
          const auto meets = meets_at(high, front, leads) && (!overhead || smooth);
          met = select(meets, high, met);
          before = select(meets, low, before);
          found = select(meets, F(1), found);
        });
        const auto crossed = emerges && found < F(0.5);
        if_any(crossed, [&] {
          F low = last, high = t;
          repeat<F>(kHalvings, [&] {
            const F middle = F(0.5) * (low + high), there = seen_at(middle * end);
            const auto in = is_behind(middle, there) && !is_behind(clear, there) && there < F(1e29);
            high = select(in, middle, high);
            low = select(in, low, middle);
          });
          met = select(crossed, high, met);
          before = select(crossed, high, before);
          found = select(crossed, F(1), found);
          borders = select(crossed, F(1), borders);
        });
        blocked = select(behind && seen < F(1e29), F(1), F(0));
        const F before_it = select(hidden > F(0.5), covers, F(0));
        covers = select(blocked > F(0.5), max(before_it, back_of(seen)), covers);
      });
      clear = select(blocked > F(0.5) && hidden < F(0.5), last, clear);
      hidden = blocked;
      last = t;
      last_nearest = nearest;
      return lanes && found < F(0.5);
    };
    if_any(lanes, [&] { steps<F>(1, how.steps + 1, leap, step); });
    if_any(found > F(0.5), [&] { met = edge(before, met, within); });
    // A ray that has been behind something narrow, like a pole, up to its end has met the surface
    // that the picture shows beside the pole where the ray is as deep.
    const auto lost = guesses && lanes && found < F(0.5) && hidden > F(0.5);
    if_any(lost, [&] {
      F share = clear, surface(0);
      Vec2<F> aside{F(0), F(0)};
      const auto look = [&] {
        aside = beside(c, tap, plane, share * end, is_upright(c, end), covers);
        surface = min(tap.nearest(plane, share * end + aside), F(1e30));
      };
      look();
      // Behind something wide nothing is known.
      steps<F>(0, kGuesses, [&](auto) {
        const auto narrow = lost && surface > covers;
        if_any(narrow, [&] {
          const F ahead = surface - ray.depth;
          const F there = max(min(ahead / max(gain + ahead * bend, F(1e-30)), last), clear);
          share = select(narrow, there, share);
          look();
        });
        return narrow;
      });
      surface = seen_at(share * end + aside);
      const auto meets = lost && abs(aside.x) + abs(aside.y) > F(0) && surface > covers &&
                         surface < F(1e29) && is_behind(last, surface) &&
                         !is_behind(clear, surface);
      met = select(meets, share, met);
      to_side = select(meets, aside, to_side);
      found = select(meets, F(1), found);
      borders = select(meets, F(1), borders);
    });
    const auto hit = found > F(0.5);
    const Vec2<F> place = met * end + to_side;
    const Vec2<F> shown = select(borders > F(0.5), to_texel(c, place), place);
    return {select(hit, ray.at_share(met, most), F(HUGE_VAL)), found,
            select(hit, shown, Vec2<F>{F(0), F(0)})};
  }

 private:
  static constexpr int kHalvings = 5;
  static constexpr int kWidths = 4, kPole = 5, kGuesses = 3;
  static constexpr double kNarrowest = 0.125, kSky = 1e6, kPicture = 640;
  /// How much nearer a surface may come from one pixel to the next, in its thicknesses.
  static constexpr double kSlope = 4;

  /// The thickness of an object that is seen at a shift: `whole`, or as much as the object is
  /// narrow, to the left and right or upwards and downwards.
  static F thickness_of(const WaterView& c, const Tap& tap, PlaneId plane, Vec2<F> at, F seen,
                        F whole) {
    const auto per_length = [&](int size, const char* shift, const glm::dvec3& at_eye,
                                const char* eye, const glm::dvec3& per_depth, const char* depth) {
      return given<F>(1.0 / size, shift) /
             (given<F>(glm::length(at_eye), eye) + seen * given<F>(glm::length(per_depth), depth));
    };
    const F x = per_length(c.size.x, "camera.column", c.rays.origin_dx, "camera.column_at_eye",
                           c.rays.ray_dx, "camera.column_per_depth");
    const F y = per_length(c.size.y, "camera.row", c.rays.origin_dy, "camera.row_at_eye",
                           c.rays.ray_dy, "camera.row_per_depth");
    const F none(0), back = seen + whole;
    F left = whole, right = whole, above = whole, below = whole;  // from there to the object's ends
    F apart = F(0.5 * kNarrowest) * whole;
    repeat<F>(kWidths, [&] {
      const auto look = [&](F to_right, F down, F& end) {
        const F beyond = tap.nearest(plane, at + Vec2<F>{apart * to_right, apart * down});
        end = select(end >= whole && beyond > back, F(0.75) * apart, end);
      };
      look(F(0) - x, none, left), look(x, none, right);
      look(none, F(0) - y, above), look(none, y, below);
      apart = F(2) * apart;
    });
    return min(whole, min(left + right, above + below));
  }

  /// From a place that something narrow hides to the nearer side of it, if surfaces farther away
  /// than `least` are seen at both sides, at a distance of 2, 4 ... 32 units; else 0. `upright`:
  /// whether the sides are left and right.
  template <class Mask>
  static Vec2<F> beside(const WaterView& c, const Tap& tap, PlaneId plane, Vec2<F> at,
                        const Mask& upright, F least) {
    // Pixels, of large pictures several.
    const double unit = std::max(std::max(c.size.x, c.size.y) / kPicture, 1.0);
    const F across = given<F>(unit / c.size.x, "camera.unit", 0);
    const F down = given<F>(unit / c.size.y, "camera.unit", 1);
    const auto aside = [&](F units) {
      return Vec2<F>{select(upright, units * across, F(0)), select(upright, F(0), units * down)};
    };
    F after(0), before(0), units(1);  // to the sides, 0 until they are found
    steps<F>(0, kPole, [&](auto) {
      units = F(2) * units;
      const auto look = [&](F there, F& side) {
        const F seen = tap.nearest(plane, at + aside(there));
        side =
            select(abs(side) <= F(0) && seen > least, select(seen < F(1e29), there, F(kSky)), side);
      };
      look(units, after), look(F(0) - units, before);
      return abs(after) <= F(0) || abs(before) <= F(0);
    });
    const auto narrow =
        abs(after) > F(0) && abs(before) > F(0) && max(after, abs(before)) < F(kSky);
    const F nearest = select(after > F(0) - before, before, after);
    return select(narrow, aside(nearest), Vec2<F>{F(0), F(0)});
  }
};

}  // namespace limpid
