#include "files/gltf/gltf_triangles.h"

namespace limpid {

GltfMode gltf_mode_of(const JsonPlace& primitive) {
  const std::optional<JsonPlace> mode = primitive.find("mode");
  return mode ? static_cast<GltfMode>(mode->integer(0, 6)) : GltfMode::kTriangles;
}

}  // namespace limpid
