#pragma once
#include <string>
#include <vector>

#include "limpid/plan/plan.h"

namespace limpid {

/// A phrase for each operator that only one of the plans has, or that has different models.
std::vector<std::string> differences(const Plan& plan, const Plan& judge);

}  // namespace limpid
