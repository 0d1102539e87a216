#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "limpid/core/plane.h"

namespace limpid {

enum class EnvironmentLayout : std::uint8_t { kLatLong, kCube };

/// Size of the lat-long map to which a cube with faces of that side is resampled.
Size lat_long_of_cube(int face);

/// The channels of a picture of the surroundings, in the layout of Frame::environment and with
/// their corner at (0, 0); load_environment() has the conventions.
std::vector<Plane> environment_planes(std::span<const Plane> file, EnvironmentLayout layout,
                                      double rotation);

}  // namespace limpid
