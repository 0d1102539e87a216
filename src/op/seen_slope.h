#pragma once
#include "op/screen_ray.h"

namespace limpid {

/// The slope of a visible surface.
template <class F>
struct SeenSlope {
  Vec3<F> normal;  ///< unit, towards the viewer; 0 where depths overflow
  F depth;         ///< eye depth at the texel
  F steps;         ///< change of depth from one texel to the next, over the depth
  /// The shift from the texel to the one two farther from a nearer surface, if such a surface
  /// borders on one side only; else 0. The nearer surface may have a part in the texel's color,
  /// because depth is from one sample of many.
  Vec2<F> clear;
};

/// The slope at the texel that is next to `shift`: from depths two pixels to all sides, where those
/// across an edge count least, and those beyond the picture hardly.
template <class F, class Tap>
LIMPID_INLINE SeenSlope<F> seen_slope(const Pass& c, const Pixel<F>& p, const Tap& tap,
                                      Vec2<F> shift) {
  constexpr double kApart = 2, kMostStep = 0.1, kEdge = 0.03;
  const auto depth_at = [&](Vec2<F> place) {
    return min(max(tap.nearest(PlaneId::kDepth, place), F(1e-18)), F(1e18));
  };
  const Vec2<F> low{given<F>(c.dry.low.x) - p.uv.x, given<F>(c.dry.low.y) - p.uv.y};
  const Vec2<F> high{given<F>(c.dry.high.x) - p.uv.x, given<F>(c.dry.high.y) - p.uv.y};
  const Vec2<F> at =
      to_texel(c, Vec2<F>{min(max(shift.x, low.x), high.x), min(max(shift.y, low.y), high.y)});
  const F depth = depth_at(at);
  const Vec3<F> ray = ray_gain(c, at) - p.ray_length * p.to_viewer;
  const F columns = given<F>(kApart / c.size.x, "slope.columns");
  const F rows = given<F>(kApart / c.size.y, "slope.rows");
  F steps(0);
  Vec2<F> clear{F(0), F(0)};
  const auto tangent = [&](F x, F y, const Vec3<F>& origin_step, const Vec3<F>& ray_step) {
    F least(kMostStep);
    const auto beside = [&](F step_x, F step_y, F& edge, F& nearer) {
      const Vec2<F> side{at.x + step_x, at.y + step_y};
      const F found = min(depth_at(side), F(2) * depth);
      // A difference of inverse depths, which are linear across a plane.
      const F step = min(depth / found, F(1e4)) - F(1);
      const auto shown =
          min(side.x - low.x, high.x - side.x) >= F(-0.25) * columns &&  // half a texel
          min(side.y - low.y, high.y - side.y) >= F(-0.25) * rows;
      nearer = select(shown, step, F(0));
      edge = select(shown, step * step + F(1e-8), F(1e8));
      least = min(least, select(shown, abs(step), F(kMostStep)));
      return found;
    };
    F edge_on(0), edge_back(0), nearer_on(0), nearer_back(0);
    const F on = beside(x, y, edge_on, nearer_on);
    const F back = beside(F(0) - x, F(0) - y, edge_back, nearer_back);
    const F to_on = select(nearer_back - abs(nearer_on) > F(kEdge), F(1), F(0));
    const F to_back = select(nearer_on - abs(nearer_back) > F(kEdge), F(1), F(0));
    clear = clear + (to_on - to_back) * Vec2<F>{x, y};
    steps = steps + F(1 / kApart) * least;
    const F of_all = F(1) / (edge_on + edge_back);
    const F share_on = edge_back * of_all, share_back = edge_on * of_all;
    const F mean = share_on * on + share_back * back;
    const F rise = share_on * (on - depth) - share_back * (back - depth);
    return origin_step + mean * ray_step + rise * ray;
  };
  const Rays& rays = c.rays;
  const Vec3<F> across =
      tangent(columns, F(0), vec3_of<F>(kApart * rays.origin_dx, "slope.origin_across"),
              vec3_of<F>(kApart * rays.ray_dx, "slope.ray_across"));
  const Vec3<F> down = tangent(F(0), rows, vec3_of<F>(kApart * rays.origin_dy, "slope.origin_down"),
                               vec3_of<F>(kApart * rays.ray_dy, "slope.ray_down"));
  const glm::dvec3 away = glm::cross(rays.origin_dx + rays.ray_dx, rays.origin_dy + rays.ray_dy);
  const double facing = glm::dot(away, c.forward) < 0 ? 1 : -1;
  const Vec3<F> normal = given<F>(facing, "slope.facing") * cross(across, down);
  const F squared = dot(normal, normal);
  const auto sane = squared > F(1e-36) && squared < F(1e36);
  return {select(sane, F(1) / sqrt(select(sane, squared, F(1))), F(0)) * normal, depth, steps,
          clear};
}

}  // namespace limpid
