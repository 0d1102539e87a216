#pragma once
#include "limpid/core/frame.h"
#include "limpid/core/scene.h"
#include "limpid/ops/look.h"
#include "limpid/run/target.h"

namespace limpid::bench {

/// The look `realistic` on a plate with a normal map as somebody would write it with OpenCV:
/// whole-picture remap, multiply, pow, compare. The rival in the bench table. Positions, rays and
/// temporaries are its own; inputs and outputs are shared without copies. Uses as many threads as
/// cv::setNumThreads allows.
void run_opencv_chain(const Look& look, const Frame& frame, const Scene& scene,
                      const Target& target);

}  // namespace limpid::bench
