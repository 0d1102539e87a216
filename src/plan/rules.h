#pragma once
#include "limpid/plan/plan.h"

namespace limpid {

class CellRules;
struct CellState;
using CellRule = void (CellRules::*)(CellState&) const;

/// A rule of the planner. A rule for plans is applied once, before any pixel is read; a rule for
/// cells, to each cell of a frame.
struct Rule {
  std::string_view name, about;
  void (*plan)(Plan&, const Inputs&) = nullptr;
  CellRule cell = nullptr;
};

/// All rules, in the order in which they are applied.
std::span<const Rule> all_rules();

std::string_view name_of(CellRule rule);

/// Applies the rules for plans.
void apply_rules(Plan& plan, const Inputs& inputs);

}  // namespace limpid
