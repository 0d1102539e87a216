#include "limpid/files/exr/exr_camera.h"

#include <cmath>

#include <glm/gtc/type_ptr.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include "limpid/core/error.h"

namespace limpid {
namespace {

// Row vectors in row-major order and column vectors in column-major order have the same 16 floats.

glm::dmat4 matrix_of(const std::array<float, 16>& m) {
  return glm::dmat4(glm::make_mat4(m.data()));
}

std::array<float, 16> floats_of(const glm::dmat4& m) {
  std::array<float, 16> floats;
  for (int i = 0; i < 16; ++i) floats[i] = static_cast<float>(m[i / 4][i % 4]);
  return floats;
}

}  // namespace

std::optional<Camera> camera_of(const ExrFile& file, int part) {
  const auto to_camera = file.matrix_attribute(part, "worldToCamera");
  const auto to_ndc = file.matrix_attribute(part, "worldToNDC");
  if (!to_camera || !to_ndc) return std::nullopt;

  Camera camera;
  glm::dmat4 flip_z(1.0);
  flip_z[2][2] = -1;
  camera.view = flip_z * matrix_of(*to_camera);
  glm::dmat4 ndc_from_unit(1.0);  // x: 0 ... 1 to -1 ... 1; y likewise, flipped
  ndc_from_unit[0][0] = 2;
  ndc_from_unit[3][0] = -1;
  ndc_from_unit[1][1] = -2;
  ndc_from_unit[3][1] = 1;
  glm::dmat4 p = ndc_from_unit * matrix_of(*to_ndc) * glm::inverse(camera.view);

  // Homogeneous matrices have any scale, and the z row is not given: make w = -z (or 1) and GL's z.
  const bool flat = std::abs(p[2][3]) < 1e-6 * std::abs(p[3][3]);
  const double scale = flat ? 1 / p[3][3] : -1 / p[2][3];
  if (!std::isfinite(scale)) {
    throw Error(file.path().string() + ": worldToNDC has no perspective or orthographic w row");
  }
  p = p * scale;
  const glm::dvec3 w(p[0][3], p[1][3], flat ? p[2][3] : p[3][3]);
  if (std::abs(w.x) > 1e-3 || std::abs(w.y) > 1e-3 || std::abs(w.z) > 1e-2) {
    throw Error(file.path().string() +
                ": worldToCamera and worldToNDC do not belong to one camera");
  }
  const glm::dmat4 depth = flat ? orthographic(1, 1, 0.001, 1e9, ClipSpace::kGl)
                                : perspective(1, 1, 0.001, HUGE_VAL, ClipSpace::kGl);
  for (int c = 0; c < 4; ++c) {
    p[c][2] = depth[c][2];
    p[c][3] = depth[c][3];
  }
  camera.projection = p;
  camera.validate();
  return camera;
}

std::map<std::string, std::array<float, 16>> camera_attributes(const Camera& camera) {
  glm::dmat4 flip_z(1.0);  // the standard's camera looks along +z, left-handed
  flip_z[2][2] = -1;
  glm::dmat4 unit_from_ndc(1.0);  // -1 ... 1 with y up to 0 ... 1 with y down
  unit_from_ndc[0][0] = 0.5;
  unit_from_ndc[3][0] = 0.5;
  unit_from_ndc[1][1] = -0.5;
  unit_from_ndc[3][1] = 0.5;
  return {{"worldToCamera", floats_of(flip_z * camera.view)},
          {"worldToNDC", floats_of(unit_from_ndc * camera.projection * camera.view)}};
}

}  // namespace limpid
