#pragma once
#include "limpid/core/frame.h"

#include "op/pass.h"
#include "optics/scattered_light.h"

namespace limpid {

/// The bottom that a picture shows, as one level floor as bright: for the light that the water
/// scatters into views from within. Reads color and depth, on a grid. Its albedo is the radiance of
/// all bottom in the dry picture over that of a white level floor in full light, so shade and walls
/// make it less. The depth is the mean by its own square, so that walls, which stand at all depths
/// up to the floor's, count little; at least that of the eye. `sky`: radiance of an even sky.
WaterFloor water_floor(const Frame& frame, const Pass& pass, const Rgb<double>& sky);

}  // namespace limpid
