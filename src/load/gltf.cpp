#include "limpid/load/gltf.h"

#include <algorithm>
#include <optional>

#include "limpid/core/error.h"

#include "load/gltf_check.h"
#include "load/gltf_files.h"
#include "load/gltf_material.h"
#include "load/gltf_mesh.h"
#include "load/gltf_model.h"
#include "load/gltf_parse.h"
#include "load/gltf_scene.h"
#include "load/gltf_texture.h"
#include "load/model_warnings.h"

namespace limpid {
namespace {

namespace fs = std::filesystem;

Rgb<double> background_of(const JsonPlace& root, Rgb<double> otherwise) {
  const std::vector<JsonPlace> scenes = root.list("scenes");
  if (scenes.empty()) return otherwise;
  const auto chosen = root.find("scene");
  const auto extras = scenes[chosen ? chosen->index(scenes.size()) : 0].extras();
  if (!extras) return otherwise;
  const std::vector<double> color = extras->at("background").color();
  return {color[0], color[1], color[2]};
}

ModelTexture read_texture(const JsonPlace& place, const tinygltf::Image& image,
                          const fs::path& folder, Limits limits, MemoryBudget& budget) {
  limits.max_memory = budget.left;
  const bool embedded = !image.image.empty();
  const std::string bytes = embedded ? std::string(image.image.begin(), image.image.end())
                                     : read_file_in(folder, relative_path_of(place.at("uri")),
                                                    std::min<std::int64_t>(budget.left, INT32_MAX));
  const std::string name = embedded ? place.path() : place.path() + " " + place.at("uri").text();
  ModelTexture texture = decode_texture(bytes, name, limits);
  budget.take(static_cast<std::int64_t>(texture.rgba.size() * sizeof(float)), name);
  return texture;
}

}  // namespace

Model gltf_model(const GltfFile& file, const fs::path& folder, const Limits& limits) {
  const JsonPlace root(file.json);
  std::optional<std::int64_t> binary_bytes;
  if (file.binary) binary_bytes = static_cast<std::int64_t>(file.binary->size());
  check_gltf(root, binary_bytes, limits);
  ModelWarnings warnings;
  if (root.count("animations") > 0) warnings.add("animations are not played, nodes stay in place");
  const GltfMaterials looks = read_gltf_materials(root, warnings);

  MemoryBudget budget{limits.max_memory};
  budget.take(file.memory, "its JSON");
  for (const JsonPlace& buffer : root.list("buffers")) {
    // There are two of each while they are handed over.
    budget.take(2 * buffer.at("byteLength").integer(1, INT32_MAX), buffer.path());
  }
  const tinygltf::Model gltf = parse_gltf(file, folder, limits);
  Model model;
  for (const GltfMaterial& material : looks.materials) {
    model.materials.push_back(material.material);
  }
  const std::vector<JsonPlace> images = root.list("images");
  for (const int image : looks.images) {
    model.textures.push_back(
        read_texture(images[image], gltf.images[image], folder, limits, budget));
  }
  read_gltf_scene(gltf, looks.materials, budget, model);
  model.background = background_of(root, model.background);
  model.warnings = warnings.lines();
  return model;
}

Model load_gltf(const fs::path& path, const Limits& limits) {
  try {
    return gltf_model(read_gltf_file(path, limits), fs::absolute(path).parent_path(), limits);
  } catch (const Error& error) {
    throw Error(path.string() + ": " + error.what(), error.fault());
  }
}

}  // namespace limpid
