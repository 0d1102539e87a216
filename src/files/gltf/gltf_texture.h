#pragma once
#include <string>
#include <string_view>

#include "limpid/files/limits.h"
#include "limpid/raster/model.h"

namespace limpid {

/// A PNG or JPEG file in memory, with 8 or 16 bits, as linear texels: color is decoded from sRGB,
/// alpha is unchanged. Throws Error, which begins with `name`, for other formats, damaged or
/// truncated files and sizes over the limits.
ModelTexture decode_texture(std::string_view bytes, const std::string& name, const Limits& limits);

}  // namespace limpid
