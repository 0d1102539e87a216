#pragma once
#include <array>

#include "limpid/plan/plan.h"
#include "limpid/plan/survey.h"

#include "op/operator.h"
#include "op/pass.h"
#include "op/ranges.h"

namespace limpid {

/// What is known of one cell, and what the rules have decided so far.
struct CellState {
  bool wet;              ///< has a wet pixel
  const Ranges& planes;  ///< ranges of the planes
  const InReach& reach;
  SkippedByBound& by_bound;  ///< receives the operators skipped for their bound
  CellNeeds needs = {};
  Ranges ranges = {};  ///< ranges after the operators that run
  double spent = 0;    ///< of Plan::max_error
};

/// The rules for one cell (plan/rules.h has their order), with all that is common to the cells of a
/// frame computed once.
class CellRules {
 public:
  CellRules(const Plan& plan, const Pass& pass);

  /// The needs of a cell after all rules.
  CellNeeds decide(CellState cell) const;

  void copy_dry(CellState& cell) const;
  void skip_rejection(CellState& cell) const;
  void skip_hidden(CellState& cell) const;
  void skip_invisible(CellState& cell) const;
  void skip_unread(CellState& cell) const;

 private:
  using Mask = std::uint16_t;
  static_assert(Chain::kCount <= 16);

  Ranges reckoned(const Ranges& planes, bool endless) const;
  /// Compared with the rest of the budget; an affordable bound is spent.
  bool affords(CellState& cell, int index, double bound) const;
  double bound_of(int index, const CellState& cell) const;
  double displaced(const CellState& cell) const;

  const Plan& plan_;
  const Pass& pass_;
  Mask kept_ = 0;
  // Operators of the plan that may be skipped without changing the outputs besides the picture:
  Mask exact_ = 0;   ///< where its bound is 0
  Mask loose_ = 0;   ///< where its bound is small enough
  int finder_ = -1;  ///< the operator that finds the position in the dry picture, if it is kept
  int hider_ = -1;   ///< the operator that hides the far end of the path, likewise
  std::array<int, Chain::kCount> order_;  ///< most expensive first
};

}  // namespace limpid
