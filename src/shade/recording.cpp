#include "shade/recording.h"

namespace limpid {

PlaneSet Recording::planes() const {
  PlaneSet set;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Node& node = nodes[i];
    const PlaneId plane = static_cast<PlaneId>(node.what);
    switch (node.op) {
      case NodeOp::kBilinear3:
        if (live[i]) set = set | PlaneSet{plane_after(plane, 1), plane_after(plane, 2)};
        [[fallthrough]];
      case NodeOp::kOwn:
      case NodeOp::kBeside:
      case NodeOp::kNearest:
      case NodeOp::kBilinear:
      case NodeOp::kRead:
      case NodeOp::kPlace:
        if (live[i]) set = set | PlaneSet{plane};
        break;
      default:
        break;
    }
  }
  return set;
}

}  // namespace limpid
