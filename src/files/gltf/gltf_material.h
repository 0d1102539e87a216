#pragma once
#include <string>
#include <vector>

#include "limpid/files/gltf/gltf.h"
#include "limpid/raster/model.h"

#include "files/gltf/gltf_uvs.h"
#include "files/gltf/model_warnings.h"
#include "files/text/json_place.h"

namespace limpid {

/// A material and what drawing with it asks for.
struct GltfMaterial {
  Material material;
  std::vector<UvSource> uvs;  ///< what Mesh::uvs and Mesh::second_uvs are read from
  std::vector<int> textures;  ///< all that it uses, by their place in GltfMaterials::images
  std::string fault;          ///< why it cannot be drawn, "" if it can
};

struct GltfMaterials {
  std::vector<GltfMaterial> materials;  ///< one a material of the file, and glTF's default one
  std::vector<int> images;  ///< the image of each texture that the materials use, once each
};

/// Reads and checks the materials, textures and samplers. Throws Error as load_gltf() says; with
/// Undrawable::kLeaveOut what is wrong with a material alone becomes its fault.
GltfMaterials read_gltf_materials(const JsonPlace& root, Undrawable undrawable,
                                  ModelWarnings& warnings);

}  // namespace limpid
