#pragma once
#include <cstddef>
#include <vector>

#include "files/text/json_place.h"

namespace limpid {

/// The uses of meshes by the nodes of a document: skins, weights, instances.
class GltfMeshUses {
 public:
  explicit GltfMeshUses(const JsonPlace& root);

  /// Throws Error for invalid indices, for weights whose number differs from the morph targets, and
  /// for instances whose attributes have wrong types or different counts.
  void check(const JsonPlace& node) const;

 private:
  void check_instancing(const JsonPlace& instancing) const;

  std::vector<JsonPlace> accessors_;
  std::size_t skins_;
  std::vector<std::size_t> targets_;  // of each mesh
};

}  // namespace limpid
