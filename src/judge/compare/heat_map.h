#pragma once
#include <array>
#include <filesystem>
#include <span>

#include "judge/compare/compare.h"
#include "show/heat_color.h"

namespace limpid {

/// Maps a difference to a place 0 ... 1 on the color ramp.
struct HeatScale {
  double maximum = 1;  ///< the difference with the brightest color; larger ones are clamped
  double decades = 0;  ///< 0: linear from 0. Otherwise logarithmic, 0 at maximum / 10^decades
};

/// The differences of two pictures, as sRGB, 0 ... 1: the largest difference of a pixel's channels
/// as a color of the ramp, mismatches (NaN or inf in one picture only) in magenta. Throws Error as
/// compare() does, and for an invalid scale.
std::array<Plane, 3> heat_map(std::span<const ComparedChannel> channels,
                              const HeatScale& scale = {});

/// Writes the heat map as an 8-bit picture (.png).
void write_heat_map(const std::filesystem::path& path, std::span<const ComparedChannel> channels,
                    const HeatScale& scale = {});

}  // namespace limpid
