#pragma once
#include <string>
#include <vector>

#include "limpid/job/composite.h"
#include "limpid/job/sequence.h"

#include "arguments.h"

/// The jobs of plates, scene, layers and look of a command line.

namespace limpid::tool {

/// Parses --layer. Throws the usage Error unless it is ROLE=LAYER.
LayerOverrides layer_overrides(const std::vector<std::string>& texts);

/// The common part of the jobs of all frames: the only job, if there are no frames.
CompositeJob common_job(const CompositeArguments& arguments, const Sequence& sequence,
                        const CommonArguments& common);

/// That job for one frame: with its scene, its time, and its number in all names.
CompositeJob job_of_frame(CompositeJob job, const CompositeArguments& arguments, int frame);

/// Of --motion-to, before the first frame is made: throws the Error with which a frame would fail
/// whose neighbor is not among the frames. Its turn may come last.
void expect_second_frames(const CompositeArguments& arguments, const Sequence& sequence,
                          const JobOfFrame<CompositeJob>& job_of);

/// Throws the usage Error for a job of several views, which the verb does not support.
void expect_one_view(const CompositeJob& job, const std::string& verb);

}  // namespace limpid::tool
