#pragma once
#include "limpid/op/pass.h"
#include "limpid/plan/plan.h"

namespace limpid {

/// The pass with which a plan runs over a frame. Throws Error as Pass does. Plan, scene and frame
/// must live as long.
inline Pass pass_of(const Plan& plan, const Scene& scene, const Frame& frame) {
  return {scene, frame, plan.look.water.ior, plan.made, plan.swell()};
}

}  // namespace limpid
