#pragma once
#include <string>
#include <vector>

#include "limpid/job/composite.h"
#include "limpid/job/sequence.h"

#include "arguments.h"

/// The jobs that plates, scene, layers and look of a command line come to.

namespace limpid::tool {

/// What --layer names. Throws the usage Error for what is not ROLE=LAYER.
LayerOverrides layer_overrides(const std::vector<std::string>& texts);

/// What the jobs of all frames have in common: the only job, where there are no frames.
CompositeJob common_job(const CompositeArguments& arguments, const Sequence& sequence,
                        const CommonArguments& common);

/// That job made one frame's: with its scene, its time, and its number in all names.
CompositeJob job_of_frame(CompositeJob job, const CompositeArguments& arguments, int frame);

/// Throws the usage Error for a job of several views, which the verb does not do.
void expect_one_view(const CompositeJob& job, const std::string& verb);

}  // namespace limpid::tool
