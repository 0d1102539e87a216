#include "raster/mirror.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "limpid/core/error.h"

namespace limpid {
namespace {

glm::dvec4 row(const glm::dmat4& m, int r) { return {m[0][r], m[1][r], m[2][r], m[3][r]}; }

/// At a smaller distance the plane counts as passing through the eye.
constexpr double kNearest = 1e-9;

double height_over(const WaterPlane& plane, const Camera& camera) {
  return glm::dot(plane.up, camera.eye()) - plane.height;
}

double sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

}  // namespace

glm::dmat4 mirror(const WaterPlane& plane) {
  const glm::dvec3& n = plane.up;
  glm::dmat4 m(1.0);
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) m[c][r] -= 2 * n[c] * n[r];
  }
  m[3] = glm::dvec4(2 * plane.height * n, 1);
  return m;
}

bool sees_mirror(const Camera& camera, const WaterPlane& plane) {
  return std::abs(height_over(plane, camera)) >= kNearest;
}

Camera mirrored_camera(const Camera& camera, const WaterPlane& plane) {
  const double above = height_over(plane, camera);
  if (!sees_mirror(camera, plane)) throw Error("camera: its eye lies in the water plane");
  Camera mirrored = camera;
  mirrored.view = camera.view * mirror(plane);
  // A plane transforms by the inverse transpose; the side opposite to the mirrored eye is kept.
  const glm::dvec4 world(plane.up, -plane.height);
  const glm::dvec4 kept = above > 0 ? world : -world;
  const glm::dvec4 in_camera = glm::transpose(glm::inverse(mirrored.view)) * kept;
  mirrored.projection = oblique_near_plane(camera.projection, camera.clip, in_camera);
  return mirrored;
}

glm::dmat4 oblique_near_plane(const glm::dmat4& projection, ClipSpace clip,
                              const glm::dvec4& plane) {
  const bool reversed = clip == ClipSpace::kReversed;
  // The corner of the frustum opposite to the plane, on the far plane of clip space.
  const glm::dvec4 corner =
      glm::inverse(projection) * glm::dvec4(sign(plane.x), sign(plane.y), reversed ? 0 : 1, 1);
  const glm::dvec4 w = row(projection, 3);
  const glm::dvec4 scaled = glm::dot(w, corner) / glm::dot(plane, corner) * plane;
  const glm::dvec4 z = clip == ClipSpace::kGl ? 2.0 * scaled - w : reversed ? w - scaled : scaled;
  glm::dmat4 oblique = projection;
  for (int c = 0; c < 4; ++c) oblique[c][2] = z[c];
  return oblique;
}

}  // namespace limpid
