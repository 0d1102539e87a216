#pragma once
#include <functional>
#include <span>

#include "limpid/core/executor.h"
#include "limpid/job/sequence.h"

namespace limpid {

/// A step of a frame, with its place among the frames in flight, 0 ... frames_in_flight() - 1.
using FrameStep = std::function<void(int place, int frame)>;

/// Number of frames of the sequence that are in flight at once.
int frames_in_flight(const Sequence& sequence);

/// Runs all frames of a sequence that check() has passed through the steps, 2 ... 5 of them, as
/// Executor::pipeline() does. Throws the Error, which names the frame, of the first frame (in the
/// order of the sequence) that fails; later frames that have begun may stop between two steps.
void run_steps(const Sequence& sequence, std::span<const FrameStep> steps, Executor& executor);

}  // namespace limpid
