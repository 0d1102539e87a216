#pragma once
#include <array>

namespace limpid {

/// The sRGB color, 0 ... 1 a channel, of a place on the ramp from dark blue (0) to yellow (1),
/// whose lightness rises evenly: viridis (Smith & van der Walt 2015, CC0), from nine of its 256
/// colors.
std::array<float, 3> heat_color(double place);

}  // namespace limpid
