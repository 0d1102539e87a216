#pragma once
#include <array>
#include <cstdint>

#include "limpid/op/pass.h"
#include "limpid/op/ranges.h"
#include "limpid/plan/plan.h"
#include "limpid/plan/survey.h"

namespace limpid {

/// The rules that look at one cell: what is true of all cells of a frame, found once.
class CellRules {
 public:
  CellRules(const Plan& plan, const Pass& pass);

  /// Of a cell with wet pixels. `planes`: all of Ranges that the planes tell. `no_foreground`: see
  /// CellNeeds::open. What is skipped for its bound is entered in `weighed`.
  CellNeeds decide(const Ranges& planes, bool no_foreground, Weighed& weighed) const;
  /// Of a cell without one.
  CellNeeds dry() const;

 private:
  using Mask = std::uint16_t;
  static_assert(Chain::kCount <= 16);

  /// What the operators that run make of what the planes tell.
  Ranges reckoned(const Ranges& planes, bool endless) const;
  double bound_of(int index, Mask skips, const Ranges& ranges) const;
  double displaced(Mask skips, const Ranges& ranges) const;
  /// The skips and what nothing else reads.
  Mask with_unread(Mask skips) const;

  const Plan& plan_;
  const Pass& pass_;
  Mask kept_ = 0;
  // Of those that are kept, which may be skipped without changing what is written besides the
  // picture:
  Mask exact_ = 0;  ///< where its bound is 0
  Mask loose_ = 0;  ///< where its bound is small enough
  bool may_hide_ = false;
  std::array<int, Chain::kCount> order_;  ///< dearest first
};

}  // namespace limpid
