#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "limpid/core/plane.h"

namespace limpid {

enum class EnvironmentLayout : std::uint8_t { kLatLong, kCube };

/// Of the lat-long map that a cube with faces of that side is resampled to.
Size lat_long_of_cube(int face);

/// The channels of a picture of the surroundings, in the layout of Frame::environment and with
/// their corner at (0, 0); see load_environment() for the conventions.
std::vector<Plane> environment_planes(std::span<const Plane> file, EnvironmentLayout layout,
                                      double rotation);

}  // namespace limpid
