#pragma once
#include "limpid/core/frame.h"
#include "limpid/core/scene.h"
#include "limpid/plan/plan.h"
#include "limpid/run/target.h"

namespace limpid {

/// The obviously correct runner, which checks all others: `double` throughout, a row of the picture
/// at a time, one operator after the other, std:: functions, no approximation, one thread. Dry
/// pixels are copied bit for bit. Throws Error when frame, scene or target do not fit
/// (Frame::validate, Scene::validate).
void run_reference(const Plan& plan, const Frame& frame, const Scene& scene, const Target& target);

}  // namespace limpid
