#pragma once
#include "limpid/job/water.h"

#include "arguments.h"
#include "job/truth.h"

/// The jobs of scene, look and options of a command line.

namespace limpid::tool {

SceneJob scene_job(const RenderArguments& arguments, const CommonArguments& common);
RenderOptions render_options(const RenderArguments& arguments);

/// The common part of the jobs of all frames: the only job, if there are no frames.
WaterJob water_job(const RenderArguments& arguments, const CommonArguments& common);
TruthJob truth_job(const TruthArguments& arguments, const CommonArguments& common);

/// That job for one frame: with its time, and its number in all names.
WaterJob water_job_of_frame(WaterJob job, const RenderArguments& arguments, int frame);
TruthJob truth_job_of_frame(TruthJob job, const TruthArguments& arguments, int frame);

}  // namespace limpid::tool
