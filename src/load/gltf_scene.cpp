#include "load/gltf_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <glm/ext/matrix_transform.hpp>
#include <glm/ext/quaternion_double.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

#include "limpid/core/error.h"

namespace limpid {
namespace {

bool finite(const glm::dmat4& m) {
  const double* entries = glm::value_ptr(m);
  return std::all_of(entries, entries + 16, [](double entry) { return std::isfinite(entry); });
}

glm::dmat4 parent_from_node(const tinygltf::Node& node) {
  if (!node.matrix.empty()) return glm::make_mat4(node.matrix.data());
  glm::dmat4 matrix(1.0);
  if (!node.translation.empty()) {
    matrix = glm::translate(matrix, glm::make_vec3(node.translation.data()));
  }
  if (!node.rotation.empty()) {
    const std::vector<double>& q = node.rotation;
    matrix *= glm::mat4_cast(glm::normalize(glm::dquat(q[3], q[0], q[1], q[2])));
  }
  if (!node.scale.empty()) matrix = glm::scale(matrix, glm::make_vec3(node.scale.data()));
  return matrix;
}

bool is_water(const tinygltf::Node& node) {
  if (!node.extras.Has("limpid")) return false;
  return node.extras.Get("limpid").Get("water").Get<bool>();
}

glm::dmat4 projection_of(const tinygltf::Camera& camera) {
  if (camera.type == "orthographic") {
    const tinygltf::OrthographicCamera& lens = camera.orthographic;
    return orthographic(2 * lens.xmag, 2 * lens.ymag, lens.znear, lens.zfar, ClipSpace::kGl);
  }
  const tinygltf::PerspectiveCamera& lens = camera.perspective;
  const double far = lens.zfar > 0 ? lens.zfar : std::numeric_limits<double>::infinity();
  const double aspect = lens.aspectRatio > 0 ? lens.aspectRatio : 1;
  return perspective(lens.yfov, aspect, lens.znear, far, ClipSpace::kGl);
}

Camera camera_of(const tinygltf::Camera& source, glm::dmat4 world) {
  for (int c = 0; c < 3; ++c) world[c] = glm::normalize(world[c]);
  if (glm::determinant(glm::dmat3(world)) < 0) {
    throw Error("its camera is mirrored, expected a rotation and a translation");
  }
  const Camera camera{glm::inverse(world), projection_of(source), ClipSpace::kGl};
  camera.validate();
  return camera;
}

// The mesh seen in a mirror that swaps x and -x: its front stays its front.
Mesh mirrored(Mesh mesh) {
  for (glm::vec3& position : mesh.positions) position.x = -position.x;
  for (glm::vec3& normal : mesh.normals) normal.x = -normal.x;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
  }
  return mesh;
}

class SceneReader {
 public:
  SceneReader(const tinygltf::Model& gltf, const std::vector<GltfMaterial>& materials,
              MemoryBudget& budget, Model& model)
      : gltf_(gltf),
        materials_(materials),
        budget_(budget),
        model_(model),
        meshes_(gltf.meshes.size()) {}

  void read() {
    struct Visit {
      int node;
      glm::dmat4 world_from_parent;
    };
    std::vector<Visit> left;  // the next one last
    const auto push = [&](const std::vector<int>& nodes, const glm::dmat4& world) {
      for (std::size_t i = nodes.size(); i-- > 0;) left.push_back({nodes[i], world});
    };
    push(roots(), glm::dmat4(1.0));
    while (!left.empty()) {
      const Visit visit = left.back();
      left.pop_back();
      const tinygltf::Node& node = gltf_.nodes[visit.node];
      const glm::dmat4 world = visit.world_from_parent * parent_from_node(node);
      try {
        add(node, world);
      } catch (const Error& error) {
        throw Error(gltf_label("nodes", visit.node, node.name) + ": " + error.what(),
                    error.fault());
      }
      push(node.children, world);
    }
  }

 private:
  struct ReadMesh {
    bool read = false;
    std::vector<int> parts, mirrored_parts;  // in the model
  };

  std::vector<int> roots() const {
    if (!gltf_.scenes.empty()) return gltf_.scenes[std::max(gltf_.defaultScene, 0)].nodes;
    std::vector<bool> child(gltf_.nodes.size());
    for (const tinygltf::Node& node : gltf_.nodes) {
      for (const int index : node.children) child[index] = true;
    }
    std::vector<int> roots;
    for (std::size_t i = 0; i < child.size(); ++i) {
      if (!child[i]) roots.push_back(static_cast<int>(i));
    }
    return roots;
  }

