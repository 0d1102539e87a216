#pragma once
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

#include "limpid/raster/model.h"

#include "files/gltf/gltf_accessors.h"
#include "files/gltf/model_warnings.h"
#include "files/text/json_place.h"

namespace limpid {

/// The deformation of a mesh by a node.
struct GltfPose {
  std::vector<double> weights;                      ///< of the morph targets; missing ones are 0
  const std::vector<glm::dmat4>* joints = nullptr;  ///< of its skin: world from mesh
};

/// Adds the morph targets of a primitive to its positions and normals (glTF 2.0, 3.7.2.2). Normals
/// become unit before. Warns of other attributes in the targets.
void apply_morph_targets(const JsonPlace& primitive, const std::vector<double>& weights,
                         const GltfAccessors& accessors, MemoryBudget& budget,
                         ModelWarnings& warnings, const std::string& label, Mesh& mesh);

/// Transforms positions and normals by the joints (glTF 2.0, 3.7.3.3 "Skinned Mesh Attributes");
/// the weights of a vertex count by their share of the sum, a vertex without weights follows its
/// first joint. Returns for each vertex whether its joints mirror it. Throws Error for joints that
/// the skin lacks, and for weights below 0 or not finite.
std::vector<bool> apply_skin(const JsonPlace& primitive, const std::vector<glm::dmat4>& joints,
                             const GltfAccessors& accessors, MemoryBudget& budget,
                             const std::string& label, Mesh& mesh);

}  // namespace limpid
