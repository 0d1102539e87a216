#pragma once
#include <vector>

#include "limpid/raster/model.h"

#include "load/json_place.h"
#include "load/model_warnings.h"

namespace limpid {

/// A material and what drawing with it asks for.
struct GltfMaterial {
  Material material;
  std::vector<int> uv_sets;  ///< the TEXCOORD_n that Mesh::uvs and Mesh::second_uvs are read from
};

struct GltfMaterials {
  std::vector<GltfMaterial> materials;  ///< one a material of the file, and glTF's default one
  std::vector<int> images;  ///< the image of each texture that the materials use, once each
};

/// Reads and checks the materials, textures and samplers, from the document itself: tinygltf leaves
/// out what is not of the type it expects. Throws Error as load_gltf() says.
GltfMaterials read_gltf_materials(const JsonPlace& root, ModelWarnings& warnings);

}  // namespace limpid
