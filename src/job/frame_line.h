#pragma once
#include <functional>
#include <span>

#include "limpid/core/executor.h"
#include "limpid/job/sequence.h"

namespace limpid {

/// A step of a frame, in its place among those in flight, 0 ... frames_in_flight() - 1.
using FrameStep = std::function<void(int place, int frame)>;

/// How many frames of the sequence are in flight at once.
int frames_in_flight(const Sequence& sequence);

/// Takes all frames of a sequence that check() has passed through the steps, 2 ... 5 of them, as
/// Executor::pipeline() does. Throws the
/// Error, which names the frame, for the first one (in the order of the sequence) that fails; those
/// after it that have begun may be left between two steps.
void run_steps(const Sequence& sequence, std::span<const FrameStep> steps, Executor& executor);

}  // namespace limpid
