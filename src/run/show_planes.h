#pragma once
#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/plan/plan.h"
#include "limpid/run/target.h"

namespace limpid {

/// Writes the AOVs that are planes of the frame (AovInfo::planes), over its work(), for planes that
/// the plan reads or completes.
void show_planes(const Plan& plan, const Frame& frame, const Target& target, Executor& executor);

}  // namespace limpid
