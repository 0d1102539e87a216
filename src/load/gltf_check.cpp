#include "load/gltf_check.h"

#include <algorithm>

#include "limpid/core/error.h"

namespace limpid {
namespace {

const std::vector<std::string> kExtensions = {"KHR_lights_punctual", "KHR_materials_unlit",
                                              "KHR_materials_emissive_strength",
                                              "KHR_materials_pbrSpecularGlossiness"};

// "2.0", "2.1" ...: minor versions stay compatible.
void check_version(const JsonPlace& asset) {
  if (!asset.at("version").text().starts_with("2.")) asset.at("version").refuse("glTF \"2.0\"");
  const std::optional<JsonPlace> least = asset.find("minVersion");
  if (least && least->text() != "2.0") least->refuse("\"2.0\" at most");
}

void check_required_extensions(const JsonPlace& root) {
  for (const JsonPlace& name : root.list("extensionsRequired")) {
    if (std::find(kExtensions.begin(), kExtensions.end(), name.text()) != kExtensions.end()) {
      continue;
    }
    name.refuse("a file that does not require more than " + join(kExtensions));
  }
}

}  // namespace

void check_gltf(const JsonPlace& root, std::optional<std::int64_t> binary_bytes,
                const Limits& limits) {
  root.expect_object();
  root.at("asset").expect_object();
  check_version(root.at("asset"));
  check_required_extensions(root);
  check_gltf_buffers(root, binary_bytes, limits);
  check_gltf_meshes(root);
  check_gltf_nodes(root);
}

}  // namespace limpid
