#pragma once
#include "op/bottom_layer.h"
#include "op/halve.h"
#include "op/pass.h"
#include "op/pixel.h"
#include "op/screen_ray.h"
#include "op/seen_planes.h"

/// @file
/// The intersection of refracted rays with the surfaces in the depth plane.

namespace limpid {

/// The search along the ray of one pixel, or of one vector of pixels.
template <class F, class Tap>
class BottomSearch {
 public:
  struct Found {
    F distance;  ///< distance along the ray, +inf where it meets no surface
    F sure;      ///< 1 where the picture shows the bottom there, 0 where the distance is a guess
  };

  /// `fall`: the distance from the calm surface that the ray gains per unit of its length.
  /// `thickness`: the thickness of thin objects along the view, in scene units; 0: that of
  /// Pass::bottom_layer. `expected`: the step at which the search of the neighbouring pixel met the
  /// bottom, 0 before the first search; each search updates it. It saves lookups and changes no
  /// result.
  LIMPID_INLINE BottomSearch(const Pass& pass, const SeenPlanes& seen, const Pixel<F>& pixel,
                             const Tap& taps, const ScreenRay<F>& distance, F fall,
                             const double& thickness, int& expected)
      : c_(pass),
        planes_(seen),
        p_(pixel),
        tap_(taps),
        ray_(distance),
        fall_(fall),
        thickness_(thickness),
        expected_(expected) {}

  /// k fixed-point steps: each takes the depth of the bottom from the end of the ray that the step
  /// before found; the first takes the depth at the pixel itself. If the last two steps lead back
  /// and forth, the bottom is met between their ends, by a secant.
  Found iterate(int steps) const {
    F distance = drop_to(Vec2<F>{F(0), F(0)}, p_.dry_depth) / fall_, last = distance, first = last;
    repeat<F>(steps, [&] {
      first = last, last = distance;
      distance = to_level(distance);
    });
    const F there = last - first, back = distance - last;
    const auto returns = there * back < F(0) && max(max(first, last), distance) < F(1e20);
    distance = select(returns, first + there * (there / (there - back)), distance);
    const auto meets = distance < F(1e20);
    // From below, an endless ray meets the sky, which is visible.
    return {select(meets, distance, F(HUGE_VAL)), select(meets || p_.side < F(0), F(1), F(0))};
  }

