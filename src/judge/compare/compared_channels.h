#pragma once
#include <span>

#include "judge/compare/compare.h"

namespace limpid {

/// Throws Error for no channel, no pixels, and windows that differ.
void check_compared(std::span<const ComparedChannel> channels);

}  // namespace limpid
