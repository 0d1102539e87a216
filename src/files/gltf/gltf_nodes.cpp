#include "files/gltf/gltf_nodes.h"

#include <algorithm>
#include <cmath>

#include <glm/ext/matrix_transform.hpp>
#include <glm/ext/quaternion_double.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "files/gltf/gltf_extensions.h"

namespace limpid {
namespace {

glm::dmat4 parent_from_node(const JsonPlace& node) {
  if (const auto matrix = node.find("matrix")) return glm::make_mat4(matrix->numbers(16).data());
  glm::dmat4 matrix(1.0);
  if (const auto translation = node.find("translation")) {
    matrix = glm::translate(matrix, glm::make_vec3(translation->numbers(3).data()));
  }
  if (const auto rotation = node.find("rotation")) {
    const std::vector<double> q = rotation->numbers(4);
    matrix *= glm::mat4_cast(glm::normalize(glm::dquat(q[3], q[0], q[1], q[2])));
  }
  if (const auto scale = node.find("scale")) {
    matrix = glm::scale(matrix, glm::make_vec3(scale->numbers(3).data()));
  }
  return matrix;
}

int index_or_none(const JsonPlace& object, std::string_view key) {
  const auto index = object.find(key);
  return index ? index->index(INT32_MAX) : -1;
}

void read_node(const JsonPlace& place, GltfNode& node) {
  node.parent_from_node = parent_from_node(place);
  node.mesh = index_or_none(place, "mesh");
  node.skin = index_or_none(place, "skin");
  node.camera = index_or_none(place, "camera");
  if (const auto light = extension_of(place, "KHR_lights_punctual")) {
    node.light = index_or_none(*light, "light");
  }
  if (const auto weights = place.find("weights")) {
    node.weights = weights->numbers(place.count("weights"));
  }
  node.instancing = extension_of(place, "EXT_mesh_gpu_instancing");
  if (const auto extras = place.extras()) node.water = extras->at("water").boolean();
  if (const auto visibility = extension_of(place, "KHR_node_visibility")) {
    const auto visible = visibility->find("visible");
    node.visible = !visible || visible->boolean();
  }
}

}  // namespace

std::vector<GltfNode> read_gltf_nodes(const JsonPlace& root,
                                      const std::vector<std::string>& faults) {
  std::vector<GltfNode> nodes;
  const std::vector<JsonPlace> places = root.list("nodes");
  nodes.reserve(places.size());
  for (const JsonPlace& place : places) {
    GltfNode& node = nodes.emplace_back();
    for (const JsonPlace& child : place.list("children")) {
      node.children.push_back(child.index(places.size()));
    }
    const bool faulty = !faults[nodes.size() - 1].empty();
    node.label = faulty ? place.path() : gltf_label(place);
    if (!faulty) read_node(place, node);
  }
  return nodes;
}

std::vector<std::optional<glm::dmat4>> world_from_nodes(const std::vector<GltfNode>& nodes,
                                                        const std::vector<std::string>& faults) {
  std::vector<bool> child(nodes.size());
  for (const GltfNode& node : nodes) {
    for (const int index : node.children) child[index] = true;
  }
  std::vector<std::optional<glm::dmat4>> worlds(nodes.size());
  std::vector<int> reached;
  const auto reach = [&](int index, const glm::dmat4& world_from_parent) {
    if (!faults[index].empty()) return;
    worlds[index] = world_from_parent * nodes[index].parent_from_node;
    reached.push_back(index);
  };
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!child[i]) reach(static_cast<int>(i), glm::dmat4(1.0));
  }
  while (!reached.empty()) {
    const int parent = reached.back();
    reached.pop_back();
    for (const int index : nodes[parent].children) reach(index, *worlds[parent]);
  }
  return worlds;
}

std::string gltf_label(const JsonPlace& thing) {
  const auto name = thing.find("name");
  return name && !name->text().empty() ? thing.path() + " '" + name->text() + "'" : thing.path();
}

bool is_finite(const glm::dmat4& matrix) {
  const double* entries = glm::value_ptr(matrix);
  return std::all_of(entries, entries + 16, [](double entry) { return std::isfinite(entry); });
}

}  // namespace limpid