  /// Marches to where the ray passes behind the depth plane (McGuire & Mara 2014, "Efficient GPU
  /// Screen-Space Ray Tracing"): equal steps on screen, then bisection.
  Found march() const {
    constexpr int kGuesses = 4;
    const F end = ray_.s_at(reach_in(planes_.bounds, p_.uv, ray_.across));
    const F most = min(end, F(1e30));
    const F pixels = max(length_on_screen(ray_.shift_at(most)), F(1));
    const F stride = F(1.0 / kSteps) * pixels;
    const F own_drop = drop_to(Vec2<F>{F(0), F(0)}, p_.dry_depth);
    // In shallow water the ray may meet the bottom and cross the shore within the first step. So
    // one lookup comes before that step, a little below the bottom at the pixel itself.
    const F shallow = min(F(1.25) * own_drop / fall_, most);
    const F first = min(ray_.share_at(shallow, most), F(1.0 / kSteps));
    const auto wet = tap_.wet();
    F before = F(0), after = F(1), found = F(0), hidden = F(0);
    // Tests the ray at a share t of its length; lanes without a hit stay open.
    const auto look_at = [&](F t, F texels, bool begins) {
      const auto open = wet && found < F(0.5);
      const F distance = ray_.at_share(t, most);
      Sight at = look(distance);
      at.behind = select(open, at.behind, F(-1));
      const F hides = past(at, texels);
      auto hit = at.behind >= F(0) && hides < F(0.5);
      if (begins) hit = hit || passes_level_near(distance);
      // A steep rise of the bottom looks like an object in front of it until its edge is found.
      const auto doubtful = open && hidden < F(0.5) && at.behind >= F(0) && !hit;
      if_any(doubtful,
             [&] { hit = hit || (doubtful && edge_between(before, t, most).hides < F(0.5)); });
      after = select(open && hit, t, after);
      before = select(open && !hit, t, before);
      hidden = select(open && !hit, select(is_free(at), F(0), F(1)), hidden);
      found = select(hit, F(1), found);
      return wet && found < F(0.5);
    };
    if_any(look_at(first, F(2), true), [&] {
      int goal = 0, next_leap = c_.heights.known ? 1 : kSteps + 1;  // the step to which to leap
      int next_doubt = next_leap;  // the step after which to test for misses
      const auto leap = [&](int i) {
        const auto open = wet && found < F(0.5);
        if (i > next_doubt && !any(open && hidden < F(0.5))) {
          const F distance = ray_.at_share(F(double(i - 1) / kSteps), most);
          if (stays_behind(open, distance, most, stride)) return kSteps + 1;
          next_doubt = i - 1 + kLooksBetweenDoubts;
        }
        if (i < next_leap) return i;
        // The first leap leads almost to the step at which the neighbouring rays met the bottom, or
        // else to the level of the bottom at the pixel itself.
        const auto steps_to_level = [&] {
          const F level = ray_.share_at(min(own_drop / fall_, most), most);
          return static_cast<int>(kSteps * least(select(open, saturate(level), F(1))));
        };
        if (i == 1) goal = (expected_ > 0 ? expected_ : steps_to_level()) - 1;
        i = leap_from(i, goal, open, most);
        next_leap = i + kLooksBetweenLeaps;
        return i;
      };
      steps<F>(1, kSteps + 1, leap,
               [&](auto i) { return look_at(Loop<F>::ratio(i, kSteps), stride, false); });
    });
    if (c_.heights.known) {
      expected_ = static_cast<int>(kSteps * least(select(wet, after, F(1))));
    }
    const auto meets = found > F(0.5);
    F distance = F(0), sure = F(0);
    if_any(meets, [&] {
      // The bisection may end at the edge of an object in front of the bottom.
      const Edge edge = edge_between(before, after, most);
      after = edge.share;
      const F met = ray_.at_share(after, most);
      sure = select(meets && hidden < F(0.5) && edge.hides < F(0.5), F(1), F(0));
      // Nearest lookups make the depth plane a staircase; the interpolated level between its texels
      // is smooth, and at most about a texel away.
      const F smooth = to_level(met);
      const F texel = F(1.5) / pixels;
      distance = min(max(smooth, ray_.at_share(max(after - texel, F(0)), most)),
                     ray_.at_share(min(after + texel, F(1)), most));
    });
    const auto unseen = wet && sure < F(0.5);
    if_any(unseen, [&] {
      const auto hides = unseen && (meets || hidden > F(0.5));
      const auto known = hides && (c_.bottom_layer ? p_.side > F(0) : F(0) > F(0));
      F ends = F(0);
      // A ray that leaves the picture in front of all surfaces ends beyond the picture, at the
      // level of the bottom that is visible at its edge.
      if_any(unseen && !known, [&] {
        const F begin = select(hides, own_drop / fall_, most);
        ends = max(iterated(begin, kGuesses), select(hides, F(0), most));
      });
      if_any(known, [&] { ends = select(known, end_behind(known, most), ends); });
      distance = select(unseen, ends, distance);
    });
    return {select(distance < F(1e20), distance, F(HUGE_VAL)), sure};
  }

 private:
  static constexpr int kSteps = 48;
  static constexpr int kLeap = 16, kLooksBetweenLeaps = 6, kLooksBetweenDoubts = 3;
  static constexpr double kHiding = 0.25;      ///< see past()
  static constexpr double kLeastFall = 0.021;  ///< below it `fall` may exceed the true fall
  static constexpr int kStepsBehind = 12, kSecants = 3;

  /// The fixed-point steps from a distance.
  F iterated(F distance, int steps) const {
    repeat<F>(steps, [&] { distance = to_level(distance); });
    return distance;
  }

  /// Step i, or a later step if no lookup from i up to it would be a hit, because by Pass::heights
  /// the rays stay above all surfaces on their path. Leaps up to the step `goal` become shorter and
  /// shorter, because near the bottom only short leaps are safe; leaps beyond it become longer.
  template <class Lanes>
  int leap_from(int i, int goal, Lanes open, F most) const {
    const F top = surface_height();
    if (any(open && top > given<F>(c_.heights.most))) return i;
    const auto distance_at = [&](int step) {
      return ray_.at_share(F(double(step) / kSteps), most);
    };
    Vec2<F> from = ray_.shift_at(distance_at(i));
    int length = kLeap;
    while (i < kSteps) {
      const bool before_goal = i < goal;
      if (before_goal) length = (goal - i + 1) / 2;
      if (length < 2) break;
      const int end = i + length < kSteps ? i + length : kSteps;
      const F distance = distance_at(end);
      const Vec2<F> to = ray_.shift_at(distance);
      const auto lowest = least(select(open, top - distance * fall_, F(HUGE_VAL)));
      if (lowest > tap_.heights(planes_.depth, open, from, to).highest) {
        i = end;
        from = to;
        length *= 2;
        if (before_goal && goal - i < 2) break;
      } else {
        if (before_goal) break;
        length /= 4;
      }
    }
    return i;
  }

