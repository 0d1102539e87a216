#pragma once
#include "op/mirror_search.h"

/// @file
/// The height over the water's horizon of the objects that a depth plane shows.

namespace limpid {

/// Sine of the elevation of the skyline, as seen from a pixel's surface point: of all objects above
/// the calm water that a depth plane shows along `ray` on screen and on the side of `ahead`, the
/// highest one counts; 0 without objects. `goes_on`: an object at the edge of the picture is as
/// high as can be. `ray` goes up, so that on screen it leads beyond the horizon. The results of
/// lanes other than `lanes` are undefined.
template <class F, class Tap, class Mask>
F skyline(const WaterView& c, const Tap& tap, const Mask& lanes, PlaneId plane,
          const Bounds& bounds, const Pixel<F>& p, const ScreenRay<F>& ray, Vec3<F> ahead,
          int count, bool goes_on) {
  const F leaves = ray.s_at(reach_ahead(c, bounds, p.uv, ray.across));
  const Vec2<F> end = ray.shift_at(leaves);
  const auto sine_at = [&](F t) {
    const Vec2<F> shift = t * end;
    const F seen = min(tap.nearest(plane, shift), F(1e30));
    const F height = height_at(c, p, shift, seen);
    const Vec3<F> offset = offset_to(c, p, shift, seen);
    const auto stands = seen < F(1e9) && height > F(0) && dot(offset, ahead) > F(0);
    return select(stands, min(height / max(length(offset), F(1e-30)), F(1)), F(0));
  };
  // Whether the plane shows only sky or surfaces under water at the steps after `begin` up to
  // `last_one`.
  const auto passes = [&](int begin, int last_one) {
    const Vec2<F> a = share_of_step<F>(begin, count) * end;
    const Vec2<F> b = share_of_step<F>(last_one, count) * end;
    const float low = tap.range(plane, lanes, a, b).low;
    const F level = max(calm_depth_at(c, p, a), calm_depth_at(c, p, b));
    // Seen from below the calm level, a surface farther away than that level is above it.
    if (!(c.eye_above > 0)) return low >= 1e9f;
    return low >= 1e9f || low > greatest(select(lanes, F(1 + 1e-4) * level, F(-HUGE_VAL)));
  };
  // Bisection between the step with the highest object and the next one finds the edge of the
  // object.
  constexpr int kHalvings = 3;
  F sine = F(0), at = F(0), after = F(0);
  Leaps leaps(count);
  const auto leap = [&](int i) { return leaps.from(i, passes); };
  steps<F>(1, count + 1, leap, [&](auto i) {
    const F t = share_of_step<F>(i, count), seen = sine_at(t);
    const auto higher = seen > sine;
    sine = select(higher, seen, sine);
    at = select(higher, t, at);
    after = select(higher, t + (F(0.5) + Loop<F>::ratio(i, count)) * F(1.0 / count), after);
    return lanes;
  });
  repeat<F>(kHalvings, [&] {
    const F t = min(F(0.5) * (at + after), F(1)), seen = sine_at(t);
    const auto higher = seen > sine;
    sine = select(higher, seen, sine);
    after = select(higher, after, t);
    at = select(higher, t, at);
  });
  return goes_on ? select(at >= F(1) && leaves < F(1e20), F(1), sine) : sine;
}

}  // namespace limpid
