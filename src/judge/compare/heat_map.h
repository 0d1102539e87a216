#pragma once
#include <array>
#include <filesystem>
#include <span>

#include "judge/compare/compare.h"

namespace limpid {

/// How a difference becomes a place 0 ... 1 on the color ramp.
struct HeatScale {
  double maximum = 1;  ///< the difference that gets the brightest color, and all beyond it
  double decades = 0;  ///< 0: linear from 0. Otherwise logarithmic, 0 at maximum / 10^decades
};

/// The sRGB color, 0 ... 1 a channel, of a place on the ramp from dark blue (0) to yellow (1),
/// whose lightness rises evenly: viridis (Smith & van der Walt 2015, CC0), from nine of its 256
/// colors.
std::array<float, 3> heat_color(double place);

/// Where two pictures differ, as sRGB, 0 ... 1: the largest difference of a pixel's channels as a
/// color of the ramp, mismatches (NaN or inf in one picture only) in magenta. Throws Error as
/// compare() does, and for a scale that means nothing.
std::array<Plane, 3> heat_map(std::span<const ComparedChannel> channels,
                              const HeatScale& scale = {});

/// Writes that as an 8-bit picture (.png).
void write_heat_map(const std::filesystem::path& path, std::span<const ComparedChannel> channels,
                    const HeatScale& scale = {});

}  // namespace limpid
