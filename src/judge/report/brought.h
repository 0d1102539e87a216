#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "limpid/core/frame.h"
#include "limpid/core/scene.h"

namespace limpid {

/// What one brings after what one has.
struct Brought {
  PlaneSet added, all;
};
/// Color and depth; the shadow; a reflection; its depth and validity; the surface and what lies
/// below it. Of these the ones that a plate with such planes has.
std::vector<Brought> brought_one_by_one(PlaneSet planes);

/// How long waves are, in scene units: 2 pi sqrt(mean square slope / mean square curvature), which
/// of one sine is its wave length. NaN for calm water.
double wave_length(std::span<const SineWave> waves);
/// Of a tiling normal map, one period every `tile_size` units.
double wave_length(const Texture& map, double tile_size);

enum class Place : std::uint8_t { kDry, kNear, kFar };
/// Of each pixel of frame.work(), row by row: a wet one is near where the longer side of its
/// footprint on the calm water is shorter than `near` (NaN: any is), and where a view in the water
/// does not meet it.
std::vector<Place> places_of(const Scene& scene, const Frame& frame, double near,
                             const std::function<bool(int x, int y)>& wet);

}  // namespace limpid
