#pragma once
#include <span>

#include "limpid/run/target.h"

namespace limpid {

/// Throws the usage Error if a list names an AOV twice, because its channels would appear twice.
void expect_each_once(std::span<const Aov> list);

}  // namespace limpid
