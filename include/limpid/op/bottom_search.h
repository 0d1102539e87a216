#pragma once
#include "limpid/op/context.h"
#include "limpid/op/screen_ray.h"

/// @file
/// Where a ray under the water meets what the depth plane shows.

namespace limpid {

/// What is looked up.
struct SeenPlanes {
  PlaneId color, depth;
  Bounds bounds;
  bool below;  ///< holds what lies under the crests of the water alone, +inf where there is nothing
};

/// The search along the ray of one pixel, or of one vector of pixels.
template <class F, class Tap>
class BottomSearch {
 public:
  struct Found {
    F way;   ///< along the ray, +inf where it meets nothing
    F sure;  ///< 1 where the bottom was seen, 0 where it is a guess
  };

  /// `fall` is the distance from the calm surface that the ray gains per unit of its way.
  LIMPID_INLINE BottomSearch(const Context& context, const SeenPlanes& seen, const Pixel<F>& pixel,
                             const Tap& taps, const ScreenRay<F>& way, F falls)
      : c_(context), planes_(seen), p_(pixel), tap_(taps), ray_(way), fall_(falls) {}

  /// k times as deep as the bottom that the last guess has found, from that at the pixel itself on.
  Found iterate(int steps) const {
    F way = drop_to(Vec2<F>{F(0), F(0)}, p_.dry_depth) / fall_;
    for (int i = 0; i < steps; ++i) way = to_level(way);
    const auto meets = way < F(1e20);
    // From below it is the sky that is met without end, and that is seen.
    return {select(meets, way, F(HUGE_VAL)), select(meets || p_.side < F(0), F(1), F(0))};
  }

  /// To where the ray passes behind the depth plane (McGuire & Mara 2014, "Efficient GPU
  /// Screen-Space Ray Tracing"), with equal steps on screen, then bisection.
  Found march() const {
    constexpr int kGuesses = 4;
    const F end = ray_.s_at(reach_in(planes_.bounds, p_.uv, ray_.across));
    const F most = min(end, F(1e30));
    const F pixels = max(length_on_screen(ray_.shift_at(most)), F(1));
    const F stride = F(1.0 / kSteps) * pixels;
    const F own_drop = drop_to(Vec2<F>{F(0), F(0)}, p_.dry_depth);
    // In shallow water the bottom may be met, and the shore crossed, before the first step ends: a
    // look goes before it, to a little under the bottom at the pixel itself.
    const F shallow = min(F(1.25) * own_drop / fall_, most);
    const F first = min(ray_.share_at(shallow, most), F(1.0 / kSteps));
    F before = F(0), after = F(1), found = F(0), hidden = F(0);
    int next_leap = c_.heights.known ? 1 : kSteps + 1;  // the step at which to try one
    for (int i = 0; i <= kSteps; ++i) {
      const auto open = found < F(0.5);
      if (i >= next_leap) {
        // The first one almost to where the level of the bottom at the pixel itself is met.
        const auto steps_to_level = [&] {
          const F level = ray_.share_at(min(own_drop / fall_, most), most);
          return static_cast<int>(kSteps * least(select(open, saturate(level), F(1)))) - 1;
        };
        i = leap_from(i, i == 1 ? steps_to_level() : kLeap, open, most);
        next_leap = i + kLooksBetweenLeaps;
      }
      const F t = i == 0 ? first : F(double(i) / kSteps);
      const F way = ray_.at_share(t, most);
      Sight at = look(way);
      at.behind = select(open, at.behind, F(-1));
      const F hides = past(at, i == 0 ? F(2) : stride);
      auto hit = at.behind >= F(0) && hides < F(0.5);
      if (i == 0) hit = hit || passes_level_near(way);
      // A bottom that rises steeply looks like something that hides it, until its edge is found.
      const auto doubtful = open && hidden < F(0.5) && at.behind >= F(0) && !hit;
      if (any(doubtful)) {
        const F edge = ray_.at_share(edge_between(before, t, most), most);
        hit = hit || (doubtful && past(look(edge), F(2)) < F(0.5));
      }
      after = select(open && hit, t, after);
      before = select(open && !hit, t, before);
      hidden = select(open && !hit, select(is_free(at), F(0), F(1)), hidden);
      found = select(hit, F(1), found);
      if (!any(found < F(0.5))) break;
    }
    if (!any(found > F(0.5))) return {iterate(kGuesses).way, F(0)};
    const F step = after;
    after = edge_between(before, step, most);
    const F met = ray_.at_share(after, most);
    // The bisection may have gone to the edge of what hides the bottom.
    const F at_edge = past(look(met), F(2));
    const auto seen = found > F(0.5) && hidden < F(0.5) && at_edge < F(0.5);
    // The depth plane is a staircase; the level between its texels is smooth, and at most a texel
    // or so away.
    const F smooth = to_level(met);
    const F texel = F(1.5) / pixels;
    F way = min(max(smooth, ray_.at_share(max(after - texel, F(0)), most)),
                ray_.at_share(min(after + texel, F(1)), most));
    if (any(!seen)) {
      way = select(seen, way, last_drop(found > F(0.5) && !seen, step, first, most) / fall_);
      if (any(found < F(0.5))) way = select(found > F(0.5), way, iterate(kGuesses).way);
    }
    return {select(way < F(1e20), way, F(HUGE_VAL)), select(seen, F(1), F(0))};
  }

