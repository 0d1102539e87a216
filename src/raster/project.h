#pragma once
#include <vector>

#include "limpid/raster/rasterise.h"

#include "raster/prepared.h"
#include "raster/raster_job.h"

namespace limpid::raster {

/// The window in pixels from an origin near its middle, so that fixed-point positions stay small.
Screen screen_of(const RasterView& view);

/// The instances in the view, with their transforms to the screen.
std::vector<DrawnInstance> drawn_instances(const PreparedModel& prepared, const RasterView& view,
                                           const Screen& screen);

}  // namespace limpid::raster
