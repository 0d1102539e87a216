#pragma once
#include <cstdint>
#include <vector>

#include "limpid/core/color_space.h"

#include "judge/compare/color_pair.h"
#include "judge/shot/shot.h"

namespace limpid {

/// For each pixel, row by row, whether it is wet.
using WetMask = std::vector<std::uint8_t>;

/// The error of a picture, with the metrics of `limpid compare --clip 4`: SSIM and FLIP judge what
/// a display of Rec.709 shows, the others the numbers in the working space of `primaries`.
ShotError shot_error(const ColorViews& picture, const ColorViews& judge, const WetMask& wet,
                     const Primaries& primaries);

}  // namespace limpid