  /// Height of the surface point above the calm surface.
  LIMPID_INLINE F surface_height() const {
    return given<F>(c_.eye_above) + dot(vec3_of<F>(c_.up), p_.surface_point);
  }

  /// Whether rays that have passed behind an object stay far behind all surfaces on their path, by
  /// Pass::heights, so that past() would return 1 at each lookup from `distance` on. Along the view
  /// ray of a texel, depths are proportional to heights. So the condition behind > slack of past()
  /// is tested for heights of calm water, times -1; the term of the texels is largest at one of the
  /// two ends.
  template <class Lanes>
  bool stays_behind(Lanes open, F distance, F most, F texels) const {
    const F top = surface_height();
    const Vec2<F> from = ray_.shift_at(distance), to = ray_.shift_at(most);
    const F slope = max(calm_step_down(from), calm_step_down(to));
    const F deepest = F(1 - kHiding) * (distance * fall_ - top) - texels * slope;
    const F surely = select(fall_ > F(kLeastFall), F(1 - 1e-4) * deepest, F(-HUGE_VAL));
    return least(select(open, surely, F(HUGE_VAL))) >
           tap_.heights(planes_.depth, open, from, to).deepest;
  }

  /// The height that calm_depth_step() spans along the view ray at `shift`.
  LIMPID_INLINE F calm_step_down(Vec2<F> shift) const {
    const F falls = height_at(c_, p_, shift, F(0)) - height_at(c_, p_, shift, F(1));
    return falls * calm_depth_step(c_, p_, shift);
  }

  /// Height of the surface point over the point at `depth` on the view ray at `shift` (for a view
  /// from below, height of that point over the surface point); at least 0.
  LIMPID_INLINE F drop_to(Vec2<F> shift, F depth) const {
    return max(p_.side * (surface_height() - height_at(c_, p_, shift, depth)), F(0));
  }

  /// The same for the depth of a texel; 0 where the texel has no depth of the bottom, because it
  /// shows an object above the surface, or the layer below is empty (the bottom rises out of the
  /// water and was clipped).
  LIMPID_INLINE F seen_drop(Vec2<F> shift, F depth) const {
    const F drop = drop_to(shift, depth);
    return planes_.below ? select(depth < F(1e30), drop, F(0)) : drop;
  }

  /// The ray at a point, compared with the depth plane there.
  struct Sight {
    F drop;    ///< depth of the visible surface below the surface point; 0 if it stands in front of
               ///< the water
    F behind;  ///< how far the ray has passed behind it, -1 where the ray is in front
    Vec2<F> shift;
    F own;  ///< eye depth of the ray
  };

  LIMPID_INLINE Sight look(F distance) const {
    const Vec2<F> shift = ray_.shift_at(distance);
    const F seen = tap_.nearest(planes_.depth, shift), own = ray_.depth_at(distance);
    const F drop = seen_drop(shift, seen);
    return {drop, select(drop > F(0) && own >= seen, own - seen, F(-1)), shift, own};
  }

  /// Whether the ray runs in front of a visible bottom.
  LIMPID_INLINE static auto is_free(const Sight& at) { return at.behind < F(0) && at.drop > F(0); }

