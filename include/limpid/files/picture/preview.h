#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "limpid/core/plane.h"

namespace limpid {

/// The sRGB encoding of a linear value in 0 ... 1 (IEC 61966-2-1:1999).
float srgb_from_linear(float linear);
/// And the way back.
float linear_from_srgb(float encoded);

/// What a display shall show, 0 ... 1: scene-linear Rec.709 is multiplied by 2^exposure_stops,
/// clamped to 0 ... 1 and encoded as sRGB. +inf is white; NaN is black. display.h has other light
/// and other displays.
Plane displayed(View<const float> linear, double exposure_stops = 0);

/// Writes that with 8 bits as a picture to look at, in the format of the extension (.png, .jpg,
/// .tif). The planes must have one window. A PNG carries the texts, as write_image8() has it.
void write_preview(const std::filesystem::path& path, View<const float> r, View<const float> g,
                   View<const float> b, double exposure_stops = 0,
                   const std::map<std::string, std::string>& texts = {});

}  // namespace limpid
