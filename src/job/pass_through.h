#pragma once
#include <string>
#include <vector>

#include "limpid/files/exr/exr_writer.h"
#include "limpid/job/output.h"
#include "limpid/plate/plate.h"

namespace limpid {

/// Throws the Error of Fault::kUsage if a passed channel in the picture's part has the name of one
/// of the picture's channels, naming both, and for a lossy compression that would change samples.
void expect_passable(const std::vector<PassedPart>& passed, const std::vector<MotionLayer>& motion,
                     const OutputChoice& choice);

/// A sentence for each manifest of a cryptomatte that lies in a separate file, in another folder
/// than the picture's, and will not be found from there.
std::vector<std::string> manifest_warnings(const std::vector<PassedPart>& passed,
                                           const OutputChoice& choice);

/// Adds the passed channels of the color's part to the picture's part, and returns the parts beside
/// it: those of the plates under their names, each with its data window clipped to that of the
/// picture. Throws Error for a part that lies outside, or has another display window.
std::vector<ExrOutput> pass_through(const std::vector<PassedPart>& passed, ExrOutput& picture);

}  // namespace limpid
