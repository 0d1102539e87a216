#include "limpid/write/exr_camera.h"

#include <glm/mat4x4.hpp>

namespace limpid {
namespace {

/// Row vectors in row-major order and column vectors in column-major order have the same 16 floats.
std::array<float, 16> floats_of(const glm::dmat4& m) {
  std::array<float, 16> floats;
  for (int i = 0; i < 16; ++i) floats[i] = static_cast<float>(m[i / 4][i % 4]);
  return floats;
}

}  // namespace

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
