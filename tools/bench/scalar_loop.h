#pragma once
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/run/target.h"

#include "realistic_numbers.h"

namespace limpid::bench {

/// What the loop reads. Its map is r g b r g b ..., which it likes best.
struct ScalarJob {
  const RealisticNumbers& numbers;
  const Frame& frame;
  Size map_size;
  std::vector<float> map;
};

/// The look `realistic` as a C++ programmer writes it by hand: one loop over the pixels in float,
/// four taps a lookup, dry pixels copied at once, bands of rows for threads. Compiled as the fused
/// pass is, -O3, and the second time for all that this machine has (-march=native).
void run_scalar_loop(const ScalarJob& job, const Target& target, Executor& executor);
void run_scalar_loop_native(const ScalarJob& job, const Target& target, Executor& executor);

}  // namespace limpid::bench
