#pragma once
#include "limpid/core/frame.h"
#include "limpid/plan/plan.h"
#include "limpid/run/target.h"

namespace limpid {

/// What every runner checks before its first pixel, so that its loops need not: Frame::validate,
/// the planes that the plan reads are there, the target covers the pixels. Throws Error.
void check_run(const Plan& plan, const Frame& frame, const Scene& scene, const Target& target);

/// What an absent plane reads as: Role::missing of its role.
float missing_value(PlaneId plane);

}  // namespace limpid
