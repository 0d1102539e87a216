#pragma once
#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/plane.h"

namespace limpid {

/// Continues the depths of a reflection up and down its columns to the outlines that its colors
/// show. The dry picture, from which the depths were computed, shows no undersides: the images of
/// those of a jetty, a boat or a tree's crown lie above or below the image of what it shows. A
/// depth goes on where the reflection keeps its color, if this color differs clearly from that of
/// the unknown texel 1/64 of the picture's height away. `valid`: 1 or 0, texels with 0 neither
/// change nor go on; `depth`: eye depths, scene units, +inf where none is known.
void grow_to_outlines(const Frame& frame, const View<const float>& valid, const View<float>& depth,
                      Executor& executor);

}  // namespace limpid
