#include "shade/look_ahead.h"

#include <algorithm>
#include <cstddef>
#include <unordered_map>

namespace limpid {
namespace {

/// Limit on the numbers that the lookups of a step hold in registers.
constexpr int kMostNumbers = 4;

const Node& at(const Recording& r, int id) { return r.nodes[static_cast<std::size_t>(id)]; }

/// Numbers that a lookup gives, or 0 for other nodes.
int numbers_of(const Node& node) {
  if (node.op < NodeOp::kNearest || node.op == NodeOp::kQuad || node.op == NodeOp::kPlace) return 0;
  constexpr int kNumbers[] = {1, 1, 2, 3, 4};
  return kNumbers[static_cast<int>(node.type)];
}

/// Whether a node is known before the loop's block begins.
bool is_before(const Recording& r, int id, const Flow& loop) {
  const bool carried = std::any_of(loop.merges.begin(), loop.merges.end(),
                                   [&](const Flow::Merge& m) { return m.merged == id; });
  return !carried && (at(r, id).block != loop.block || at(r, id).op <= NodeOp::kGiven);
}

}  // namespace

LookAhead::LookAhead(const Recording& r, const Flow& loop,
                     const std::function<bool(int)>& is_ready) {
  if (loop.end - loop.begin < kSteps) return;
  std::unordered_map<int, bool> known{{loop.index, true}};  // and whether the index changes it
  int numbers = 0;
  for (const Statement& s : r.blocks[static_cast<std::size_t>(loop.block)].statements) {
    if (s.kind != Statement::Kind::kNode || !r.live[static_cast<std::size_t>(s.what)]) continue;
    const Node& node = at(r, s.what);
    bool changes = false, is_known = true;
    for (const int arg : node.args) {
      if (arg < 0) continue;
      const auto found = known.find(arg);
      is_known = is_known && (found != known.end() || is_before(r, arg, loop));
      changes = changes || (found != known.end() && found->second);
    }
    const int size = numbers_of(node);
    if (!is_known || (size == 0 && node.op >= NodeOp::kOwn && node.op < NodeOp::kQuad)) continue;
    if (size == 0) {
      known[s.what] = changes;
      if (!is_ready(s.what)) places.push_back(s.what);
    } else if (changes && numbers + size <= kMostNumbers) {
      lookups.push_back(s.what);
      numbers += size;
    }
  }
  std::vector<bool> needed(r.nodes.size());
  const auto need = [&](int id) {
    for (const int arg : at(r, id).args) {
      if (arg >= 0) needed[static_cast<std::size_t>(arg)] = true;
    }
  };
  for (const int id : lookups) need(id);
  for (std::size_t i = places.size(); i-- > 0;) {
    if (needed[static_cast<std::size_t>(places[i])]) need(places[i]);
  }
  std::erase_if(places, [&](int id) { return !needed[static_cast<std::size_t>(id)]; });
}

}  // namespace limpid
