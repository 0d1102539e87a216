#pragma once
#include <cstdint>
#include <vector>

#include "judge/compare/color_pair.h"
#include "judge/shot/shot.h"

namespace limpid {

/// For each pixel, row by row, whether it is wet.
using WetMask = std::vector<std::uint8_t>;

/// The error of a picture, with the metrics of `limpid compare --clip 4`.
ShotError shot_error(const ColorViews& picture, const ColorViews& judge, const WetMask& wet);

}  // namespace limpid
