#pragma once
#include <string>
#include <vector>

#include "limpid/plan/plan.h"

namespace limpid {

/// The plan that make_plan() makes where nothing reads what these operators make: to see what they
/// change. What only they need falls with them. Throws Error besides for an operator that there is
/// not.
Plan make_plan_without(const std::vector<std::string>& left_out, const Look& look,
                       const Inputs& inputs, StateSet outputs = {}, double max_error = 0);

}  // namespace limpid
