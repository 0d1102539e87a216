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

/// Interprets --frames and its companion options.

namespace limpid::tool {

/// Frames per second without --fps.
constexpr double kUsualFps = 24;

/// The frames of the options; empty without --frames. Throws the usage Error for bad numbers, for
/// options without effect because there is no --frames or a dry run, for outputs that several
/// frames would overwrite, and for a preview by which a sequence cannot be resumed.
Sequence sequence_of(const FrameOptions& options, const WaterOptions& outputs);

/// The rest of the sequence by `find` with --resume, which is reported; without it, the whole
/// sequence.
Sequence rest_of(const Sequence& sequence, const FrameOptions& options,
                 const CommonArguments& common,
                 const std::function<Rest(const Sequence&, VerifyLevel)>& find);

/// Parses --missing.
Missing missing_named(const std::string& name);

/// The frame's time: --time, or the scene's, or 0 if there is neither, plus frame / --fps. A scene
/// of this frame alone, and a plate, have their own time, unless --time or --fps is given.
JobTime time_of_frame(const FrameOptions& options, const WaterOptions& water,
                      const SceneFile& scene, bool scene_of_frame, int frame);

/// The output with the frame's number in its names.
OutputChoice output_of_frame(OutputChoice output, int frame);

}  // namespace limpid::tool
