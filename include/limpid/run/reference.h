#pragma once
#include "limpid/core/frame.h"
#include "limpid/core/scene.h"
#include "limpid/plan/plan.h"
#include "limpid/run/target.h"

namespace limpid {

/// The reference runner, which checks all others and is as simple as possible: it computes in
/// `double`, one row of the picture after another, one operator after another, by functions of
/// std:: without approximations, on one thread. Dry pixels are copied bit for bit. Throws Error for
/// an invalid frame or scene (Frame::validate(), Scene::validate()), for a plan that does not fit
/// them, and for a target that does not cover the frame.
void run_reference(const Plan& plan, const Frame& frame, const Scene& scene, const Target& target);

}  // namespace limpid
