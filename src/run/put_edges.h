#pragma once
#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/run/target.h"

namespace limpid {

/// Puts what covers pixels in part (Frame::edges) before the water that a run has drawn, in the
/// picture and the AOVs that sum to it, and fills Target::uncovered.
void put_edges(const Frame& frame, const Target& target, Executor& executor);

}  // namespace limpid
