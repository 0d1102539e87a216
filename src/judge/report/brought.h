#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "limpid/core/frame.h"
#include "limpid/core/scene.h"

namespace limpid {

/// Buffers of a plate, as steps: each adds to those before.
struct Brought {
  PlaneSet added, all;
};
/// Color and depth; the shadow; a reflection; its depth and validity; the surface and the layer
/// below it. Only steps that a plate with these planes has.
std::vector<Brought> brought_one_by_one(PlaneSet planes);

/// Length of waves, in scene units: 2 pi sqrt(mean square slope / mean square curvature), for a
/// single sine its wavelength. NaN for calm water.
double wave_length(std::span<const SineWave> waves);
/// Of a tiling normal map, one period every `tile_size` units.
double wave_length(const Texture& map, double tile_size);

enum class Place : std::uint8_t { kDry, kNear, kFar };
/// For each pixel of frame.work(), row by row: a wet pixel is near if the longer side of its
/// footprint on the calm water is shorter than `near` (NaN: always), and if a view in the water
/// does not meet the surface.
std::vector<Place> places_of(const Scene& scene, const Frame& frame, double near,
                             const std::function<bool(int x, int y)>& wet);

}  // namespace limpid
