#pragma once
#include "limpid/raster/model.h"

namespace limpid {

/// The model with each triangle of its water parted into four, so many times: the grid of a water
/// mesh may be too wide for the waves that raise it. Of the water's vertices positions are left.
Model with_finer_water(Model model, int times);

}  // namespace limpid
