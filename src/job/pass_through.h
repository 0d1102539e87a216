#pragma once
#include <string>
#include <vector>

#include "limpid/files/exr/exr_writer.h"
#include "limpid/job/output.h"
#include "limpid/plate/plate.h"

namespace limpid {

/// Throws the Error of Fault::kUsage for a channel that is passed through beside the picture's and
/// has the name of one of those, naming both, and for a compression that would change samples.
void expect_passable(const std::vector<PassedPart>& passed, const std::vector<MotionLayer>& motion,
                     const OutputChoice& choice);

/// A sentence for each manifest of a cryptomatte that lies in a file of its own, in another folder
/// than the picture's, and will not be found from there.
std::vector<std::string> manifest_warnings(const std::vector<PassedPart>& passed,
                                           const OutputChoice& choice);

/// Adds to the picture's part what comes from the color's, and returns the parts beside it: those
/// of the plates under their names, each with its data window as far as it lies in that of the
/// picture. Throws Error for one that lies outside, or has another display window.
std::vector<ExrOutput> pass_through(const std::vector<PassedPart>& passed, ExrOutput& picture);

}  // namespace limpid
