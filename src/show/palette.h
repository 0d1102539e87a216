#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace limpid {

/// A picture with a palette.
struct Paletted {
  std::vector<std::array<std::uint8_t, 3>> colors;  ///< 256 at most
  std::vector<std::uint8_t> pixels;                 ///< indices in `colors`
};

/// Quantises interleaved bytes, by Heckbert 1982 "Color Image Quantization for Frame Buffer
/// Display": the colors, binned by their upper five bits, are split at the median of their longest
/// side until there are `most_colors` boxes, and each box gets its mean. The error of a pixel is at
/// most the width of its box.
Paletted paletted(std::span<const std::uint8_t> rgb, int most_colors);

}  // namespace limpid