 private:
  static constexpr int kSteps = 48;
  static constexpr int kLeap = 16, kLooksBetweenLeaps = 6;

  /// i, or a later step if from i up to it a look would find nothing: the rays stay above all that
  /// they pass, by Context::heights. `length` is how many steps are tried at once at first.
  template <class Lanes>
  int leap_from(int i, int length, Lanes open, F most) const {
    const F top = F(c_.eye_above) + dot(vec3_of<F>(c_.up), p_.surface_point);
    if (any(open && top > F(c_.heights.most))) return i;
    const auto way_to = [&](int step) { return ray_.at_share(F(double(step) / kSteps), most); };
    Vec2<F> from = ray_.shift_at(way_to(i));
    while (length >= 2 && i < kSteps) {
      const int end = i + length < kSteps ? i + length : kSteps;
      const F way = way_to(end);
      const Vec2<F> to = ray_.shift_at(way);
      const auto lowest = least(select(open, top - way * fall_, F(HUGE_VAL)));
      if (lowest > tap_.highest(planes_.depth, open, from, to)) {
        i = end;
        from = to;
        length *= 2;
      } else {
        length /= 4;
      }
    }
    return i;
  }

  /// How far below the surface point (above it, from below) a point seen on the screen lies.
  LIMPID_INLINE F drop_to(Vec2<F> shift, F depth) const {
    const F surface = F(c_.eye_above) + dot(vec3_of<F>(c_.up), p_.surface_point);
    return max(p_.side * (surface - height_at(c_, p_, shift, depth)), F(0));
  }

  /// The same of what a texel shows: 0 where that tells nothing, for it stands above the surface or
  /// the layer below is empty there (cut away, where the bottom rises out of the water).
  LIMPID_INLINE F seen_drop(Vec2<F> shift, F depth) const {
    const F drop = drop_to(shift, depth);
    return planes_.below ? select(depth < F(1e30), drop, F(0)) : drop;
  }

  /// Where a ray stands against what the depth plane shows there.
  struct Sight {
    F drop;    ///< of what is seen, below the surface point; 0 when it stands before the water
    F behind;  ///< how far the ray has passed behind it, -1 where it has not
    Vec2<F> shift;
    F own;  ///< depth of the ray
  };

  LIMPID_INLINE Sight look(F way) const {
    const Vec2<F> shift = ray_.shift_at(way);
    const F seen = tap_.nearest(planes_.depth, shift), own = ray_.depth_at(way);
    const F drop = seen_drop(shift, seen);
    return {drop, select(drop > F(0) && own >= seen, own - seen, F(-1)), shift, own};
  }

