#include "plan/cell_rules.h"

#include <algorithm>
#include <numeric>

#include "plan/predict.h"
#include "plan/rules.h"

namespace limpid {
namespace {

constexpr StateSet kLight = kOutputTerms | StateSet{StatePart::kDryBottom, StatePart::kSunScatter};

const OperatorEntry& entry_of(int index) {
  return operator_table()[static_cast<std::size_t>(index)];
}

/// The state that changes when an operator is left out: the state it makes, and state that later
/// operators make from it. Light changes only light.
StateSet changed_by(const Plan& plan, int index) {
  StateSet changed = entry_of(index).makes;
  for (int i = index + 1; i < Chain::kCount; ++i) {
    const OperatorEntry& later = entry_of(i);
    if (!plan.keeps(i)) continue;
    if ((changed - kLight).meets(later.uses)) {
      changed = changed | later.makes;
    } else if (changed.meets(later.uses)) {
      changed = changed | (later.makes & kLight);
    }
  }
  return changed;
}

constexpr bool has(std::uint16_t mask, int index) {
  return index >= 0 && ((mask >> index) & 1u) != 0;
}
constexpr std::uint16_t bit(int index) { return static_cast<std::uint16_t>(1u << index); }

}  // namespace

CellRules::CellRules(const Plan& plan, const Pass& pass) : plan_(plan), pass_(pass) {
  std::array<double, Chain::kCount> cost;
  for (int i = 0; i < Chain::kCount; ++i) {
    cost[static_cast<std::size_t>(i)] = predicted_ns(plan, i);
    if (!plan.keeps(i)) continue;
    const OperatorEntry& entry = entry_of(i);
    kept_ = kept_ | bit(i);
    if (kOutputTerms.covers(entry.makes)) exact_ = exact_ | bit(i);
    if (!(changed_by(plan, i) - kOutputTerms).meets(plan.outputs)) loose_ = loose_ | bit(i);
    if (entry.makes.has(StatePart::kPosition)) finder_ = i;
    if (entry.hides) hider_ = i;
  }
  std::iota(order_.begin(), order_.end(), 0);
  std::sort(order_.begin(), order_.end(), [&](int a, int b) {
    const double of_a = cost[static_cast<std::size_t>(a)], of_b = cost[static_cast<std::size_t>(b)];
    return of_a > of_b || (of_a == of_b && a < b);
  });
}

CellNeeds CellRules::decide(CellState cell) const {
  cell.ranges = cell.wet ? reckoned(cell.planes, false) : Ranges{};
  for (const Rule& rule : all_rules()) {
    if (rule.cell) (this->*rule.cell)(cell);
  }
  if (has(cell.needs.skips, finder_)) cell.needs.open = false;
  cell.needs.bound = static_cast<float>(cell.spent * (1 + 1e-6));
  return cell.needs;
}

void CellRules::copy_dry(CellState& cell) const {
  if (cell.wet) return;
  cell.needs.dry = true;
  cell.needs.skips = kept_;
}

void CellRules::skip_rejection(CellState& cell) const {
  if (cell.needs.dry) return;
  for (int i = 0; i < Chain::kCount; ++i) {
    if (!has(kept_, i) || !entry_of(i).rejects) continue;
    cell.needs.open = entry_of(i).foreground_free(plan_.look, cell.reach);
    if (!cell.needs.open) return;
  }
}

void CellRules::skip_hidden(CellState& cell) const {
  if (cell.needs.dry || hider_ < 0 || !has(loose_, finder_)) return;
  const double beyond = entry_of(hider_).beyond(plan_.look, pass_, cell.ranges);
  if (!affords(cell, finder_, beyond + displaced(cell))) return;
  cell.needs.opaque = true;
  cell.needs.skips = cell.needs.skips | bit(finder_);
  cell.ranges = reckoned(cell.planes, true);
}

void CellRules::skip_invisible(CellState& cell) const {
  if (cell.needs.dry) return;
  for (const int i : order_) {
    if (!has(exact_ | loose_, i) || has(cell.needs.skips, i)) continue;
    const double bound = bound_of(i, cell);
    if ((bound > 0 && !has(loose_, i)) || !affords(cell, i, bound)) continue;
    cell.needs.skips = cell.needs.skips | bit(i);
    if (i == hider_) cell.ranges.transmittance = 1;
  }
}

/// Backwards from the outputs, like skip_unread_operator() for a whole plan.
void CellRules::skip_unread(CellState& cell) const {
  if (cell.needs.dry) return;
  StateSet live = kOutputTerms | plan_.outputs;
  for (int i = Chain::kCount - 1; i >= 0; --i) {
    if (!has(kept_, i) || has(cell.needs.skips, i)) continue;
    if (entry_of(i).makes.meets(live)) {
      live = live | entry_of(i).uses;
    } else {
      cell.needs.skips = cell.needs.skips | bit(i);
    }
  }
}

/// The ranges after the operators that run, from the ranges of the planes.
Ranges CellRules::reckoned(const Ranges& planes, bool endless) const {
  Ranges ranges = planes;
  ranges.hit = ranges.own;
  ranges.path = {0, 0};
  ranges.light = ranges.brightest();
  for (int i = 0; i < Chain::kCount; ++i) {
    if (!has(kept_, i)) continue;
    if (i == hider_ && endless) ranges.hit = ranges.path = {HUGE_VAL, HUGE_VAL};
    entry_of(i).propagate_ranges(plan_.look, pass_, ranges);
  }
  return ranges;
}

/// Compared with a little less than the budget, because sums round.
bool CellRules::affords(CellState& cell, int index, double bound) const {
  if (!(cell.spent + bound <= plan_.max_error * (1 - 1e-6))) return false;
  float& most = cell.by_bound.bounds[static_cast<std::size_t>(index)];
  most = std::max(most, static_cast<float>(bound));
  cell.by_bound.operators = cell.by_bound.operators | bit(index);
  cell.spent += bound;
  return true;
}

/// How much the other operators that run change the picture when the finder's position changes.
double CellRules::displaced(const CellState& cell) const {
  double sum = 0;
  for (int i = 0; i < Chain::kCount; ++i) {
    if (i == finder_ || !has(kept_, i) || has(cell.needs.skips, i)) continue;
    sum += entry_of(i).displaced(plan_.look, cell.ranges);
  }
  return sum;
}

double CellRules::bound_of(int index, const CellState& cell) const {
  const double bound = entry_of(index).bound(plan_.look, pass_, cell.ranges);
  return index == finder_ ? bound + displaced(cell) : bound;
}

}  // namespace limpid
