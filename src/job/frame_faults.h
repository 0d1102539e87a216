#pragma once
#include <functional>
#include <string>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/job/sequence.h"

/// @file
/// What is wrong with a sequence, before a frame of it is made.

namespace limpid {

/// A frame that could not be made, and why not.
struct FrameFault {
  int frame;
  std::string sentence;
};

/// Every frame's scene, headers of its files, look, plan and places of outputs are looked at, as
/// its job would begin; of the first frame also the contents of its inputs, textures among them. No
/// pixel is decoded, nothing is written. What the pixels hold can be wrong all the same. Throws
/// Error as the sequences do: for outputs that are not apart.
std::vector<FrameFault> faults_of_composite(const Sequence& sequence,
                                            const JobOfFrame<CompositeJob>& job_of,
                                            Executor& executor);
std::vector<FrameFault> faults_of_water(const Model& model, const Sequence& sequence,
                                        const JobOfFrame<WaterJob>& job_of, Executor& executor);

/// The same of any job. `check_of` is asked as JobOfFrame is; what it gives may be called on any
/// thread, and throws Error for what is wrong.
std::vector<FrameFault> faults_of_frames(
    const Sequence& sequence, const std::function<std::function<void()>(int frame)>& check_of,
    Executor& executor);

}  // namespace limpid