  /// The distance at which the rays of `lanes` meet the bottom of Pass::bottom_layer, which
  /// continues behind the objects that hide it, up to `most`; beyond `most` the distance to the
  /// bottom's level there; +inf where there is no bottom. Equal steps on screen, then secants.
  template <class Lanes>
  [[gnu::noinline]] F end_behind(Lanes lanes, F most) const {
    const BottomLayerTaps<F, Tap> layer(*c_.bottom_layer, p_, tap_);
    // Height of the ray over the bottom.
    const auto room = [&](F distance) {
      return surface_height() + layer.bottom(ray_.shift_at(distance)) - distance * fall_;
    };
    const F end = min(most, given<F>(c_.bottom_layer->most_drop) / fall_);
    F before = F(0), after = end, room_before = room(F(0)), room_after = F(0);
    F found = select(lanes, F(0), F(1));
    steps<F>(1, kStepsBehind + 1, [&](auto i) {
      const F distance = ray_.at_share(Loop<F>::ratio(i, kStepsBehind), end);
      const F here = room(distance);
      const auto open = found < F(0.5);
      const auto hit = open && here <= F(0);
      after = select(hit, distance, after);
      room_after = select(open, here, room_after);
      before = select(open && !hit, distance, before);
      room_before = select(open && !hit, here, room_before);
      found = select(hit, F(1), found);
      return found < F(0.5);
    });
    F met = after;
    repeat<F>(kSecants, [&] {
      const F share = room_before / max(room_before - room_after, F(1e-20));
      met = before + saturate(share) * (after - before);
      const F here = room(met);
      const auto hit = here <= F(0);
      after = select(hit, met, after);
      room_after = select(hit, here, room_after);
      before = select(hit, before, met);
      room_before = select(hit, room_before, here);
    });
    const F level = max(end + room_after / fall_, F(0));
    const F distance = select(found > F(0.5), met, level);
    const F behind = max(distance, F(0));
    // An object in the water may hide parts of itself: there its level continues, unless the
    // picture shows bottom in that place. An object above the water just beyond, apart from the
    // first, hides the bottom.
    const Vec2<F> here{F(0), F(0)};
    const auto stands_at = [&](Vec2<F> shift, F depth) {
      return !layer.is_bottom(shift, F(0) - height_at(c_, p_, shift, depth));
    };
    const auto stands = stands_at(here, p_.dry_depth);
    F ends = select(layer.is_bottomless(ray_.shift_at(behind)), F(HUGE_VAL), behind);
    if_any(lanes && stands, [&] {
      const F beyond = F(1.05) * behind, own_level = drop_to(here, p_.dry_depth) / fall_;
      const Vec2<F> there = ray_.shift_at(own_level);
      const F shown = tap_.nearest(planes_.depth, there);
      const auto empty = planes_.below ? !(shown < F(1e30)) : F(0) > F(0);
      const auto goes_on = empty || stands_at(there, shown);
      const auto itself =
          (look(beyond).drop > F(0) || !layer.is_apart(c_, planes_, ray_.shift_at(beyond))) &&
          !layer.is_far_behind(c_, planes_, ray_.shift_at(behind));
      ends = select(stands && goes_on && itself, own_level, ends);
    });
    return ends;
  }

  /// Where a ray passes behind the visible surface.
  struct Edge {
    F share;  ///< of the ray's length on screen
    F hides;  ///< 1 where it passes far behind that surface, and does not meet it
  };

  /// The edge between `before` and `after`; at `after` the ray is behind. A ray that runs close
  /// over the surface up to the edge of something in front meets that surface: a ridge of a rock
  /// hides a part of the rock behind it.
  [[gnu::noinline]] Edge edge_between(F before, F after, F most) const {
    const Bracket<F> ends = halve<F>(
        {before, after}, 6, [&](F t) __attribute__((always_inline)) {
          return look(ray_.at_share(t, most)).behind >= F(0);
        });
    constexpr int kTexels = 2;
    Edge edge{ends.high, past(look(ray_.at_share(ends.high, most)), F(kTexels))};
    if_any(edge.hides > F(0.5), [&] {
      const F distance = ray_.at_share(ends.low, most), own = ray_.depth_at(distance);
      const Vec2<F> shift = ray_.shift_at(distance);
      const F seen = tap_.nearest(planes_.depth, shift);
      auto close = edge.hides > F(0.5) && seen_drop(shift, seen) > F(0) &&
                   abs(seen - own) <= slack_at(shift, own, F(kTexels));
      if (c_.bottom_layer) {
        // The layer tells where the bottom goes on behind what hides it.
        const BottomLayerTaps<F, Tap> layer(*c_.bottom_layer, p_, tap_);
        close = close && !layer.is_bottom(shift, F(0) - height_at(c_, p_, shift, seen));
      }
      edge = {select(close, ends.low, edge.share), select(close, F(0), edge.hides)};
    });
    return edge;
  }

