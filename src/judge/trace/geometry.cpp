#include "judge/trace/geometry.h"

#include <algorithm>
#include <cmath>

#include "judge/trace/bend.h"
#include "optics/fresnel.h"

namespace limpid::trace {
namespace {

/// The end of a path from the surface: on a dry triangle, on the surface again, or nowhere.
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

/// The view through a place of the picture, below the crests of the water: it begins where it
/// crosses the level of the crests. Nothing if it does not.
std::optional<Ray> view_below(const Ray& view, const glm::dvec3& up, double crest) {
  const double sinks = -glm::dot(view.direction, up);
  const double over = glm::dot(view.origin, up) - crest;
  Ray below = view;
  if (sinks > 0) below.from = std::max(view.from, over / sinks);
  if (sinks <= 0 && over > 0) return std::nullopt;
  return below;
}

/// Whether the first surface on the ray is this point.
bool sees(const Solid& solid, const Ray& view, const Triangles::Hit& point) {
  const auto seen = solid.nearest(view);
  if (!seen) return false;
  if (seen->part == point.part && seen->triangle == point.triangle) return true;
  return glm::length(seen->point - point.point) <= 1e-4 * seen->distance + 16 * seen->slack;
}

}  // namespace

Geometry geometry_at(const Tracer& tracer, const Eye& eye, const WaterView& water, double x,
                     double y, bool in_water) {
  const Beam beam = eye.beam_at(x, y, 1);
  Geometry g;
  const double width = water.size.x, height = water.size.y;
  g.uv.fill({x / width, y / height});
  g.visible.fill(true);
  g.visible_below.fill(true);
  const End own = end_of(tracer, beam.ray, !in_water);
  g.wet = in_water || own.wet;
  if (in_water) {
    g.path = own.distance();
    g.normal = water.up;
  }
  if (!own.wet) return g;
  const SurfacePoint& at = *own.wet;
  g.normal = at.normal;
  g.surface_depth = eye.depth_of(beam.ray, at.distance);

  const Medium& medium = tracer.medium();
  for (std::size_t i = 0; i < medium.bands.size(); ++i) {
    const Band& band = medium.bands[i];
    const double rise = glm::dot(beam.ray.direction, at.normal);
    if (in_water && fresnel_exact(rise, 1 / band.ior) >= 1) continue;  // total reflection
    const Ray ray =
        (in_water ? refracted_out(beam, at, band.ior) : refracted_in(beam, at, band.ior)).ray;
    const End end = end_of(tracer, ray, in_water);
    if (!in_water && i == medium.common) g.path = end.distance();
    const auto place = std::isinf(end.distance()) ? eye.place_of_direction(ray.direction)
                                                  : eye.place_of(ray.at(end.distance()));
    const bool framed = place && place->x >= 0 && place->x <= 1 && place->y >= 0 && place->y <= 1;
    bool visible = false, visible_below = false;
    if (framed && end.dry && !end.wet) {
      const Ray view = eye.beam_at(place->x * width, place->y * height, 1).ray;
      visible = visible_below = sees(tracer.solid(), view, *end.dry);
      if (!water.submersible) {
        const std::optional<Ray> below = view_below(view, water.up, tracer.surface().crest());
        visible_below = below && sees(tracer.solid(), *below, *end.dry);
      }
    }
    const double mask[] = {band.mask.r, band.mask.g, band.mask.b};
    for (std::size_t c = 0; c < 3; ++c) {
      if (mask[c] == 0) continue;
      if (place) g.uv[c] = *place;
      g.visible[c] = visible;
      g.visible_below[c] = visible_below;
    }
  }
  return g;
}

}  // namespace limpid::trace
