#pragma once
#include "core/water_view.h"
#include "op/pixel.h"

namespace limpid {

/// Footprint: covariance of the places on the calm water that one pixel, or its visible part,
/// covers, along WaterView::map_x and map_y, in scene units squared. A box one pixel wide, so 1/12
/// of a pixel squared in each direction, through the derivatives of the view's rays (Igehy 1999,
/// "Tracing Ray Differentials"). At most 1e12: at the horizon it is unbounded.
template <class F>
LIMPID_INLINE Sym2<F> footprint(const WaterView& c, const Pixel<F>& p) {
  const Vec3<F> up = vec3_of<F>(c.up);
  const Vec3<F> map_x = vec3_of<F>(c.map_x), map_y = vec3_of<F>(c.map_y);
  const F fall = dot(up, p.to_viewer);  // per unit of distance
  const F least = F(1e-6);
  const F steep = select(fall < F(0), min(fall, F(0) - least), max(fall, least));
  const auto moved = [&](const glm::dvec3& origin_step, const glm::dvec3& ray_step) {
    const Vec3<F> step = vec3_of<F>(origin_step) + p.surface_depth * vec3_of<F>(ray_step);
    const Vec3<F> on_plane = step - (dot(up, step) / steep) * p.to_viewer;
    const auto kept = [](F x) { return min(max(x, F(-1e6)), F(1e6)); };
    return Vec2<F>{kept(dot(map_x, on_plane)), kept(dot(map_y, on_plane))};
  };
  const Vec2<F> dx = moved(c.part.origin_dx, c.part.ray_dx);
  const Vec2<F> dy = moved(c.part.origin_dy, c.part.ray_dy);
  const F share(1.0 / 12);
  return {share * (dx.x * dx.x + dy.x * dy.x), share * (dx.x * dx.y + dy.x * dy.y),
          share * (dx.y * dx.y + dy.y * dy.y)};
}

/// Width of the pixel in texels of a tiling map with this many texels per scene unit, along map_x
/// and map_y: the wider side of the footprint as a box, or this share of its longer side. At most
/// 1e7.
template <class F>
LIMPID_INLINE F texels_wide(Sym2<F> footprint, Vec2<double> texels, double share) {
  // Kept in the range whose squares a float can hold.
  const auto kept = [](F x) { return min(max(x, F(-1e12)), F(1e12)); };
  const auto square = [&](double a, double b, int place) {
    return given<F>(12 * a * b, "wave_map.texels_square", place);
  };
  const F xx = kept(square(texels.x, texels.x, 0) * footprint.xx);
  const F xy = kept(square(texels.x, texels.y, 1) * footprint.xy);
  const F yy = kept(square(texels.y, texels.y, 2) * footprint.yy);
  const F middle = F(0.5) * (xx + yy), half = F(0.5) * (xx - yy);
  const F apart = sqrt(half * half + xy * xy);
  const F least = max(middle - apart, F(0)), most = middle + apart;
  return sqrt(max(least, F(share * share) * most));
}

}  // namespace limpid
