#pragma once
#include <string>

#include "limpid/output.h"
#include "limpid/sequence.h"

#include "arguments.h"

/// What the verbs make of --frames, --fps and --frames-in-flight.

namespace limpid::tool {

/// The frames that the options name; none where --frames is not given. Throws the usage Error for
/// bad numbers, for options that mean nothing without --frames, and for outputs that several frames
/// would overwrite.
Sequence sequence_of(const FrameOptions& options, const WaterOptions& outputs);

/// --time + frame / --fps.
double time_of_frame(const FrameOptions& options, const WaterOptions& water, int frame);

/// The output with the frame's number in its names.
OutputChoice output_of_frame(OutputChoice output, int frame);

}  // namespace limpid::tool
