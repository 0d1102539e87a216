#pragma once
#include <array>

#include "limpid/plan/plan.h"
#include "limpid/plan/survey.h"

#include "op/operator.h"
#include "op/pass.h"
#include "op/ranges.h"

namespace limpid {

/// What is seen of one cell, and what the rules have made of it so far.
struct CellState {
  bool wet;              ///< has a wet pixel
  const Ranges& planes;  ///< all that the planes tell
  const InReach& reach;
  Weighed& weighed;  ///< what is skipped for its bound is entered
  CellNeeds needs = {};
  Ranges ranges = {};  ///< what the operators that run make of `planes`
  double spent = 0;    ///< of Plan::max_error
};

/// The rules that look at one cell (plan/rules.h has their order): what is true of all cells of a
/// frame, found once.
class CellRules {
 public:
  CellRules(const Plan& plan, const Pass& pass);

  /// What a cell needs when all rules have looked at it.
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
  /// Compared with what is left of the budget; if it can be borne it is spent.
  bool affords(CellState& cell, int index, double bound) const;
  double bound_of(int index, const CellState& cell) const;
  double displaced(const CellState& cell) const;

  const Plan& plan_;
  const Pass& pass_;
  Mask kept_ = 0;
  // Of those that are kept, which may be skipped without changing what is written besides the
  // picture:
  Mask exact_ = 0;   ///< where its bound is 0
  Mask loose_ = 0;   ///< where its bound is small enough
  int finder_ = -1;  ///< the operator that finds the position in the dry picture, if it is kept
  int hider_ = -1;   ///< the one that hides the end of the way, likewise
  std::array<int, Chain::kCount> order_;  ///< dearest first
};

}  // namespace limpid
