#pragma once
#include "op/mirror_search.h"
#include "op/pass.h"
#include "op/pixel.h"
#include "op/screen_ray.h"

/// @file
/// Objects of the dry picture that hide the sun from the water's surface.

namespace limpid {

/// Whether a march of these `steps` meets a surface in the picture between the surface point and
/// the sun: 1 or 0, 0 for lanes other than `lanes`.
template <class F, class Tap, class Mask>
F sun_met(const Pass& c, const Pixel<F>& p, const Tap& tap, const Mask& lanes,
          const ScreenRay<F>& to_sun, const MirrorSteps& steps) {
  const auto above = [&](Vec2<F> shift, F depth) { return height_at(c, p, shift, depth) > F(0); };
  const F hit =
      MirrorSearch<F, Tap>::march(c, tap, lanes, PlaneId::kDepth, c.dry, p, to_sun, steps, above)
          .hit;
  return select(lanes, hit, F(0));
}

/// How much surfaces hide the sun from the surface point: 1 if one in the picture stands between
/// them, 0 for lanes other than `lanes`. If the ray to the sun leaves the picture, and not towards
/// the viewer, the surface at that edge goes on beyond it: wholly as high as the picture shows it,
/// and less and less up to three times as high.
template <class F, class Tap, class Mask>
F sun_hidden(const Pass& c, const Pixel<F>& p, const Tap& tap, const Mask& lanes) {
  constexpr MirrorSteps kSteps{24, 0.2, 0.2, true};
  constexpr double kEnds = 3;
  const Vec3<F> to_sun = vec3_of<F>(c.sun.direction);
  const ScreenRay<F> ray(c, p, to_sun);
  F hidden = sun_met(c, p, tap, lanes, ray, kSteps);
  const F end = ray.s_at(reach_ahead(c, c.dry, p.uv, ray.across));
  const auto leaves = lanes && hidden < F(0.5) && ray.depth_step > F(0) && end < F(1e20);
  if_any(leaves, [&] {
    const Vec2<F> edge = ray.shift_at(select(leaves, end, F(1)));
    const F seen = tap.nearest(PlaneId::kDepth, edge);
    const F height = height_at(c, p, edge, seen);
    const F meets = (seen - ray.depth) / max(ray.depth_step, F(1e-30));
    const auto goes_on = leaves && seen < F(1e30) && height > F(0) && meets > F(0);
    const F rises = meets * dot(vec3_of<F>(c.up), to_sun);
    const F known = saturate((F(kEnds) - rises / max(height, F(1e-30))) * F(1 / (kEnds - 1)));
    hidden = select(goes_on, known, hidden);
  });
  return hidden;
}

}  // namespace limpid
