#pragma once
#include "limpid/plan/plan.h"

#include "plan/operator_table.h"

namespace limpid {

/// Expected cost of an operator of a plan, in ns per pixel of a cell in which it runs: on one
/// thread with AVX-512 at about 4 GHz, its share of the fused pass. The planner tries expensive
/// operators first, and `limpid plan` shows the cost; it has no other use. 0 for an operator that
/// is left out.
inline double predicted_ns(const Plan& plan, int chain_index) {
  if (!plan.keeps(chain_index)) return 0;
  const OperatorEntry& entry = operator_table()[static_cast<std::size_t>(chain_index)];
  return entry.ns(plan.look, {plan.made, plan.planes, plan.completed});
}

/// The rest of the pass: loading, rays and storing for a wet pixel, copying a dry one.
constexpr double kPredictedWetNs = 2.0, kPredictedDryNs = 0.8;

}  // namespace limpid
