#pragma once
#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

#include "files/text/json_place.h"

namespace limpid {

/// A node of a checked document, by itself.
struct GltfNode {
  std::string label;  ///< "nodes[2] 'rock'", for sentences
  glm::dmat4 parent_from_node{1.0};
  std::vector<int> children;
  int mesh = -1, skin = -1, camera = -1, light = -1;
  std::vector<double> weights;          ///< of its mesh's morph targets; empty: as the mesh says
  std::optional<JsonPlace> instancing;  ///< EXT_mesh_gpu_instancing
  bool water = false;
  bool visible = true;  ///< KHR_node_visibility
};

/// The nodes; one with a fault has a label and children alone.
std::vector<GltfNode> read_gltf_nodes(const JsonPlace& root,
                                      const std::vector<std::string>& faults);

/// Where each node stands; nothing for those that have a fault or are below such a one.
std::vector<std::optional<glm::dmat4>> world_from_nodes(const std::vector<GltfNode>& nodes,
                                                        const std::vector<std::string>& faults);

/// "meshes[2] 'rock'".
std::string gltf_label(const JsonPlace& thing);

bool is_finite(const glm::dmat4& matrix);

}  // namespace limpid
