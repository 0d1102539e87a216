#include "files/gltf/gltf_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "limpid/core/error.h"

#include "files/gltf/gltf_extensions.h"
#include "files/gltf/gltf_instances.h"
#include "files/gltf/gltf_mesh.h"
#include "files/gltf/gltf_nodes.h"
#include "files/gltf/gltf_skins.h"

namespace limpid {
namespace {

// The mirrored mesh (x and -x swapped) with its front as before.
Mesh mirrored(Mesh mesh) {
  for (glm::vec3& position : mesh.positions) position.x = -position.x;
  for (glm::vec3& normal : mesh.normals) normal.x = -normal.x;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
  }
  return mesh;
}

std::vector<JsonPlace> lights_of(const JsonPlace& root) {
  const auto punctual = extension_of(root, "KHR_lights_punctual");
  return punctual ? punctual->at("lights").items() : std::vector<JsonPlace>{};
}

// A light shines down the -Z of its node: the sun is in the direction +Z.
Sun sun_of(const JsonPlace& light, const glm::dmat4& world) {
  const auto color = light.find("color"), intensity = light.find("intensity");
  const std::vector<double> c = color ? color->color() : std::vector<double>{1, 1, 1};
  return Sun{glm::normalize(glm::dvec3(world[2])),
             (intensity ? intensity->number() : 1.0) * Rgb<double>{c[0], c[1], c[2]}};
}

double number_or(const JsonPlace& object, std::string_view key, double otherwise) {
  const auto number = object.find(key);
  return number ? number->number() : otherwise;
}

glm::dmat4 projection_of(const JsonPlace& camera) {
  if (camera.at("type").text() == "orthographic") {
    const JsonPlace lens = camera.at("orthographic");
    return orthographic(2 * lens.at("xmag").number(), 2 * lens.at("ymag").number(),
                        lens.at("znear").number(), lens.at("zfar").number(), ClipSpace::kGl);
  }
  const JsonPlace lens = camera.at("perspective");
  return perspective(
      lens.at("yfov").number(), number_or(lens, "aspectRatio", 1), lens.at("znear").number(),
      number_or(lens, "zfar", std::numeric_limits<double>::infinity()), ClipSpace::kGl);
}

// Ignores the scale of its node; throws for a sheared matrix.
Camera gltf_camera(const JsonPlace& place, glm::dmat4 world) {
  for (int c = 0; c < 3; ++c) world[c] = glm::normalize(world[c]);
  if (glm::determinant(glm::dmat3(world)) < 0) {
    throw Error("its camera is mirrored, expected a rotation and a translation");
  }
  const Camera camera{glm::inverse(world), projection_of(place), ClipSpace::kGl};
  camera.validate();
  return camera;
}

class SceneReader {
 public:
  SceneReader(const GltfDocument& document, Undrawable undrawable, MemoryBudget& budget,
              ModelWarnings& warnings, Model& model)
      : document_(document),
        undrawable_(undrawable),
        budget_(budget),
        warnings_(warnings),
        model_(model),
        nodes_(read_gltf_nodes(document.root, document.faults.nodes)),
        worlds_(world_from_nodes(nodes_, document.faults.nodes)),
        skins_(document.root, document.accessors, worlds_, document.faults.skins, budget),
        meshes_(document.root, document.accessors, document.materials, document.faults.meshes,
                budget, warnings),
        cameras_(document.root.list("cameras")),
        lights_(lights_of(document.root)),
        shared_(meshes_.count()) {}

  void read() {
    std::vector<int> left;  // the last one is next
    const auto push = [&](const std::vector<int>& nodes) {
      left.insert(left.end(), nodes.rbegin(), nodes.rend());
    };
    push(roots());
    while (!left.empty()) {
      const int index = left.back();
      left.pop_back();
      const GltfNode& node = nodes_[index];
      if (!node.visible) {
        warnings_.add("hidden nodes and their children are not drawn", node.label);
      } else if (add_or_leave_out(index)) {
        push(node.children);
      }
    }
  }

 private:
  struct Parts {
    bool read = false;
    std::vector<int> plain, mirrored;  // indices in the model
    std::int64_t triangles = -1;       // -1 until counted
  };

  std::vector<int> roots() const {
    const std::vector<JsonPlace> scenes = document_.root.list("scenes");
    std::vector<int> roots;
    if (!scenes.empty()) {
      const auto chosen = document_.root.find("scene");
      const JsonPlace& scene = scenes[chosen ? chosen->index(scenes.size()) : 0];
      for (const JsonPlace& root : scene.list("nodes")) roots.push_back(root.index(nodes_.size()));
      return roots;
    }
    std::vector<bool> child(nodes_.size());
    for (const GltfNode& node : nodes_) {
      for (const int index : node.children) child[index] = true;
    }
    for (std::size_t i = 0; i < child.size(); ++i) {
      if (!child[i]) roots.push_back(static_cast<int>(i));
    }
    return roots;
  }

  // Whether the nodes below have a world matrix.
  bool add_or_leave_out(int index) {
    const std::string& fault = document_.faults.nodes[index];
    const std::string& label = nodes_[index].label;
    if (!fault.empty()) {
      warnings_.add(label + " is left out, with all below it: " + fault);
      return false;
    }
    try {
      add(nodes_[index], *worlds_[index]);
    } catch (const OverLimit& error) {
      throw Error(label + ": " + error.what(), error.fault());
    } catch (const Error& error) {
      if (undrawable_ == Undrawable::kRefuse) {
        throw Error(label + ": " + error.what(), error.fault());
      }
      warnings_.add(label + " is left out: " + error.what());
    }
    return true;
  }

