#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace limpid {

/// A picture in few colors.
struct Paletted {
  std::vector<std::array<std::uint8_t, 3>> colors;  ///< 256 at most
  std::vector<std::uint8_t> pixels;                 ///< each the index of one
};

/// Of interleaved bytes, by Heckbert 1982 "Color Image Quantization for Frame Buffer Display": the
/// colors, taken apart by their upper five bits, are parted at the median of their longest side
/// until there are as many boxes as there may be, and each box has its mean. No pixel is off by
/// more than its box is wide.
Paletted paletted(std::span<const std::uint8_t> rgb, int most_colors);

}  // namespace limpid
