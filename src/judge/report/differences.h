#pragma once
#include <string>
#include <vector>

#include "limpid/plan/plan.h"

namespace limpid {

/// A phrase an operator that one plan has and the other not, or by another model.
std::vector<std::string> differences(const Plan& plan, const Plan& judge);

}  // namespace limpid
