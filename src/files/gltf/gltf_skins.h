#pragma once
#include <optional>
#include <vector>

#include <glm/mat4x4.hpp>

#include "files/gltf/gltf_accessors.h"
#include "files/text/json_place.h"

namespace limpid {

/// The joints of the skins of a checked document, in the pose of the file's nodes.
class GltfSkins {
 public:
  using Worlds = std::vector<std::optional<glm::dmat4>>;

  GltfSkins(const JsonPlace& root, const GltfAccessors& accessors, const Worlds& world_from_node,
            const std::vector<std::string>& faults, MemoryBudget& budget)
      : skins_(root.list("skins")),
        accessors_(accessors),
        worlds_(world_from_node),
        faults_(faults),
        budget_(budget),
        read_(skins_.size()) {}

  /// For each joint the matrix of its vertices: world from mesh. Without inverse bind matrices the
  /// mesh is in the space of its joints. Throws Error for a joint outside of the scene, and for
  /// matrices that are not finite.
  const std::vector<glm::dmat4>& joints(int skin);

 private:
  std::vector<glm::dmat4> read(const JsonPlace& skin) const;

  std::vector<JsonPlace> skins_;
  const GltfAccessors& accessors_;
  const Worlds& worlds_;
  const std::vector<std::string>& faults_;
  MemoryBudget& budget_;
  std::vector<std::vector<glm::dmat4>> read_;
};

}  // namespace limpid
