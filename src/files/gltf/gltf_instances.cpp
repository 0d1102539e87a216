#include "files/gltf/gltf_instances.h"

#include <cmath>
#include <cstdio>
#include <optional>

#include <glm/ext/matrix_transform.hpp>
#include <glm/ext/quaternion_double.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "limpid/core/error.h"

namespace limpid {
namespace {

glm::dmat4 rotation_of(const GltfElements& rotations, std::size_t instance,
                       const std::string& path) {
  const auto q = [&](int i) -> double { return rotations.number(instance, i); };
  const glm::dquat quaternion(q(3), q(0), q(1), q(2));
  const double norm = glm::length(quaternion);
  // Quaternions in bytes have an error of a hundredth.
  if (!(std::abs(norm - 1) < 2e-2)) {
    char value[160];
    std::snprintf(value, sizeof value, " instance %zu: rotation (%g, %g, %g, %g) of norm %g",
                  instance, q(0), q(1), q(2), q(3), norm);
    throw Error(path + value + ", expected a unit quaternion (norm 1)");
  }
  return glm::mat4_cast(quaternion / norm);
}

}  // namespace

std::vector<glm::dmat4> read_gltf_instances(const JsonPlace& instancing,
                                            const GltfAccessors& accessors, MemoryBudget& budget) {
  const JsonPlace attributes = instancing.at("attributes");
  std::size_t count = 0;
  for (const std::string& name : attributes.keys()) {
    count = accessors.count(attributes.at(name).index(INT32_MAX));
  }
  const auto elements = [&](const char* name) {
    std::optional<GltfElements> found;
    if (const auto use = attributes.find(name)) found = accessors.of(use->index(INT32_MAX));
    return found;
  };
  const auto translations = elements("TRANSLATION"), rotations = elements("ROTATION"),
             scales = elements("SCALE");
  budget.take(count, sizeof(glm::dmat4), instancing.path());
  std::vector<glm::dmat4> matrices(count, glm::dmat4(1.0));
  for (std::size_t i = 0; i < count; ++i) {
    glm::dmat4& matrix = matrices[i];
    if (translations) matrix = glm::translate(matrix, glm::dvec3(translations->vector(i)));
    if (rotations) matrix *= rotation_of(*rotations, i, attributes.path());
    if (scales) matrix = glm::scale(matrix, glm::dvec3(scales->vector(i)));
  }
  return matrices;
}

}  // namespace limpid
