#pragma once
#include <span>

#include "limpid/plan/plan.h"
#include "limpid/run/target.h"

#include "op/pass.h"
#include "shade/recording.h"

namespace limpid {

/// Records the plan's operators for one pixel: outputs color.r, color.g, color.b, and the channels
/// of each AOV. `pass` is that of a completed frame. The program depends on the look, on the set of
/// planes and textures and on the number of waves, not on a size, a time or any other number of the
/// frame. Throws Error for an operator that cannot be recorded.
Recording record(const Plan& plan, const Pass& pass, std::span<const Aov> aovs = {});

}  // namespace limpid
