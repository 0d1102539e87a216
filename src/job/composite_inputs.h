#pragma once
#include <string>
#include <vector>

#include "limpid/job/composite.h"
#include "limpid/plate/plate.h"

/// @file
/// The inputs of a job before a pixel is read.

namespace limpid {

/// The job's scene, completed by the plate: size, pixel aspect, a camera in its attributes, or the
/// whole scene that limpid render stores. Every chain needs camera and water plane: throws Error if
/// one is missing.
Scene scene_of(const CompositeJob& job, const Plate& plate);

/// The kind of the depth planes. Throws Error if the kind needs numbers that the scene lacks:
/// assumed near and far planes, as for a bare field of view, would give wrong distances.
DepthMeaning depth_of(const CompositeJob& job);

/// The job's look as a plan for the plate and the AOVs of the output; `left_out` as in
/// make_plan_without(). Throws Error for a plate without depth, and as make_plan().
Plan plan_of(const CompositeJob& job, const Plate& plate, const Scene& scene,
             const std::vector<std::string>& left_out = {});

/// Warnings about plate and plan, and about named layers that nothing reads.
std::vector<std::string> warnings_of(const CompositeJob& job, const Plate& plate, const Plan& plan);

/// Adds warnings about the pixels, for probable mistakes (picture_warnings.h); `transparent` is
/// LoadedPlate's.
void warn_of_pixels(const CompositeJob& job, const Plan& plan, const Frame& frame,
                    const Scene& scene, double transparent, std::vector<std::string>& warnings);

}  // namespace limpid
