#pragma once
#include <string>

#include "limpid/files/text/scene_file.h"
#include "limpid/job/missing.h"
#include "limpid/job/output.h"
#include "limpid/job/resume.h"
#include "limpid/job/sequence.h"

#include "arguments.h"

/// What the verbs make of --frames and the options that go with it.

namespace limpid::tool {

/// The frames that the options name; none where --frames is not given. Throws the usage Error for
/// bad numbers, for options that mean nothing without --frames or on a dry run, for outputs that
/// several frames would overwrite, and for a preview that a sequence cannot be resumed by.
Sequence sequence_of(const FrameOptions& options, const WaterOptions& outputs);

/// How closely --resume looks at what is there.
Scrutiny scrutiny_of(const FrameOptions& options);

/// That --missing names.
Missing missing_named(const std::string& name);

/// --time, or that of the scene where it is not given; 0 without either.
double begin_of(const WaterOptions& water, const SceneFile& scene);
/// That + frame / --fps.
double time_of_frame(const FrameOptions& options, double begin, int frame);

/// The output with the frame's number in its names.
OutputChoice output_of_frame(OutputChoice output, int frame);

}  // namespace limpid::tool
