#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "limpid/raster/model.h"

#include "load/gltf_material.h"
#include "load/gltf_parser.h"

namespace limpid {

/// The memory that a model may still take.
struct MemoryBudget {
  std::int64_t left;
  void take(std::int64_t bytes, const std::string& what);  ///< throws Error when it is used up
};

/// "meshes[2] 'rock'", for sentences.
std::string gltf_label(const char* list, int index, const std::string& name);

struct GltfMesh {
  std::vector<Mesh> parts;  ///< one a primitive with triangles in it
  std::int64_t skipped_triangles = 0;
};

/// Reads a mesh of a checked document. Throws Error for vertices that are not finite, indices
/// beyond the vertices, and textures without uvs. Normals become unit; a zero one becomes that of
/// the triangles around its vertex.
GltfMesh read_gltf_mesh(const tinygltf::Model& gltf, int mesh,
                        const std::vector<GltfMaterial>& materials, MemoryBudget& budget);

}  // namespace limpid
