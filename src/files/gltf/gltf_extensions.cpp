#include "files/gltf/gltf_extensions.h"

#include <algorithm>
#include <set>
#include <vector>

#include "limpid/core/error.h"

namespace limpid {
namespace {

const std::vector<std::string> kRead = {"EXT_mesh_gpu_instancing",
                                        "KHR_lights_punctual",
                                        "KHR_materials_emissive_strength",
                                        "KHR_materials_pbrSpecularGlossiness",
                                        "KHR_materials_unlit",
                                        "KHR_mesh_quantization",
                                        "KHR_node_visibility",
                                        "KHR_texture_transform"};

struct Packing {
  std::string_view extension, what;
};

constexpr Packing kPackings[] = {{"KHR_draco_mesh_compression", "meshes packed by Draco"},
                                 {"EXT_meshopt_compression", "buffers packed by meshopt"},
                                 {"KHR_meshopt_compression", "buffers packed by meshopt"},
                                 {"KHR_texture_basisu", "textures in KTX2"},
                                 {"EXT_texture_webp", "textures in WebP"},
                                 {"EXT_texture_avif", "textures in AVIF"},
                                 {"MSFT_texture_dds", "textures in DDS"}};

bool is_read(const std::string& name) {
  return std::find(kRead.begin(), kRead.end(), name) != kRead.end();
}

const Packing* packing_named(std::string_view name) {
  const auto* found = std::find_if(std::begin(kPackings), std::end(kPackings),
                                   [&](const Packing& p) { return p.extension == name; });
  return found == std::end(kPackings) ? nullptr : found;
}

void check_required(const JsonPlace& name, Undrawable undrawable, ModelWarnings& warnings) {
  if (is_read(name.text())) return;
  const Packing* packing = packing_named(name.text());
  const std::string why = packing ? std::string(packing->what) + " are not read" : "is not read";
  if (undrawable == Undrawable::kRefuse) {
    throw Error(name.path() + " = \"" + name.text() + "\": " + why +
                ", expected a file that requires no more than " + join(kRead));
  }
  if (!packing) warnings.add("extensions that the file requires are not read", name.text());
}

}  // namespace

void check_extensions(const JsonPlace& root, Undrawable undrawable, ModelWarnings& warnings) {
  std::set<std::string> required;
  for (const JsonPlace& name : root.list("extensionsRequired")) {
    check_required(name, undrawable, warnings);
    required.insert(name.text());
  }
  for (const JsonPlace& used : root.list("extensionsUsed")) {
    const std::string& name = used.text();
    // A material warns of its own extensions.
    const bool told = is_read(name) || packing_named(name) || name.starts_with("KHR_materials_") ||
                      required.contains(name);
    if (!told) warnings.add("extensions are not read", name);
  }
}

bool uses_extension(const JsonPlace& root, std::string_view name) {
  for (const std::string_view list : {"extensionsUsed", "extensionsRequired"}) {
    for (const JsonPlace& used : root.list(list)) {
      if (used.text() == name) return true;
    }
  }
  return false;
}

std::optional<JsonPlace> extension_of(const JsonPlace& object, std::string_view name) {
  const std::optional<JsonPlace> extensions = object.find("extensions");
  return extensions ? extensions->find(name) : std::nullopt;
}

std::optional<std::string> packing_of(const JsonPlace& object) {
  for (const Packing& packing : kPackings) {
    if (extension_of(object, packing.extension)) return std::string(packing.extension);
  }
  return std::nullopt;
}

bool is_packed_buffer(const JsonPlace& buffer) {
  return !buffer.find("uri") && (extension_of(buffer, "EXT_meshopt_compression") ||
                                 extension_of(buffer, "KHR_meshopt_compression"));
}

}  // namespace limpid
