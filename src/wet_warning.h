#pragma once
#include <string>
#include <vector>

#include "limpid/core/frame.h"
#include "limpid/core/scene.h"

namespace limpid {

/// Adds a sentence where no pixel of Frame::work() is wet, or where all are, seen from the air:
/// then water, camera and depth hardly fit together. Looks at few pixels unless that is so. The
/// frame has been checked.
void warn_of_wet(const Frame& frame, const Scene& scene, std::vector<std::string>& warnings);

}  // namespace limpid