  /// 1 where the visible surface lies far in front of the ray: it hides the bottom and is not hit.
  /// On a slope the ray may be behind by as much as depth changes from texel to texel; `texels`
  /// such steps are allowed. An object of known thickness hides all points farther behind it than
  /// this thickness.
  LIMPID_INLINE F past(const Sight& at, F texels) const {
    F hides(0);
    if_any(at.behind >= F(0), [&] {
      const F step = calm_depth_step(c_, p_, at.shift);
      const F slack = slack_at(at.shift, at.own, texels);
      hides = select(at.behind > slack, F(1), F(0));
      if (!c_.bottom_layer) return;
      const auto doubtful = at.behind > F(0.5) * step && at.behind <= slack;
      if_any(doubtful, [&] { hides = select(doubtful, is_behind_thin(at), hides); });
    });
    return hides;
  }
  LIMPID_INLINE F slack_at(Vec2<F> shift, F own, F texels) const {
    const F calm = min(calm_depth_at(c_, p_, shift), own);
    return F(kHiding) * (own - calm) + texels * calm_depth_step(c_, p_, shift);
  }
  [[gnu::noinline]] F is_behind_thin(const Sight& at) const {
    const BottomLayerTaps<F, Tap> layer(*c_.bottom_layer, p_, tap_);
    const auto shape = layer.shape(at.shift);
    const auto stands = shape.thinness > F(0) && p_.side > F(0) &&
                        at.drop < F(BottomLayer::kOfBottom) * (surface_height() + shape.drop);
    const F thickness =
        thickness_ <= 0 ? F(1) / max(shape.thinness, F(1e-30)) : given<F>(thickness_);
    return select(stands && at.behind > thickness, F(1), F(0));
  }

  /// Length in pixels.
  LIMPID_INLINE F length_on_screen(Vec2<F> shift) const {
    const F x = given<F>(c_.size.x) * shift.x, y = given<F>(c_.size.y) * shift.y;
    return sqrt(x * x + y * y);
  }

  /// The distance at which the ray meets the level of the bottom that is visible at `distance`,
  /// interpolated from four texels; +inf where half of their weight or more has no bottom;
  /// `distance` itself where no texel lies below the surface.
  F to_level(F distance) const {
    if (c_.bottomless) return to_level_if_any(distance);
    const auto quad = tap_.quad(ray_.shift_at(distance));
    const Four<F> depths = tap_.read(planes_.depth, quad);
    F level = F(0), weight = F(0);
    for (int k = 0; k < 4; ++k) {
      const F drop = seen_drop(tap_.place(planes_.depth, quad, k), depths[k]);
      const F share = select(drop > F(0), quad.weight(k), F(0));
      level = level + share * drop;
      weight = weight + share;
    }
    const auto seen = weight > F(1e-3);
    return select(seen, level / (max(weight, F(1e-3)) * fall_), distance);
  }

  /// to_level() for pictures that may lack a bottom. A separate function, to keep the march small.
  [[gnu::noinline]] F to_level_if_any(F distance) const {
    const auto quad = tap_.quad(ray_.shift_at(distance));
    const Four<F> depths = tap_.read(planes_.depth, quad);
    F level = F(0), weight = F(0), endless = F(0);
    for (int k = 0; k < 4; ++k) {
      const F drop = seen_drop(tap_.place(planes_.depth, quad, k), depths[k]);
      const F share = select(drop > F(0), quad.weight(k), F(0));
      const F some = select(nothing(depths[k]), F(0), share);
      endless = endless + (share - some);
      level = level + some * drop;
      weight = weight + some;
    }
    const auto seen = weight > F(1e-3);
    const F met = select(seen, level / (max(weight, F(1e-3)) * fall_), distance);
    return select(endless > F(1e-3) && endless >= weight, F(HUGE_VAL), met);
  }

  /// Whether the ray has passed the level of a bottom so near on screen that the staircase of
  /// depths need not show it. On a beach that rises out of the water there, no later lookup would
  /// show it.
  LIMPID_INLINE auto passes_level_near(F distance) const {
    auto passes = length_on_screen(ray_.shift_at(distance)) < F(2);
    if_any(passes, [&] { passes = passes && to_level(distance) < distance; });
    return passes;
  }

  const Pass& c_;
  const SeenPlanes& planes_;
  const Pixel<F>& p_;
  const Tap& tap_;
  const ScreenRay<F>& ray_;
  F fall_;
  const double& thickness_;
  int& expected_;
};

}  // namespace limpid
