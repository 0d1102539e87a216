#pragma once
#include <string>
#include <vector>

#include "limpid/files/gltf/gltf.h"
#include "limpid/raster/model.h"

#include "files/gltf/gltf_uvs.h"
#include "files/gltf/model_warnings.h"
#include "files/text/json_place.h"

namespace limpid {

/// A material and the data needed to draw with it.
struct GltfMaterial {
  Material material;
  std::vector<UvSource> uvs;  ///< sources of Mesh::uvs and Mesh::second_uvs
  std::vector<int> textures;  ///< indices in GltfMaterials::images
  std::string fault;          ///< why it cannot be drawn, "" if it can
};

struct GltfMaterials {
  std::vector<GltfMaterial> materials;  ///< one per material of the file, and glTF's default one
  std::vector<int> images;              ///< image of each texture in use, without repetition
};

/// Reads and checks the materials, textures and samplers. Throws Error as load_gltf() says; with
/// Undrawable::kLeaveOut an error of a single material becomes its fault.
GltfMaterials read_gltf_materials(const JsonPlace& root, Undrawable undrawable,
                                  ModelWarnings& warnings);

}  // namespace limpid
