#pragma once
#include "limpid/core/rect.h"
#include "limpid/core/scene.h"

namespace limpid {

/// Throws the Error for a scene that cannot be rendered with its water: without camera or water,
/// with the sun below the horizon, or with a picture that is too small or too large.
void check_rendered(const Scene& scene, Size size, int overscan = 0);

}  // namespace limpid
