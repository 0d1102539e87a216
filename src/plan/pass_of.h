#pragma once
#include "limpid/plan/plan.h"

#include "op/pass.h"

namespace limpid {

/// The waves that raise the water, from the plan's look or the scene, if the surface is one of
/// Plan::completed. Refers to the plan.
Swell swell_of(const Plan& plan);

/// The pass with which a plan runs over a frame. Throws Error as Pass does. Plan, scene and frame
/// must live as long.
Pass pass_of(const Plan& plan, const Scene& scene, const Frame& frame);

}  // namespace limpid
