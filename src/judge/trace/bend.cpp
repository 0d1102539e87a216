#include "judge/trace/bend.h"

namespace limpid::trace {
namespace {

/// Least slope of a ray that leaves the surface.
constexpr double kLeastFall = 1e-6;

/// `out`, or its projection to the side of `normal`; unit.
glm::dvec3 on_side_of(const glm::dvec3& normal, const glm::dvec3& out) {
  const double rise = glm::dot(normal, out);
  return rise >= kLeastFall ? out : glm::normalize(out + (kLeastFall - rise) * normal);
}

template <class Turn>
Beam off_surface(const Beam& beam, const SurfacePoint& at, const glm::dvec3& side, Turn&& turn) {
  return turned(beam, at.point, at.face, [&](const glm::dvec3& direction) {
    return on_side_of(side, glm_of(turn(formula_of(-direction))));
  });
}

}  // namespace

Beam refracted_in(const Beam& beam, const SurfacePoint& at, double ior) {
  return off_surface(beam, at, -at.face, [&](const Vec3<double>& to_viewer) {
    return refract(to_viewer, formula_of(at.normal), 1 / ior).direction;
  });
}

Beam refracted_out(const Beam& beam, const SurfacePoint& at, double ior) {
  return off_surface(beam, at, at.face, [&](const Vec3<double>& to_viewer) {
    return refract(to_viewer, formula_of(-at.normal), ior).direction;
  });
}

Beam mirrored_up(const Beam& beam, const SurfacePoint& at) {
  return off_surface(beam, at, at.face, [&](const Vec3<double>& to_viewer) {
    return mirror(to_viewer, formula_of(at.normal));
  });
}

Beam mirrored_down(const Beam& beam, const SurfacePoint& at) {
  return off_surface(beam, at, -at.face, [&](const Vec3<double>& to_viewer) {
    return mirror(to_viewer, formula_of(at.normal));
  });
}

}  // namespace limpid::trace