  /// Whether the ray runs before a bottom that is seen.
  LIMPID_INLINE static auto is_free(const Sight& at) { return at.behind < F(0) && at.drop > F(0); }

  /// How far below the surface point the bottom lies that a step up to `end`, a share of the way,
  /// has seen last; that at the pixel itself where none has. Looks again, for it is asked seldom.
  template <class Lanes>
  F last_drop(Lanes wanted, F end, F first, F most) const {
    F drop = drop_to(Vec2<F>{F(0), F(0)}, p_.dry_depth);
    F looks = select(wanted, F(1), F(0));
    for (int i = kSteps; i >= 0; --i) {
      const F t = i == 0 ? first : F(double(i) / kSteps);
      const auto before = looks > F(0.5) && t <= end;
      if (!any(before)) continue;
      const Sight at = look(ray_.at_share(t, most));
      const auto ends = before && is_free(at);
      drop = select(ends, at.drop, drop);
      looks = select(ends, F(0), looks);
    }
    return drop;
  }

  /// Where the ray passes behind what is seen, between two shares of its way on screen, the later
  /// of which is behind.
  LIMPID_INLINE F edge_between(F before, F after, F most) const {
    for (int i = 0; i < 6; ++i) {
      const F t = F(0.5) * (before + after);
      const auto hit = look(ray_.at_share(t, most)).behind >= F(0);
      after = select(hit, t, after);
      before = select(hit, before, t);
    }
    return after;
  }

  /// 1 where what is seen lies far before the ray: it hides the bottom, it is not hit. A slope is
  /// missed by as much as its depth changes from texel to texel, so many of which are forgiven.
  LIMPID_INLINE F past(const Sight& at, F texels) const {
    if (!any(at.behind >= F(0))) return F(0);
    const F calm = min(calm_depth_at(c_, p_, at.shift), at.own);
    const F slack = F(0.25) * (at.own - calm) + texels * calm_depth_step(c_, p_, at.shift);
    return select(at.behind > slack, F(1), F(0));
  }

  /// In pixels.
  LIMPID_INLINE F length_on_screen(Vec2<F> shift) const {
    const F x = F(c_.size.x) * shift.x, y = F(c_.size.y) * shift.y;
    return sqrt(x * x + y * y);
  }

  /// Where the ray meets the level of the bottom that is seen at `way`, mixed from four texels, and
  /// +inf where half of what is seen or more has none; `way` itself where nothing below the surface
  /// is seen.
  F to_level(F way) const {
    if (c_.bottomless) return to_level_if_any(way);
    const auto quad = tap_.quad(ray_.shift_at(way));
    const Four<F> depths = tap_.read(planes_.depth, quad);
    F level = F(0), weight = F(0);
    for (int k = 0; k < 4; ++k) {
      const F drop = seen_drop(tap_.place(planes_.depth, quad, k), depths[k]);
      const F share = select(drop > F(0), quad.weight(k), F(0));
      level = level + share * drop;
      weight = weight + share;
    }
    const auto seen = weight > F(1e-3);
    return select(seen, level / (max(weight, F(1e-3)) * fall_), way);
  }

  /// The same where there may be no bottom. On its own, for the march is to stay small.
  [[gnu::noinline]] F to_level_if_any(F way) const {
    const auto quad = tap_.quad(ray_.shift_at(way));
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
    const F met = select(seen, level / (max(weight, F(1e-3)) * fall_), way);
    return select(endless > F(1e-3) && endless >= weight, F(HUGE_VAL), met);
  }

  /// Whether the ray has passed the level of a bottom that is so near on screen that the staircase
  /// of depths need not show it. A beach that rises out of the water there would show nothing
  /// later.
  LIMPID_INLINE auto passes_level_near(F way) const {
    const auto near = length_on_screen(ray_.shift_at(way)) < F(2);
    if (!any(near)) return near;
    return near && to_level(way) < way;
  }

  const Context& c_;
  const SeenPlanes& planes_;
  const Pixel<F>& p_;
  const Tap& tap_;
  const ScreenRay<F>& ray_;
  F fall_;
};

}  // namespace limpid
