#pragma once
#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/run/target.h"

namespace limpid {

/// Composites the parts of objects that partly cover pixels (Frame::edges) over the water of a run,
/// in the picture and the AOVs that sum to it, and fills Target::uncovered.
void put_edges(const Frame& frame, const Target& target, Executor& executor);

}  // namespace limpid