  void add(const GltfNode& node, const glm::dmat4& world) {
    if (!is_finite(world)) {
      throw Error("its matrix, with those of its parents, has a NaN or infinite entry");
    }
    if (node.mesh >= 0) add_mesh(node, world);
    if (node.camera < 0 && node.light < 0) return;
    if (!has_inverse(world)) return;
    if (node.camera >= 0 && !model_.camera) {
      model_.camera = gltf_camera(cameras_[node.camera], world);
    }
    if (node.light >= 0) add_light(node, world);
  }

  // A node with a scale of 0 has no inverse and no fault: it is hidden.
  static bool has_inverse(const glm::dmat4& matrix) {
    const glm::dmat3 linear(matrix);
    const double determinant = glm::determinant(linear);
    if (determinant != 0 && std::isfinite(determinant)) return true;
    if (linear == glm::dmat3(0.0)) return false;
    throw Error("its matrix has the determinant " + std::to_string(determinant) +
                ", expected one that can be inverted");
  }

  void add_light(const GltfNode& node, const glm::dmat4& world) {
    const JsonPlace& light = lights_[node.light];
    if (light.at("type").text() == "directional" && !model_.sun) {
      model_.sun = sun_of(light, world);
    } else {
      warnings_.add("lights but the first directional one are not drawn", node.label);
    }
  }

  void add_mesh(const GltfNode& node, const glm::dmat4& world) {
    if (node.skin >= 0) return add_skinned(node);
    std::vector<glm::dmat4> placed = {world};
    if (node.instancing) {
      placed = read_gltf_instances(*node.instancing, document_.accessors, budget_);
      for (glm::dmat4& matrix : placed) matrix = world * matrix;
    }
    Parts own;
    Parts& parts = node.weights.empty() ? shared_[node.mesh] : own;
    for (const glm::dmat4& matrix : placed) {
      if (!is_finite(matrix)) throw Error("an instance has a NaN or infinite entry in its matrix");
      if (has_inverse(matrix)) {
        put_instance(node, parts, matrix);
      } else {
        std::int64_t& triangles = shared_[node.mesh].triangles;
        if (triangles < 0) triangles = meshes_.triangles(node.mesh);
        skip_triangles(triangles);
      }
    }
  }

  // The number of repeated meshes may overflow.
  void skip_triangles(std::int64_t count) {
    constexpr std::int64_t kMost = std::int64_t{1} << 60;
    model_.skipped_triangles = std::min(model_.skipped_triangles + std::min(count, kMost), kMost);
  }

  // Only the joints place it; its own matrix is ignored (glTF 2.0, 3.7.3.2).
  void add_skinned(const GltfNode& node) {
    Parts own;
    read_parts(node, own);
    for (const int part : own.plain) put_instance({part, glm::dmat4(1.0), node.water});
  }

  void put_instance(const GltfNode& node, Parts& parts, const glm::dmat4& world) {
    if (!parts.read) read_parts(node, parts);
    const bool mirrors = glm::determinant(glm::dmat3(world)) < 0;
    if (mirrors && parts.mirrored.empty()) mirror_parts(parts);
    const glm::dmat4 matrix = mirrors ? glm::scale(world, glm::dvec3(-1, 1, 1)) : world;
    for (const int part : mirrors ? parts.mirrored : parts.plain) {
      put_instance({part, matrix, node.water});
    }
  }

  void put_instance(const Instance& instance) {
    budget_.take(1, sizeof(Instance), "its instances");
    model_.instances.push_back(instance);
  }

  void read_parts(const GltfNode& node, Parts& parts) {
    GltfPose pose{node.weights.empty() ? meshes_.weights(node.mesh) : node.weights};
    if (node.skin >= 0) pose.joints = &skins_.joints(node.skin);
    GltfMesh mesh = meshes_.read(node.mesh, pose);
    skip_triangles(mesh.skipped_triangles);
    for (Mesh& part : mesh.parts) parts.plain.push_back(put(std::move(part)));
    parts.read = true;
  }

  void mirror_parts(Parts& parts) {
    for (const int part : parts.plain) {
      const Mesh& original = model_.meshes[part];
      const std::string what = "the mirrored mesh '" + original.name + "'";
      budget_.take(original.positions.size(), kBytesAVertex, what);
      budget_.take(original.indices.size(), sizeof(std::uint32_t), what);
      parts.mirrored.push_back(put(mirrored(original)));
    }
  }

  int put(Mesh mesh) {
    model_.meshes.push_back(std::move(mesh));
    return static_cast<int>(model_.meshes.size()) - 1;
  }

  const GltfDocument& document_;
  Undrawable undrawable_;
  MemoryBudget& budget_;
  ModelWarnings& warnings_;
  Model& model_;
  std::vector<GltfNode> nodes_;
  std::vector<std::optional<glm::dmat4>> worlds_;
  GltfSkins skins_;
  GltfMeshes meshes_;
  std::vector<JsonPlace> cameras_, lights_;
  std::vector<Parts> shared_;  // meshes without a pose, for all nodes that use them
};

}  // namespace

void read_gltf_scene(const GltfDocument& document, Undrawable undrawable, MemoryBudget& budget,
                     ModelWarnings& warnings, Model& model) {
  SceneReader(document, undrawable, budget, warnings, model).read();
}

}  // namespace limpid
