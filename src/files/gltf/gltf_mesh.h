#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "limpid/raster/model.h"

#include "files/gltf/gltf_accessors.h"
#include "files/gltf/gltf_material.h"
#include "files/gltf/gltf_pose.h"
#include "files/gltf/memory_budget.h"
#include "files/gltf/model_warnings.h"
#include "files/text/json_place.h"

namespace limpid {

/// Upper bound on the memory of a vertex.
constexpr std::size_t kBytesAVertex =
    2 * sizeof(glm::vec3) + 2 * sizeof(glm::vec2) + sizeof(glm::vec4);

struct GltfMesh {
  std::vector<Mesh> parts;  ///< one per primitive with triangles
  std::int64_t skipped_triangles = 0;
};

/// The meshes of a checked document.
class GltfMeshes {
 public:
  GltfMeshes(const JsonPlace& root, const GltfAccessors& accessors,
             const std::vector<GltfMaterial>& materials, const std::vector<std::string>& faults,
             MemoryBudget& budget, ModelWarnings& warnings)
      : meshes_(root.list("meshes")),
        accessors_(accessors),
        materials_(materials),
        faults_(faults),
        budget_(budget),
        warnings_(warnings) {}

  std::size_t count() const { return meshes_.size(); }
  /// Number of triangles, including those without area.
  std::int64_t triangles(int mesh) const;
  /// Weights of the mesh itself; empty if it has none.
  std::vector<double> weights(int mesh) const;

  /// Reads a mesh in the pose of a node. Throws Error for vertices that are not finite, indices
  /// beyond the vertices, textures without uvs, and for the faults that check_gltf() or
  /// read_gltf_materials() found. Normals become unit; a zero normal becomes that of the triangles
  /// around its vertex.
  GltfMesh read(int mesh, const GltfPose& pose) const;

 private:
  const JsonPlace& mesh_of(int mesh) const;
  bool is_drawn(const JsonPlace& primitive, const std::string& label) const;
  std::size_t corners_of(const JsonPlace& primitive) const;
  Mesh read_vertices(const JsonPlace& primitive, const std::string& label) const;
  void read_uvs(const JsonPlace& attributes, const std::string& label, Mesh& mesh) const;
  Mesh read_part(const JsonPlace& primitive, const std::string& label, const GltfPose& pose,
                 std::int64_t& skipped) const;

  std::vector<JsonPlace> meshes_;
  const GltfAccessors& accessors_;
  const std::vector<GltfMaterial>& materials_;
  const std::vector<std::string>& faults_;
  MemoryBudget& budget_;
  ModelWarnings& warnings_;
};

}  // namespace limpid
