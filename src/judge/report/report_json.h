#pragma once
#include <string>

#include "judge/report/report.h"

namespace limpid {

/// All rows of a report as JSON, and the page's other data except the bytes of its pictures: units
/// are part of the keys, infinite and absent numbers are null (for `error`, `rmse` and `rel_mse`
/// null is infinite). `schema_version` rises if a key changes its meaning or is removed.
std::string to_json(const Report& report);

}  // namespace limpid
