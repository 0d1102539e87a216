#include "trace/geometry.h"

#include <cmath>

#include "limpid/optics/fresnel.h"

namespace limpid::trace {
namespace {

/// The end of a way from the surface: on a dry triangle, on the surface once more, or nowhere.
struct End {
  std::optional<Triangles::Hit> dry;
  std::optional<SurfacePoint> wet;

  double distance() const { return wet ? wet->distance : dry ? dry->distance : HUGE_VAL; }
};

End end_of(const Tracer& tracer, const Ray& ray, bool in_air) {
  End end{tracer.solid().nearest(ray), {}};
  Ray before = ray;
  if (end.dry) before.to = end.dry->distance;
  end.wet = tracer.surface().nearest(before, in_air);
  return end;
}

/// Whether the dry camera sees just this.
bool sees(const Tracer& tracer, const Eye& eye, Size size, const glm::dvec2& uv, const End& end) {
  if (!(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1)) return false;
  if (end.wet) return false;
  const auto seen =
      tracer.solid().nearest(eye.beam_at(uv.x * size.width, uv.y * size.height, 1).ray);
  if (!end.dry || !seen) return !end.dry && !seen;
  if (seen->part == end.dry->part && seen->triangle == end.dry->triangle) return true;
  const double off = glm::length(seen->point - end.dry->point);
  return off <= 1e-4 * seen->distance + 16 * seen->slack;
}

}  // namespace

Geometry geometry_at(const Tracer& tracer, const Eye& eye, Size size, double x, double y,
                     bool in_water) {
  const Beam beam = eye.beam_at(x, y, 1);
  Geometry g;
  g.uv.fill({x / size.width, y / size.height});
  g.visible.fill(true);
  const End own = end_of(tracer, beam.ray, !in_water);
  g.wet = in_water || own.wet;
  if (in_water) g.path = own.distance();
  if (!own.wet) return g;
  const SurfacePoint& at = *own.wet;
  g.normal = at.normal;
  g.surface_depth = eye.depth_of(beam.ray, at.distance);

  const Medium& medium = tracer.medium();
  for (std::size_t i = 0; i < medium.bands.size(); ++i) {
    const Band& band = medium.bands[i];
    const double rise = glm::dot(beam.ray.direction, at.normal);
    if (in_water && fresnel_exact(rise, 1 / band.ior) >= 1) continue;  // nothing is refracted
    const Ray ray =
        (in_water ? refracted_out(beam, at, band.ior) : refracted_in(beam, at, band.ior)).ray;
    const End end = end_of(tracer, ray, in_water);
    if (!in_water && i == medium.common) g.path = end.distance();
    const auto place = std::isinf(end.distance()) ? eye.place_of_direction(ray.direction)
                                                  : eye.place_of(ray.at(end.distance()));
    const bool visible = place && sees(tracer, eye, size, *place, end);
    const double mask[] = {band.mask.r, band.mask.g, band.mask.b};
    for (std::size_t c = 0; c < 3; ++c) {
      if (mask[c] == 0) continue;
      if (place) g.uv[c] = *place;
      g.visible[c] = visible;
    }
  }
  return g;
}

}  // namespace limpid::trace
