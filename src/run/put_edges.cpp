#include "run/put_edges.h"

#include <algorithm>

#include "complete/rows.h"
#include "core/edge_cover.h"

namespace limpid {
namespace {

constexpr std::array kTerms{Aov::kTransmitted, Aov::kInScatter, Aov::kReflected, Aov::kHighlight};

void scale(const std::array<View<float>, 3>& views, int x, int y, float share,
           const Rgb<float>& plus) {
  const std::array<float, 3> more{plus.r, plus.g, plus.b};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!views[i]) continue;
    float& value = views[i].at(x, y);
    value = more[i] + share * value;
  }
}

}  // namespace

void put_edges(const Frame& frame, const Target& target, Executor& executor) {
  if (!frame.edges && !target.uncovered) return;
  const Rect work = frame.work();
  each_row(executor, work, [&](int y) {
    if (target.uncovered) {
      for (int x = work.x0; x < work.x1; ++x) target.uncovered.at(x, y) = 1;
    }
    const int row = frame.edges ? y - frame.edges->first_row : -1;
    if (row < 0 || row >= static_cast<int>(frame.edges->rows.size())) return;
    for (const EdgeCover::Pixel& p : frame.edges->rows[static_cast<std::size_t>(row)]) {
      if (p.x < work.x0 || p.x >= work.x1) continue;
      const float open = 1 - p.cover;
      scale(target.color, p.x, y, open, p.color);
      for (const Aov aov : kTerms) {
        const bool holds_dry = aov == Aov::kTransmitted;
        scale(target.of(aov), p.x, y, open, holds_dry ? p.color : Rgb<float>{0, 0, 0});
      }
      if (target.uncovered) target.uncovered.at(p.x, y) = open;
    }
  });
}

}  // namespace limpid
