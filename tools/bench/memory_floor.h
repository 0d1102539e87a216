#pragma once
#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/run/target.h"

namespace limpid::bench {

/// The floor for every runner that reads the planes of the look `realistic` and writes a picture:
/// streams the frame's nine planes in and three out, past the caches where the machine can store
/// so. The picture means nothing.
void run_memory_floor(const Frame& frame, const Target& target, Executor& executor);

}  // namespace limpid::bench
