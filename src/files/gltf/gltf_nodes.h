#pragma once
#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

#include "files/text/json_place.h"

namespace limpid {

/// A node of a checked document, without its children.
struct GltfNode {
  std::string label;  ///< "nodes[2] 'rock'", for sentences
  glm::dmat4 parent_from_node{1.0};
  std::vector<int> children;
  int mesh = -1, skin = -1, camera = -1, light = -1;
  std::vector<double> weights;          ///< of its mesh's morph targets; empty: the mesh's own
  std::optional<JsonPlace> instancing;  ///< EXT_mesh_gpu_instancing
  bool water = false;
  bool visible = true;  ///< KHR_node_visibility
};

/// The nodes; a node with a fault has a label and children only.
std::vector<GltfNode> read_gltf_nodes(const JsonPlace& root,
                                      const std::vector<std::string>& faults);

/// The world matrix of each node; nothing for nodes with a fault and nodes below them.
std::vector<std::optional<glm::dmat4>> world_from_nodes(const std::vector<GltfNode>& nodes,
                                                        const std::vector<std::string>& faults);

/// "meshes[2] 'rock'".
std::string gltf_label(const JsonPlace& thing);

bool is_finite(const glm::dmat4& matrix);

}  // namespace limpid
