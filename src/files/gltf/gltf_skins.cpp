#include "files/gltf/gltf_skins.h"

#include "limpid/core/error.h"

#include "files/gltf/gltf_nodes.h"

namespace limpid {

const std::vector<glm::dmat4>& GltfSkins::joints(int skin) {
  if (!faults_.at(skin).empty()) throw Error(faults_[skin]);
  if (read_[skin].empty()) read_[skin] = read(skins_[skin]);
  return read_[skin];
}

std::vector<glm::dmat4> GltfSkins::read(const JsonPlace& skin) const {
  const std::vector<JsonPlace> joints = skin.at("joints").items();
  const auto matrices = skin.find("inverseBindMatrices");
  std::optional<GltfElements> bind;
  if (matrices) bind = accessors_.of(matrices->index(INT32_MAX));
  budget_.take(joints.size(), sizeof(glm::dmat4), skin.path());
  std::vector<glm::dmat4> result;
  result.reserve(joints.size());
  for (const JsonPlace& joint : joints) {
    const auto& world = worlds_[joint.index(worlds_.size())];
    if (!world) joint.refuse("a joint with a finite matrix");
    const std::size_t i = result.size();
    const glm::dmat4 matrix = bind ? *world * bind->matrix(i) : *world;
    if (!is_finite(matrix)) {
      throw Error(joint.path() + ": its matrix has a NaN or infinite entry");
    }
    result.push_back(matrix);
  }
  return result;
}

}  // namespace limpid
