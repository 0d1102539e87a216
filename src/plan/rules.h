#pragma once
#include "limpid/plan/plan.h"

namespace limpid {

class CellRules;
struct CellState;
using CellRule = void (CellRules::*)(CellState&) const;

/// A rule of the planner. One of a plan is applied once, before any pixel is read, one of cells to
/// each cell of a frame.
struct Rule {
  std::string_view name, about;
  void (*plan)(Plan&, const Inputs&) = nullptr;
  CellRule cell = nullptr;
};

/// In the order in which they are applied.
std::span<const Rule> all_rules();

std::string_view name_of(CellRule rule);

/// Those of a plan.
void apply_rules(Plan& plan, const Inputs& inputs);

}  // namespace limpid
