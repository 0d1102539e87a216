#pragma once
#include <array>
#include <filesystem>
#include <span>

#include "judge/compare/compare.h"
#include "show/heat_color.h"

namespace limpid {

/// How a difference becomes a place 0 ... 1 on the color ramp.
struct HeatScale {
  double maximum = 1;  ///< the difference that gets the brightest color, and all beyond it
  double decades = 0;  ///< 0: linear from 0. Otherwise logarithmic, 0 at maximum / 10^decades
};

/// Where two pictures differ, as sRGB, 0 ... 1: the largest difference of a pixel's channels as a
/// color of the ramp, mismatches (NaN or inf in one picture only) in magenta. Throws Error as
/// compare() does, and for a scale that means nothing.
std::array<Plane, 3> heat_map(std::span<const ComparedChannel> channels,
                              const HeatScale& scale = {});

/// Writes that as an 8-bit picture (.png).
void write_heat_map(const std::filesystem::path& path, std::span<const ComparedChannel> channels,
                    const HeatScale& scale = {});

}  // namespace limpid
