#pragma once
#include "op/caustics_table.h"
#include "op/screen_ray.h"
#include "optics/refract.h"

namespace limpid {

/// Factor less 1 by which waves brighten sunlight that was scattered once: for the near and for the
/// far share of the path.
template <class F>
struct PathLight {
  F near, far;
};

/// Samples on the path that send equal light, and their places relative to the mean, where light
/// fades exponentially: -log(1 - (i + 1/2) / 4).
constexpr int kPathSamples = 4;
constexpr double kPathFalloff[kPathSamples] = {0.1335, 0.4700, 0.9808, 2.0794};

/// For views from the air, with WaterShadow's geometry; 0 for other views. `shade` is the darkness
/// of full shadow. Light is looked up as wide as the path between two samples: a lookup at a point
/// would have up to seven times the contrast.
template <class F, class Tap>
LIMPID_INLINE PathLight<F> path_light(const Pass& c, const Pixel<F>& p, const Tap& tap, F shade) {
  // From -log(1 - i / 4) to the next; the last ends where 97 % of the light is collected.
  constexpr double kLong[kPathSamples] = {0.2877, 0.4055, 0.6931, 2.1};
  // A level with texels of this width attenuates a wave like the mean over width 1.
  constexpr double kWide = 0.6;
  const CausticsTable& table = *c.caustics->in_water;
  const auto lit_at = [&](PlaneId plane, Vec2<F> shift) {
    const auto quad = tap.quad(shift);
    const Four<F> values = tap.read(plane, quad);
    F dark(0);
    for (int k = 0; k < 4; ++k) dark = dark + quad.weight(k) * (F(1) - values[k]);
    return F(1) - shade * dark;
  };
  const bool of_surface = c.planes.has(PlaneId::kSurfaceShadow);
  F begins(1), ends(1);
  if (!of_surface && c.planes.has(PlaneId::kShadow)) {
    begins = lit_at(PlaneId::kShadow, Vec2<F>{F(0), F(0)});
    ends = lit_at(PlaneId::kShadow, p.shift);
  }
  const Vec3<F> up = vec3_of<F>(c.up), map_x = vec3_of<F>(c.map_x), map_y = vec3_of<F>(c.map_y);
  const ScreenRay<F> line(c, p, p.sun_entry);
  const Vec2<F> aside{dot(map_x, p.sun_entry), dot(map_y, p.sun_entry)};
  const F at_x = dot(map_x, p.surface_point), at_y = dot(map_y, p.surface_point);
  const F cosine = abs(dot(up, p.to_viewer)),
          sink = refracted_cosine(cosine, given<F>(1 / c.ior, "water.per_ior"));
  const F pixel = caustics_texel(c, p.surface_depth, cosine);
  const F across = sqrt(aside.x * aside.x + aside.y * aside.y);
  const F whole = min(p.path, F(1e6)), mean = min(p.mean_scatter_distance, whole);
  const F even_share = min(F(2) * mean / max(whole, F(1e-30)), F(1));
  const F deepest = max(min(sink * whole, given<F>(table.depth, "caustics.depth")), F(1e-6));
  const F scattered = given<F>(table.scattered[1], "caustics.scattered_above");
  F near(0), far(0), near_sum(0), far_sum(0);
  each<F>(kPathSamples, [&](auto i) {
    F even(0), fading(0), stretch(0);
    for (int k = 0; k < kPathSamples; ++k) {
      only<F>(i, k, [&] {
        even = F((2 * k + 1) / double(kPathSamples)), fading = F(kPathFalloff[k]),
        stretch = F(kLong[k]);
      });
    }
    const F distance = min(mean * (fading + even_share * (even - fading)), whole);
    const F length = min(mean * (stretch + even_share * (F(2.0 / kPathSamples) - stretch)), whole);
    const F there = distance / max(whole, F(1e-30)), depth = sink * distance;
    const F lit = of_surface ? lit_at(PlaneId::kSurfaceShadow, line.shift_at(distance))
                             : begins + there * (ends - begins);
    const Vec2<F> entry{at_x + distance * aside.x, at_y + distance * aside.y};
    const F light = caustics_at(table, tap, entry, max(pixel, F(kWide) * across * length));
    const F focused = min(depth / deepest, F(1)) * exp((F(0) - scattered) * depth);
    const F more = lit * focused * (light - F(1));
    near = near + (F(1) - there) * more, near_sum = near_sum + (F(1) - there);
    far = far + there * more, far_sum = far_sum + there;
  });
  const auto seen = p.side > F(0.5) && p.path > F(0);
  return {select(seen, near / max(near_sum, F(1e-6)), F(0)),
          select(seen, far / max(far_sum, F(1e-6)), F(0))};
}

}  // namespace limpid
