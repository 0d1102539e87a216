#pragma once
#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/run/target.h"

namespace limpid::bench {

/// What no runner can beat that reads what the look `realistic` reads and writes a picture: streams
/// the frame's nine planes in and three out, past the caches where the machine can store so. The
/// picture means nothing.
void run_memory_floor(const Frame& frame, const Target& target, Executor& executor);

}  // namespace limpid::bench
