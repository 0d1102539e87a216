#pragma once
#include "limpid/core/frame.h"
#include "limpid/plan/plan.h"
#include "limpid/run/target.h"

namespace limpid {

/// Checks of every runner before its first pixel, on which its loops rely: Frame::validate, the
/// planes that the plan reads are present, the target covers the pixels. Throws Error.
void check_run(const Plan& plan, const Frame& frame, const Scene& scene, const Target& target);

/// The value of an absent plane: Role::missing of its role.
float missing_value(PlaneId plane);

}  // namespace limpid
