#pragma once
#include <span>

#include "limpid/run/target.h"

namespace limpid {

/// Throws the usage Error for a list that names an AOV twice: its channels would be.
void expect_each_once(std::span<const Aov> list);

}  // namespace limpid
