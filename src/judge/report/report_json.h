#pragma once
#include <string>

#include "judge/report/report.h"

namespace limpid {

/// All rows of a report as JSON, and what else the page shows but for the bytes of its pictures:
/// names of units are part of the keys, infinite and absent numbers are null (of `error`, `rmse`
/// and `rel_mse` null is infinite). `schema_version` rises when a key changes its meaning or goes.
std::string to_json(const Report& report);

}  // namespace limpid
