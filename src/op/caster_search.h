#pragma once
#include "op/mirror_search.h"
#include "op/pass.h"
#include "op/pixel.h"
#include "op/screen_ray.h"

/// @file
/// Objects between a place on the bottom and the point at which its sunlight enters the water.

namespace limpid {

/// Share of the light that objects of the dry picture stop on the way from `place` to
/// `place + way`: 0 or 1, with a ramp where the way grazes a surface. Nobody sees how thick an
/// object is: one that hides the way counts as standing on it, unless it is far in front of it.
/// `margin`: objects count as nearer by this share of their depth, but not the bottom below the
/// way. Positions are relative to the eye. 0 for lanes other than `lanes`.
template <class F, class Tap, class M>
F caster_on(const Pass& c, const Pixel<F>& p, const Tap& tap, const M& lanes, const Vec3<F>& place,
            const Vec3<F>& way, double margin) {
  constexpr int kSteps = 24;
  constexpr double kThick = 2;       // of the way's length
  constexpr double kGrazes = 0.003;  // of the depth, which is rounded to that of a texel
  const Vec3<F> up = vec3_of<F>(c.up);
  const F thick = F(kThick) * length(way), rise = dot(up, way);
  const F level = given<F>(c.eye_above) + dot(up, place);
  F stops(0);
  steps<F>(1, kSteps + 1, [&](auto i) {
    const F t = share_of_step<F>(i, kSteps);
    const ScreenRay<F> to(c, p, place + t * way - p.surface_point);
    const Vec2<F> shift = to.shift_at(F(1));
    const F own = to.depth_at(F(1)), seen = min(tap.nearest(PlaneId::kDepth, shift), F(1e30));
    const auto stands = height_at(c, p, shift, seen) - level > (F(0.5) * t) * rise;
    const F spare = select(stands, F(margin) * max(own, F(1e-6)), F(0));
    const F behind = own - seen + spare, grazes = F(kGrazes) * max(own, F(1e-6));
    const auto counts = lanes && behind < thick + grazes;
    stops = max(stops, select(counts, saturate(behind / grazes - F(1)), F(0)));
    return lanes && stops < F(1);
  });
  return stops;
}

}  // namespace limpid
