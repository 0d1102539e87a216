#pragma once
#include "limpid/core/camera.h"

namespace limpid {

/// Throws Error unless device depth runs from near to far as camera.clip says: else it would be
/// read as nonsense.
void expect_clip_direction(const Camera& camera);

}  // namespace limpid
