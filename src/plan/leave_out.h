#pragma once
#include <string>
#include <vector>

#include "limpid/plan/plan.h"

namespace limpid {

/// The plan of make_plan() if nothing reads what these operators make: shows what they change.
/// Operators that only they need are left out as well. Throws Error for an unknown operator, too.
Plan make_plan_without(const std::vector<std::string>& left_out, const Look& look,
                       const Inputs& inputs, StateSet outputs = {}, double max_error = 0);

}  // namespace limpid
