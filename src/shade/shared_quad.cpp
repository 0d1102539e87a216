#include "shade/shared_quad.h"

#include <cstddef>

namespace limpid {
namespace {

/// The mask of a number that is 0 there, and `otherwise` elsewhere; -1 for other numbers.
int mask_of_zero(const Recording& r, int number, int otherwise) {
  const Node& select = r.nodes[static_cast<std::size_t>(number)];
  if (select.op != NodeOp::kSelect || select.args[2] != otherwise) return -1;
  const Node& zero = r.nodes[static_cast<std::size_t>(select.args[1])];
  return zero.op == NodeOp::kLiteral && zero.number == 0 ? select.args[0] : -1;
}

}  // namespace

std::vector<SharedQuad> shared_quads(const Recording& r) {
  std::vector<SharedQuad> found;
  for (std::size_t i = 0; i < r.nodes.size(); ++i) {
    const Node& read = r.nodes[i];
    if (read.op != NodeOp::kRead || !r.live[i]) continue;
    const Node& quad = r.nodes[static_cast<std::size_t>(read.args[0])];
    if (quad.op != NodeOp::kQuad || quad.block != read.block) continue;
    for (std::size_t k = 0; k < i; ++k) {
      const Node& nearest = r.nodes[k];
      if (nearest.op != NodeOp::kNearest || !r.live[k] || nearest.what != read.what ||
          nearest.block != read.block) {
        continue;
      }
      const int refused = mask_of_zero(r, quad.args[0], nearest.args[0]);
      if (refused < 0 || refused != mask_of_zero(r, quad.args[1], nearest.args[1])) continue;
      found.push_back({static_cast<int>(k), read.args[0], static_cast<int>(i), refused});
      break;
    }
  }
  return found;
}

}  // namespace limpid
