#pragma once
#include "limpid/core/frame.h"

#include "core/water_view.h"
#include "op/plate_waves.h"

namespace limpid {

/// From the frame's surface_depth and, if present, surface_normal, over the wet pixels of a grid of
/// about 64 x 64. `raised`: from 0, if the mean height over the calm water is a 2000th of the eye's
/// (the largest error of a depth in half floats), to 1 at four times as much. Surfaces that are not
/// finite count as dry. `variance`: the mean square of slopes, each weighted by the square of the
/// sine at which it is seen, because at flat angles a raised surface shows the slopes that face the
/// view. `turn`: the mean square of the slopes' differences from pixel to pixel, per scene unit,
/// over the variance, where pixels are small. `smooth`: such that pixels farther apart than the
/// waves are long have in common what the frame shows, from 0, if they have nothing in common or if
/// there are 64 of them or fewer, to 1.
PlateWaves plate_waves_of(const Frame& frame, const WaterView& view);

/// Of the sines that raise the water, at their scale, in closed form. `raised` is 1, `smooth` 0.
PlateWaves plate_waves_of_sines(const WaterView& view);

}  // namespace limpid
