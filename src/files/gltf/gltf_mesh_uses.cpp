#include "files/gltf/gltf_mesh_uses.h"

#include "limpid/core/error.h"

#include "files/gltf/gltf_extensions.h"
#include "files/gltf/gltf_types.h"

namespace limpid {
namespace {

// EXT_mesh_gpu_instancing; other attributes are not read.
void check_attribute(const JsonPlace& use, const JsonPlace& accessor, const std::string& name) {
  const bool turns = name == "ROTATION";
  if (!turns && name != "TRANSLATION" && name != "SCALE") return;
  const std::int64_t component = accessor.at("componentType").integer(0, INT32_MAX);
  const bool small = component == kGltfByte || component == kGltfShort;
  const bool fits = component == kGltfFloat || (turns && small && is_normalized(accessor));
  if (!fits || accessor.at("type").text() != (turns ? "VEC4" : "VEC3")) {
    use.refuse(turns ? "an accessor of VEC4 float, or of normalized bytes or shorts"
                     : "an accessor of VEC3 float");
  }
}

// 0 for a mesh with a fault, which no node can use.
std::size_t targets_of(const JsonPlace& mesh) {
  try {
    const std::vector<JsonPlace> primitives = mesh.list("primitives");
    return primitives.empty() ? 0 : primitives.front().count("targets");
  } catch (const Error&) {
    return 0;
  }
}

}  // namespace

GltfMeshUses::GltfMeshUses(const JsonPlace& root)
    : accessors_(root.list("accessors")), skins_(root.count("skins")) {
  for (const JsonPlace& mesh : root.list("meshes")) targets_.push_back(targets_of(mesh));
}

void GltfMeshUses::check(const JsonPlace& node) const {
  const std::optional<JsonPlace> mesh = node.find("mesh");
  const std::size_t targets = mesh ? targets_[mesh->index(targets_.size())] : 0;
  if (const auto skin = node.find("skin")) {
    skin->index(skins_);
    if (!mesh) skin->refuse("a mesh in the node that has a skin");
  }
  if (const auto weights = node.find("weights")) weights->numbers(targets);
  if (const auto instancing = extension_of(node, "EXT_mesh_gpu_instancing")) {
    if (node.find("skin")) instancing->refuse("a node without a skin");
    check_instancing(*instancing);
  }
}

void GltfMeshUses::check_instancing(const JsonPlace& instancing) const {
  const JsonPlace attributes = instancing.at("attributes");
  std::int64_t instances = 0;
  for (const std::string& name : attributes.keys()) {
    const JsonPlace use = attributes.at(name);
    const JsonPlace& accessor = accessors_[use.index(accessors_.size())];
    const JsonPlace count = accessor.at("count");
    if (instances == 0) instances = count.integer(1, INT32_MAX);
    if (count.integer(1, INT32_MAX) != instances) {
      count.refuse(std::to_string(instances) + " as in the other attributes of instances");
    }
    check_attribute(use, accessor, name);
  }
  if (instances == 0) attributes.refuse("at least one");
}

}  // namespace limpid
