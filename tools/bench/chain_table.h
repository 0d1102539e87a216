#pragma once
#include <string>

#include "chain_bench.h"

namespace limpid::bench {

/// The rows with their times and errors, and below them the result of `simd` beside each goal whose
/// rows exist.
void print_table(const ChainBench& bench, const std::string& label, const Arguments& arguments);

}  // namespace limpid::bench
