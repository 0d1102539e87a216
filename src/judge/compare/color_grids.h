#pragma once
#include <array>
#include <cstdint>

#include "judge/compare/color_pair.h"
#include "judge/compare/grid.h"

namespace limpid {

using ColorGrid = std::array<Grid<float>, 3>;

/// The two pictures, black in both where either has NaN or inf, and the mismatches among these
/// pixels.
struct CleanPair {
  Rect window;
  ColorGrid a, b;
  Grid<std::uint8_t> mismatched;
};

/// Throws Error for different windows.
CleanPair clean(const ColorPair& pictures);

/// Y for the primaries of sRGB.
inline double luminance(double r, double g, double b) {
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

}  // namespace limpid
