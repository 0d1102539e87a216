#pragma once
#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/run/target.h"

namespace limpid::bench {

/// The floor for every runner that reads the planes of the look `realistic` and writes a picture:
/// streams the frame's nine planes in and three out, with stores that bypass the caches where the
/// machine has them. The picture has no meaning.
void run_memory_floor(const Frame& frame, const Target& target, Executor& executor);

}  // namespace limpid::bench
