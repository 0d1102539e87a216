#include "files/gltf/gltf_check.h"

#include "limpid/core/error.h"

#include "files/gltf/gltf_extensions.h"

namespace limpid {
namespace {

// "2.0", "2.1" ...: minor versions stay compatible.
void check_version(const JsonPlace& asset) {
  if (!asset.at("version").text().starts_with("2.")) asset.at("version").refuse("glTF \"2.0\"");
  const std::optional<JsonPlace> least = asset.find("minVersion");
  if (least && least->text() != "2.0") least->refuse("\"2.0\" at most");
}

}  // namespace

GltfFaults check_gltf(const JsonPlace& root, std::optional<std::int64_t> binary_bytes,
                      const Limits& limits, Undrawable undrawable, ModelWarnings& warnings) {
  root.expect_object();
  root.at("asset").expect_object();
  check_version(root.at("asset"));
  check_extensions(root, undrawable, warnings);
  check_gltf_buffers(root, binary_bytes, limits);
  GltfFaults faults;
  check_gltf_meshes(root, undrawable, faults);
  check_gltf_skins(root, undrawable, faults);
  check_gltf_nodes(root, undrawable, faults);
  return faults;
}

}  // namespace limpid
