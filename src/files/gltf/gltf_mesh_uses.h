#pragma once
#include <cstddef>
#include <vector>

#include "files/text/json_place.h"

namespace limpid {

/// What the nodes of a document say of their meshes: skins, weights, instances.
class GltfMeshUses {
 public:
  explicit GltfMeshUses(const JsonPlace& root);

  /// Throws Error for indices that do not hold, for weights that are not one a morph target, and
  /// for instances whose attributes are not of their types or differ in count.
  void check(const JsonPlace& node) const;

 private:
  void check_instancing(const JsonPlace& instancing) const;

  std::vector<JsonPlace> accessors_;
  std::size_t skins_;
  std::vector<std::size_t> targets_;  // of each mesh
};

}  // namespace limpid
