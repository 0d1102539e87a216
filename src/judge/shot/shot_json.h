#pragma once
#include <string>

#include "judge/shot/shot.h"

namespace limpid {

/// All results of a shot, as JSON: units are part of the keys, infinite and absent numbers are null
/// (for `error` null is infinite). `schema_version` rises if a key changes its meaning or is
/// removed.
std::string to_json(const Shot& shot);

}  // namespace limpid
