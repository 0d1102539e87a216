#pragma once
#include <string_view>

#include "limpid/files/exr/exr_file.h"
#include "limpid/plate/plate.h"

namespace limpid {

/// The channel of a deep part whose samples give the plane, or "" for planes that only flat pixels
/// give.
std::string_view deep_channel(PlaneId plane);

/// Reads these planes (those of deep_channel()) from a deep part (files/exr/deep.h) and enters them
/// in `loaded`, which has its display window and, if present, the surface depth already. Below is
/// the scene behind that surface, or else behind the calm plane; for views that begin in the water
/// it is the whole scene. Throws Error if below is requested and the scene lacks camera or water,
/// for a depth kind that deep samples cannot have, and as read_deep_layers().
void read_deep_planes(const ExrFile& file, int part, PlaneSet planes, const Rect& window,
                      const Scene& scene, const DepthMeaning& depth, LoadedPlate& loaded);

}  // namespace limpid
