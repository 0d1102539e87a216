#pragma once
#include <string>
#include <vector>

#include "limpid/job/composite.h"
#include "limpid/plate/plate.h"

/// @file
/// What a job and its plate come to before a pixel is read.

namespace limpid {

/// The job's scene, completed by what only the plate knows: size, pixel aspect, a camera in its
/// attributes, or a whole scene, as limpid render leaves it. No chain can do without camera and
/// water plane: throws Error where there is none.
Scene scene_of(const CompositeJob& job, const Plate& plate);

/// What the depth planes hold. A near and far that were made up, as those of a bare field of view,
/// would give wrong distances: throws Error where the kind needs what the scene lacks.
DepthMeaning depth_of(const CompositeJob& job);

/// What of the job's look runs on the plate, for the AOVs of its output; `left_out` as in
/// make_plan_without().
/// Throws Error for a plate without depth, and as make_plan().
Plan plan_of(const CompositeJob& job, const Plate& plate, const Scene& scene,
             const std::vector<std::string>& left_out = {});

/// Of the plate and the plan, and of layers that are named in vain.
std::vector<std::string> warnings_of(const CompositeJob& job, const Plate& plate, const Plan& plan);

/// Adds what the pixels show to be a probable mistake (picture_warnings.h); `transparent` is
/// LoadedPlate's.
void warn_of_pixels(const Plan& plan, const Frame& frame, const Scene& scene, double transparent,
                    std::vector<std::string>& warnings);

}  // namespace limpid
