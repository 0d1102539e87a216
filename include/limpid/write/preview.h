#pragma once
#include <filesystem>

#include "limpid/core/plane.h"

namespace limpid {

/// The sRGB encoding of a linear value in 0 ... 1 (IEC 61966-2-1:1999).
float srgb_from_linear(float linear);

/// Writes a picture to look at: scene-linear Rec.709 is multiplied by 2^exposure_stops, clamped to
/// 0 ... 1, encoded as sRGB and stored with 8 bits in the format of the extension (.png, .jpg,
/// .tif). +inf is white; NaN is black. The planes must have one window.
void write_preview(const std::filesystem::path& path, View<const float> r, View<const float> g,
                   View<const float> b, double exposure_stops = 0);

}  // namespace limpid
