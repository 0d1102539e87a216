#pragma once
#include <functional>
#include <string>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/job/sequence.h"

/// @file
/// Errors of a sequence, found before a frame is made.

namespace limpid {

/// A frame that cannot be made, and the reason.
struct FrameFault {
  int frame;
  std::string sentence;
};

/// Checks every frame's scene, file headers, look, plan and output paths, as its job would at its
/// start; for the first frame also the contents of its inputs, textures included. No pixel is
/// decoded, nothing is written: errors in pixels are not found. Throws Error as the sequences do:
/// for outputs that share a path.
std::vector<FrameFault> faults_of_composite(const Sequence& sequence,
                                            const JobOfFrame<CompositeJob>& job_of,
                                            Executor& executor);
std::vector<FrameFault> faults_of_water(const Model& model, const Sequence& sequence,
                                        const JobOfFrame<WaterJob>& job_of, Executor& executor);

/// The same for any kind of job. `check_of` is called like JobOfFrame; the function that it returns
/// may be called on any thread, and throws Error if the frame is wrong.
std::vector<FrameFault> faults_of_frames(
    const Sequence& sequence, const std::function<std::function<void()>(int frame)>& check_of,
    Executor& executor);

}  // namespace limpid
