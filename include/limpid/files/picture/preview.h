#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "limpid/core/plane.h"

namespace limpid {

/// The sRGB encoding of a linear value in 0 ... 1 (IEC 61966-2-1:1999).
float srgb_from_linear(float linear);
/// The inverse of srgb_from_linear().
float linear_from_srgb(float encoded);

/// Encodes light for a display, 0 ... 1: multiplies scene-linear Rec.709 by 2^exposure_stops,
/// clamps to 0 ... 1 and encodes as sRGB. +inf becomes white, NaN black. display.h has other color
/// spaces and displays.
Plane displayed(View<const float> linear, double exposure_stops = 0);

/// Writes displayed() planes with 8 bits, in the format of the extension (.png, .jpg, .tif). The
/// planes must have one window. A PNG has the texts, as in write_image8().
void write_preview(const std::filesystem::path& path, View<const float> r, View<const float> g,
                   View<const float> b, double exposure_stops = 0,
                   const std::map<std::string, std::string>& texts = {});

}  // namespace limpid
