#pragma once
#include <cstdint>
#include <vector>

#include "judge/compare/color_pair.h"
#include "judge/shot/shot.h"

namespace limpid {

/// Of each pixel, row by row, whether it is wet.
using WetMask = std::vector<std::uint8_t>;

/// How far a picture is from the one that judges it, in the words of `limpid compare --clip 4`.
ShotError shot_error(const ColorViews& picture, const ColorViews& judge, const WetMask& wet);

}  // namespace limpid
