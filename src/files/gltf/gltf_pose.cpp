#include "files/gltf/gltf_pose.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "limpid/core/error.h"

namespace limpid {
namespace {

// The joints and weights of each vertex: up to four per set.
class Influences {
 public:
  Influences(const JsonPlace& primitive, std::size_t vertices, std::size_t joints,
             const GltfAccessors& accessors, MemoryBudget& budget, const std::string& label)
      : joints_(joints), label_(label) {
    const JsonPlace attributes = primitive.at("attributes");
    for (int set = 0;; ++set) {
      const auto bound = attributes.find("JOINTS_" + std::to_string(set));
      const auto share = attributes.find("WEIGHTS_" + std::to_string(set));
      if (!bound || !share) break;
      budget.take(vertices, 4 * sizeof(float), label + " joints");
      sets_.push_back(
          {accessors.of(bound->index(INT32_MAX)), accessors.of(share->index(INT32_MAX))});
    }
    if (sets_.empty()) {
      throw Error(label + ": expected JOINTS_0 and WEIGHTS_0, because a node gives it a skin");
    }
  }

  // Calls use(joint, weight) for nonzero weights, and returns the sum of the weights.
  template <class Use>
  double each(std::size_t vertex, Use use) const {
    double sum = 0;
    for (const Set& set : sets_) {
      for (int i = 0; i < 4; ++i) {
        const double weight = set.weights.number(vertex, i);
        if (weight == 0) continue;
        if (!(weight > 0) || std::isinf(weight)) {
          refuse(vertex, "weight " + std::to_string(weight) + ", expected a number from 0 up");
        }
        use(joint_at(set, vertex, i), weight);
        sum += weight;
      }
    }
    return sum;
  }

  std::uint32_t first(std::size_t vertex) const { return joint_at(sets_.front(), vertex, 0); }

 private:
  struct Set {
    GltfElements joints, weights;
  };

  std::uint32_t joint_at(const Set& set, std::size_t vertex, int i) const {
    const std::uint32_t joint = set.joints.integer(vertex, i);
    if (joint >= joints_) {
      refuse(vertex,
             "joint " + std::to_string(joint) + ", expected one below " + std::to_string(joints_));
    }
    return joint;
  }

  [[noreturn]] void refuse(std::size_t vertex, const std::string& phrase) const {
    throw Error(label_ + " vertex " + std::to_string(vertex) + ": " + phrase);
  }

  std::size_t joints_;
  const std::string& label_;
  std::vector<Set> sets_;
};

// Normals transform by the inverse transpose, or by the cofactors if there is no inverse.
glm::dvec3 turned(const glm::dmat3& linear, double determinant, glm::dvec3 normal) {
  const glm::dmat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                             glm::cross(linear[0], linear[1]));
  return (determinant < 0 ? -1.0 : 1.0) * (cofactors * normal);
}

void add_target(const GltfElements& deltas, double weight, std::vector<glm::vec3>& vectors) {
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    vectors[i] += static_cast<float>(weight) * deltas.vector(i);
  }
}

}  // namespace

void apply_morph_targets(const JsonPlace& primitive, const std::vector<double>& weights,
                         const GltfAccessors& accessors, MemoryBudget& budget,
                         ModelWarnings& warnings, const std::string& label, Mesh& mesh) {
  if (std::all_of(weights.begin(), weights.end(), [](double weight) { return weight == 0; })) {
    return;
  }
  const std::vector<JsonPlace> targets = primitive.list("targets");
  for (glm::vec3& normal : mesh.normals) {
    if (normal != glm::vec3(0)) normal = glm::vec3(glm::normalize(glm::dvec3(normal)));
  }
  for (std::size_t i = 0; i < std::min(targets.size(), weights.size()); ++i) {
    if (weights[i] == 0) continue;
    const auto add = [&](const char* name, std::vector<glm::vec3>& vectors) {
      const auto use = targets[i].find(name);
      if (!use || vectors.empty()) return;
      // Targets may share an accessor: each use counts against the limit.
      budget.take(vectors.size(), sizeof(glm::vec3), label + " morph target");
      add_target(accessors.of(use->index(INT32_MAX)), weights[i], vectors);
    };
    add("POSITION", mesh.positions);
    add("NORMAL", mesh.normals);
    for (const std::string& name : targets[i].keys()) {
      const bool known = name == "POSITION" || name == "NORMAL" || name == "TANGENT";
      if (!known) warnings.add("morph targets of " + name + " are not drawn", label);
    }
  }
}

std::vector<bool> apply_skin(const JsonPlace& primitive, const std::vector<glm::dmat4>& joints,
                             const GltfAccessors& accessors, MemoryBudget& budget,
                             const std::string& label, Mesh& mesh) {
  const Influences influences(primitive, mesh.positions.size(), joints.size(), accessors, budget,
                              label);
  std::vector<bool> mirrored(mesh.positions.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    glm::dmat4 matrix(0.0);
    const double sum = influences.each(
        i, [&](std::uint32_t joint, double weight) { matrix += weight * joints[joint]; });
    if (sum > 0) {
      matrix /= sum;
    } else {
      matrix = joints[influences.first(i)];
    }
    mesh.positions[i] = glm::vec3(matrix * glm::dvec4(mesh.positions[i], 1));
    const glm::dmat3 linear(matrix);
    const double determinant = glm::determinant(linear);
    mirrored[i] = determinant < 0;
    if (!mesh.normals.empty()) {
      const glm::dvec3 normal = turned(linear, determinant, mesh.normals[i]);
      const double length = glm::length(normal);
      mesh.normals[i] = length > 0 ? glm::vec3(normal / length) : glm::vec3(0);
    }
  }
  return mirrored;
}

}  // namespace limpid