  void add(const tinygltf::Node& node, const glm::dmat4& world) {
    if (!finite(world)) {
      throw Error("its matrix, with those of its parents, has a NaN or infinite entry");
    }
    const std::optional<int> light = sun_of(node);
    if (node.mesh < 0 && node.camera < 0 && !light) return;
    const glm::dmat3 linear(world);
    const double determinant = glm::determinant(linear);
    if (determinant == 0 || !std::isfinite(determinant)) {
      const bool hidden = linear == glm::dmat3(0.0);
      if (hidden && node.mesh >= 0) model_.skipped_triangles += triangles_of(node.mesh);
      if (hidden) return;
      throw Error("its matrix has the determinant " + std::to_string(determinant) +
                  ", expected one that can be inverted");
    }
    if (node.mesh >= 0) add_mesh(node, world, determinant < 0);
    if (node.camera >= 0 && !model_.camera) {
      model_.camera = camera_of(gltf_.cameras[node.camera], world);
    }
    if (light && !model_.sun) add_sun(gltf_.lights[*light], world);
  }

  std::optional<int> sun_of(const tinygltf::Node& node) const {
    const auto punctual = node.extensions.find("KHR_lights_punctual");
    if (punctual == node.extensions.end()) return std::nullopt;
    const int light = punctual->second.Get("light").GetNumberAsInt();
    if (gltf_.lights[light].type != "directional") return std::nullopt;
    return light;
  }

  // A light shines down the -Z of its node: the sun stands on its +Z.
  void add_sun(const tinygltf::Light& light, const glm::dmat4& world) {
    const Rgb<double> color = light.color.empty()
                                  ? Rgb<double>{1, 1, 1}
                                  : Rgb<double>{light.color[0], light.color[1], light.color[2]};
    model_.sun = Sun{glm::normalize(glm::dvec3(world[2])), light.intensity * color};
  }

  std::int64_t triangles_of(int mesh) {
    std::int64_t corners = 0;
    for (const tinygltf::Primitive& primitive : gltf_.meshes[mesh].primitives) {
      const int counted =
          primitive.indices >= 0 ? primitive.indices : primitive.attributes.at("POSITION");
      corners += static_cast<std::int64_t>(gltf_.accessors[counted].count);
    }
    return corners / 3;
  }

  void add_mesh(const tinygltf::Node& node, const glm::dmat4& world, bool mirrors) {
    const bool water = is_water(node);
    ReadMesh& mesh = meshes_[node.mesh];
    if (!mesh.read) {
      GltfMesh parts = read_gltf_mesh(gltf_, node.mesh, materials_, budget_);
      model_.skipped_triangles += parts.skipped_triangles;
      for (Mesh& part : parts.parts) mesh.parts.push_back(put(std::move(part)));
      mesh.read = true;
    }
    if (mirrors && mesh.mirrored_parts.empty()) {
      for (const int part : mesh.parts) {
        const Mesh& original = model_.meshes[part];
        budget_.take(static_cast<std::int64_t>(original.positions.size() *
                                                   (2 * sizeof(glm::vec3) + sizeof(glm::vec2)) +
                                               original.second_uvs.size() * sizeof(glm::vec2) +
                                               original.colors.size() * sizeof(glm::vec4) +
                                               original.indices.size() * sizeof(std::uint32_t)),
                     "the mirrored mesh '" + original.name + "'");
        mesh.mirrored_parts.push_back(put(mirrored(original)));
      }
    }
    const glm::dmat4 matrix = mirrors ? glm::scale(world, glm::dvec3(-1, 1, 1)) : world;
    for (const int part : mirrors ? mesh.mirrored_parts : mesh.parts) {
      model_.instances.push_back({part, matrix, water});
    }
  }

  int put(Mesh mesh) {
    model_.meshes.push_back(std::move(mesh));
    return static_cast<int>(model_.meshes.size()) - 1;
  }

  const tinygltf::Model& gltf_;
  const std::vector<GltfMaterial>& materials_;
  MemoryBudget& budget_;
  Model& model_;
  std::vector<ReadMesh> meshes_;
};

}  // namespace

void read_gltf_scene(const tinygltf::Model& gltf, const std::vector<GltfMaterial>& materials,
                     MemoryBudget& budget, Model& model) {
  SceneReader(gltf, materials, budget, model).read();
}

}  // namespace limpid
