#pragma once
#include "limpid/core/frame.h"
#include "limpid/run/target.h"

#include "realistic_numbers.h"

namespace limpid::bench {

/// The look `realistic` on a plate with a normal map as a programmer writes it with OpenCV:
/// whole-picture remap, multiply, pow, compare. The rival in the bench table. The chain has its own
/// positions, rays and temporaries; inputs and outputs are shared without copies. Uses as many
/// threads as cv::setNumThreads allows.
void run_opencv_chain(const RealisticNumbers& numbers, const Frame& frame, const Target& target);

}  // namespace limpid::bench
