#pragma once
#include "limpid/core/frame.h"
#include "limpid/core/plane.h"

#include "core/water_view.h"

namespace limpid {

/// Continues the depths of a row of a reflection to its sides, where the dry picture, from which
/// they were computed, shows no more. The image of a point at a side of the dry picture lies nearer
/// to the middle, because the image is farther away. From there to the side its surface goes on,
/// along a plane, as far as the colors of the reflection resemble its color, and over a quarter of
/// the width at most. `depth`: eye depths, scene units, +inf where none is known; the sign of known
/// ones does not matter, new ones are positive.
void go_on_to_sides(const Frame& frame, const WaterView& view, const View<float>& depth, int y);

}  // namespace limpid
