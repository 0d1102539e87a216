#pragma once
#include "limpid/core/camera.h"

namespace limpid {

/// Throws Error unless device depth runs from near to far as camera.clip says: otherwise depths
/// would be wrong.
void expect_clip_direction(const Camera& camera);

}  // namespace limpid
