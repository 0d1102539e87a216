#pragma once
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/run/target.h"

#include "realistic_numbers.h"

namespace limpid::bench {

/// The inputs of the loop. The map is interleaved, r g b r g b ..., because the loop is fastest so.
struct ScalarJob {
  const RealisticNumbers& numbers;
  const Frame& frame;
  Size map_size;
  std::vector<float> map;
};

/// The look `realistic` as a C++ programmer writes it by hand: one loop over the pixels in float,
/// four taps per lookup, an early copy of dry pixels, bands of rows for threads. Compiled with -O3
/// like the fused pass, and a second time for this machine (-march=native).
void run_scalar_loop(const ScalarJob& job, const Target& target, Executor& executor);
void run_scalar_loop_native(const ScalarJob& job, const Target& target, Executor& executor);

}  // namespace limpid::bench
