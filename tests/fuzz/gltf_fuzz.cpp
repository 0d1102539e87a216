#include <string_view>

#include "files/gltf/gltf_model.h"
#include "fuzz/harness.h"

namespace limpid::fuzz {
namespace {

void check(const Model& model) {
  for (const ModelTexture& texture : model.textures) {
    expect(texture.rgba.size() == 4ul * texture.width * texture.height,
           "a texture has four floats a texel");
  }
  for (const Mesh& mesh : model.meshes) {
    expect(mesh.indices.size() % 3 == 0, "a triangle has three corners");
    for (const std::uint32_t index : mesh.indices) {
      expect(index < mesh.positions.size(), "a corner is a vertex");
    }
    const auto fits = [&](std::size_t size) { return size == 0 || size == mesh.positions.size(); };
    expect(fits(mesh.normals.size()) && fits(mesh.uvs.size()) && fits(mesh.second_uvs.size()) &&
               fits(mesh.colors.size()),
           "attributes have one value a vertex");
  }
  for (const Instance& instance : model.instances) {
    expect(instance.mesh < std::ssize(model.meshes), "an instance has a mesh");
  }
}

}  // namespace

void gltf(Bytes bytes) {
  Limits limits;
  limits.max_pixels = 1 << 18;
  limits.max_side = 4096;
  limits.max_memory = 64 << 20;
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  for (const Undrawable undrawable : {Undrawable::kRefuse, Undrawable::kLeaveOut}) {
    accepts([&] { check(gltf_model(split_gltf(text, limits), "/nowhere", limits, undrawable)); });
  }
}

}  // namespace limpid::fuzz
