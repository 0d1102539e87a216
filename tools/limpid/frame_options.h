#pragma once
#include <functional>
#include <string>

#include "limpid/files/text/scene_file.h"
#include "limpid/job/job_time.h"
#include "limpid/job/missing.h"
#include "limpid/job/output.h"
#include "limpid/job/resume.h"
#include "limpid/job/sequence.h"

#include "arguments.h"

/// What the verbs make of --frames and the options that go with it.

namespace limpid::tool {

/// Frames a second without --fps.
constexpr double kUsualFps = 24;

/// The frames that the options name; none where --frames is not given. Throws the usage Error for
/// bad numbers, for options that mean nothing without --frames or on a dry run, for outputs that
/// several frames would overwrite, and for a preview that a sequence cannot be resumed by.
Sequence sequence_of(const FrameOptions& options, const WaterOptions& outputs);

/// What `find` finds left of the sequence with --resume, which is told; without, all of it.
Sequence rest_of(const Sequence& sequence, const FrameOptions& options,
                 const CommonArguments& common,
                 const std::function<Rest(const Sequence&, VerifyLevel)>& find);

/// That --missing names.
Missing missing_named(const std::string& name);

/// When the frame is: --time, or the scene's, or 0 where there is neither, and then frame / --fps
/// later. A scene that is of this frame alone, and a plate, say their own time, unless --time or
/// --fps is given.
JobTime time_of_frame(const FrameOptions& options, const WaterOptions& water,
                      const SceneFile& scene, bool scene_of_frame, int frame);

/// The output with the frame's number in its names.
OutputChoice output_of_frame(OutputChoice output, int frame);

}  // namespace limpid::tool
