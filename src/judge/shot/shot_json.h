#pragma once
#include <string>

#include "judge/shot/shot.h"

namespace limpid {

/// All that was measured of a shot, as JSON: names of units are part of the keys, infinite and
/// absent numbers are null (of `error` null is infinite). `schema_version` rises when a key changes
/// its meaning or goes.
std::string to_json(const Shot& shot);

}  // namespace limpid
