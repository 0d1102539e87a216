#pragma once
#include <array>
#include <string>

#include "limpid/core/plane.h"

namespace limpid {

/// The bytes of a JPEG file, 8 bits, from values 0 ... 1 already encoded for display (clamped; NaN
/// becomes 0). The planes must have the same window.
std::string jpeg_of(const std::array<View<const float>, 3>& rgb, int quality = 88);

}  // namespace limpid
