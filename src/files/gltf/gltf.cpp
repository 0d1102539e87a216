#include "limpid/files/gltf/gltf.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "limpid/core/error.h"

#include "files/gltf/gltf_accessors.h"
#include "files/gltf/gltf_buffers.h"
#include "files/gltf/gltf_check.h"
#include "files/gltf/gltf_files.h"
#include "files/gltf/gltf_material.h"
#include "files/gltf/gltf_model.h"
#include "files/gltf/gltf_scene.h"
#include "files/gltf/gltf_texture.h"
#include "files/gltf/model_warnings.h"

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

std::string bytes_of_image(const JsonPlace& place, const GltfBuffers& buffers,
                           const fs::path& folder, const MemoryBudget& budget) {
  const auto uri = place.find("uri");
  if (!uri) return std::string(buffers.view(place.at("bufferView").index(INT32_MAX)));
  if (is_data_uri(uri->text())) return bytes_of_data_uri(*uri);
  return read_file_in(folder, relative_path_of(*uri),
                      std::min<std::int64_t>(budget.left, INT32_MAX));
}

ModelTexture read_texture(const JsonPlace& place, const GltfBuffers& buffers,
                          const fs::path& folder, Limits limits, MemoryBudget& budget) {
  limits.max_memory = budget.left;
  const auto uri = place.find("uri");
  const std::string name =
      uri && !is_data_uri(uri->text()) ? place.path() + " " + uri->text() : place.path();
  ModelTexture texture =
      decode_texture(bytes_of_image(place, buffers, folder, budget), name, limits);
  budget.take(texture.rgba.size(), sizeof(float), name);
  return texture;
}

// A material that needs a faulty texture has the texture's fault.
void blame_materials(const std::vector<std::string>& faults, std::vector<GltfMaterial>& materials) {
  for (GltfMaterial& material : materials) {
    for (const int texture : material.textures) {
      if (!faults[texture].empty()) material.fault = faults[texture];
    }
  }
}

/// Adds the file that a buffer or an image names, if any.
void add_file_of(const JsonPlace& place, const fs::path& folder, std::vector<fs::path>& files) {
  const auto uri = place.find("uri");
  if (uri && !is_data_uri(uri->text())) files.push_back(folder / relative_path_of(*uri));
}

class Reader {
 public:
  Reader(const GltfFile& file, const fs::path& folder, const Limits& limits, Undrawable undrawable)
      : file_(file), root_(file.json), folder_(folder), limits_(limits), undrawable_(undrawable) {}

  Model read() {
    std::optional<std::int64_t> binary_bytes;
    if (file_.binary) binary_bytes = static_cast<std::int64_t>(file_.binary->size());
    const GltfFaults faults = check_gltf(root_, binary_bytes, limits_, undrawable_, warnings_);
    if (root_.count("animations") > 0) {
      warnings_.add("animations are not played, nodes stay in place");
    }
    GltfMaterials looks = read_gltf_materials(root_, undrawable_, warnings_);
    budget_.take(file_.memory, "its JSON");
    const GltfBuffers buffers(file_, folder_, budget_);
    const GltfAccessors accessors(root_, buffers, budget_);
    read_textures(buffers, looks);
    for (const GltfMaterial& look : looks.materials) model_.materials.push_back(look.material);
    read_gltf_scene({root_, faults, accessors, looks.materials}, undrawable_, budget_, warnings_,
                    model_);
    model_.background = background_of(root_, model_.background);
    model_.warnings = warnings_.lines();
    const std::vector<JsonPlace> images = root_.list("images");
    for (const JsonPlace& buffer : root_.list("buffers"))
      add_file_of(buffer, folder_, model_.files);
    for (const int image : looks.images) add_file_of(images[image], folder_, model_.files);
    return std::move(model_);
  }

 private:
  void read_textures(const GltfBuffers& buffers, GltfMaterials& looks) {
    const std::vector<JsonPlace> images = root_.list("images");
    std::vector<std::string> faults(looks.images.size());
    for (std::size_t i = 0; i < looks.images.size(); ++i) {
      ModelTexture& texture = model_.textures.emplace_back();
      try {
        texture = read_texture(images[looks.images[i]], buffers, folder_, limits_, budget_);
      } catch (const OverLimit&) {
        throw;
      } catch (const Error& error) {
        if (undrawable_ == Undrawable::kRefuse) throw;
        texture = {1, 1, {1, 1, 1, 1}};  // not visible
        faults[i] = error.what();
      }
    }
    blame_materials(faults, looks.materials);
  }

  const GltfFile& file_;
  JsonPlace root_;
  const fs::path& folder_;
  const Limits& limits_;
  Undrawable undrawable_;
  MemoryBudget budget_{limits_.max_memory};
  ModelWarnings warnings_;
  Model model_;
};

}  // namespace

Model gltf_model(const GltfFile& file, const fs::path& folder, const Limits& limits,
                 Undrawable undrawable) {
  return Reader(file, folder, limits, undrawable).read();
}

Model load_gltf(const fs::path& path, const Limits& limits, Undrawable undrawable) {
  try {
    Model model = gltf_model(read_gltf_file(path, limits), fs::absolute(path).parent_path(), limits,
                             undrawable);
    model.files.push_back(fs::absolute(path));
    return model;
  } catch (const Error& error) {
    throw Error(path.string() + ": " + error.what(), error.fault());
  }
}

}  // namespace limpid
