#include <cmath>
#include <cstdio>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include "limpid/core/error.h"

#include "files/gltf/gltf_check.h"
#include "files/gltf/gltf_extensions.h"
#include "files/gltf/gltf_mesh_uses.h"

namespace limpid {
namespace {

constexpr std::string_view kCameras[] = {"perspective", "orthographic"};
constexpr std::string_view kLights[] = {"directional", "point", "spot"};

double positive(const JsonPlace& object, std::string_view key) {
  const JsonPlace place = object.at(key);
  if (!(place.number() > 0)) place.refuse("a number above 0");
  return place.number();
}

void check_far(const JsonPlace& lens, double near) {
  const std::optional<JsonPlace> far = lens.find("zfar");
  if (far && !(far->number() > near)) far->refuse("more than znear");
}

void check_camera(const JsonPlace& camera) {
  if (camera.at("type").choice(kCameras) == 0) {
    const JsonPlace lens = camera.at("perspective");
    if (positive(lens, "yfov") >= std::numbers::pi) lens.at("yfov").refuse("less than pi");
    if (lens.find("aspectRatio")) positive(lens, "aspectRatio");
    check_far(lens, positive(lens, "znear"));
    return;
  }
  const JsonPlace lens = camera.at("orthographic");
  positive(lens, "xmag");
  positive(lens, "ymag");
  lens.at("zfar");
  if (lens.at("znear").number() < 0) lens.at("znear").refuse("0 or more");
  check_far(lens, lens.at("znear").number());
}

std::size_t check_lights(const JsonPlace& root) {
  const std::optional<JsonPlace> extensions = root.find("extensions");
  const std::optional<JsonPlace> punctual =
      extensions ? extensions->find("KHR_lights_punctual") : std::nullopt;
  if (!punctual) return 0;
  const std::vector<JsonPlace> lights = punctual->at("lights").items();
  for (const JsonPlace& light : lights) {
    light.at("type").choice(kLights);
    if (const std::optional<JsonPlace> color = light.find("color")) color->color();
    const std::optional<JsonPlace> intensity = light.find("intensity");
    if (intensity && intensity->number() < 0) intensity->refuse("0 or more");
  }
  return lights.size();
}

void check_transform(const JsonPlace& node) {
  const std::optional<JsonPlace> matrix = node.find("matrix");
  if (matrix) {
    const std::vector<double> m = matrix->numbers(16);
    if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) {
      matrix->refuse("0, 0, 0, 1 in its last row");
    }
  }
  for (const std::string_view key : {"translation", "rotation", "scale"}) {
    const std::optional<JsonPlace> part = node.find(key);
    if (!part) continue;
    if (matrix) throw Error(part->path() + ": expected either a matrix or its parts");
    const std::vector<double> v = part->numbers(key == "rotation" ? 4 : 3);
    if (key != "rotation") continue;
    const double norm = glm::length(glm::dvec4(v[0], v[1], v[2], v[3]));
    if (std::abs(norm - 1) < 5e-3) continue;
    char value[160];
    std::snprintf(value, sizeof value, " = [%g, %g, %g, %g], of norm %g", v[0], v[1], v[2], v[3],
                  norm);
    throw Error(part->path() + value + ": expected a unit quaternion (norm 1)");
  }
}

void check_extras(const JsonPlace& node) {
  const std::optional<JsonPlace> extras = node.extras();
  if (!extras) return;
  extras->expect_keys({"water"});
  if (extras->at("water").boolean() && !node.find("mesh")) {
    extras->at("water").refuse("a mesh in the node whose surface is water");
  }
}

void check_node(const JsonPlace& root, const JsonPlace& node, std::size_t lights) {
  if (const std::optional<JsonPlace> camera = node.find("camera")) {
    camera->index(root.count("cameras"));
  }
  check_transform(node);
  check_extras(node);
  if (const auto visibility = extension_of(node, "KHR_node_visibility")) {
    if (const auto visible = visibility->find("visible")) visible->boolean();
  }
  if (const auto punctual = extension_of(node, "KHR_lights_punctual")) {
    punctual->at("light").index(lights);
  }
}

// Finds the parent of each node; a node may have only one.
std::vector<int> parents_of(const std::vector<JsonPlace>& nodes) {
  std::vector<int> parents(nodes.size(), -1);
  for (std::size_t parent = 0; parent < nodes.size(); ++parent) {
    for (const JsonPlace& place : nodes[parent].list("children")) {
      const int child = place.index(nodes.size());
      if (parents[child] >= 0) {
        place.refuse("each node to have one parent; it already is a child of nodes[" +
                     std::to_string(parents[child]) + "]");
      }
      parents[child] = static_cast<int>(parent);
    }
  }
  return parents;
}

// With one parent each, a node that no root reaches is in a cycle.
void check_acyclic(const std::vector<JsonPlace>& nodes, const std::vector<int>& parents) {
  std::vector<int> reached;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (parents[i] < 0) reached.push_back(static_cast<int>(i));
  }
  std::vector<bool> seen(nodes.size());
  while (!reached.empty()) {
    const int node = reached.back();
    reached.pop_back();
    seen[node] = true;
    for (const JsonPlace& child : nodes[node].list("children")) {
      reached.push_back(child.index(nodes.size()));
    }
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!seen[i]) throw Error(nodes[i].path() + ": is its own ancestor, expected no cycles");
  }
}

void check_scenes(const JsonPlace& root, const std::vector<int>& parents) {
  if (const std::optional<JsonPlace> scene = root.find("scene")) {
    scene->index(root.count("scenes"));
  }
  for (const JsonPlace& scene : root.list("scenes")) {
    std::vector<bool> listed(parents.size());
    for (const JsonPlace& place : scene.list("nodes")) {
      const int node = place.index(parents.size());
      if (parents[node] >= 0) {
        place.refuse("a root; it is a child of nodes[" + std::to_string(parents[node]) + "]");
      }
      if (listed[node]) place.refuse("each root once");
      listed[node] = true;
    }
    if (const std::optional<JsonPlace> extras = scene.extras()) {
      extras->expect_keys({"background"});
      extras->at("background").color();
    }
  }
}

}  // namespace

void check_gltf_nodes(const JsonPlace& root, Undrawable undrawable, GltfFaults& faults) {
  for (const JsonPlace& camera : root.list("cameras")) check_camera(camera);
  const std::size_t lights = check_lights(root);
  const std::vector<JsonPlace> nodes = root.list("nodes");
  const GltfMeshUses mesh_uses(root);
  faults.nodes = faults_of(nodes, undrawable, [&](const JsonPlace& node) {
    check_node(root, node, lights);
    mesh_uses.check(node);
  });
  const std::vector<int> parents = parents_of(nodes);
  check_acyclic(nodes, parents);
  check_scenes(root, parents);
}

}  // namespace limpid
