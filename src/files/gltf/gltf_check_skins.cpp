#include "files/gltf/gltf_check.h"
#include "files/gltf/gltf_types.h"

namespace limpid {
namespace {

void check_skin(const JsonPlace& skin, const std::vector<JsonPlace>& accessors, std::size_t nodes) {
  const std::vector<JsonPlace> joints = skin.at("joints").items();
  if (joints.empty()) skin.at("joints").refuse("at least one");
  for (const JsonPlace& joint : joints) joint.index(nodes);
  const std::optional<JsonPlace> matrices = skin.find("inverseBindMatrices");
  if (!matrices) return;
  const JsonPlace& accessor = accessors[matrices->index(accessors.size())];
  if (accessor.at("type").text() != "MAT4" ||
      accessor.at("componentType").integer(0, INT32_MAX) != kGltfFloat) {
    matrices->refuse("an accessor of MAT4 float");
  }
  const JsonPlace count = accessor.at("count");
  if (count.integer(1, INT32_MAX) < std::ssize(joints)) {
    count.refuse("at least " + std::to_string(joints.size()) + ", one a joint");
  }
}

}  // namespace

void check_gltf_skins(const JsonPlace& root, Undrawable undrawable, GltfFaults& faults) {
  const std::vector<JsonPlace> accessors = root.list("accessors");
  const std::size_t nodes = root.count("nodes");
  faults.skins = faults_of(root.list("skins"), undrawable,
                           [&](const JsonPlace& skin) { check_skin(skin, accessors, nodes); });
}

}  // namespace limpid
