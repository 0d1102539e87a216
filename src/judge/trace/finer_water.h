#pragma once
#include <cstddef>
#include <span>

#include <glm/vec3.hpp>

#include "limpid/core/scene.h"
#include "limpid/raster/model.h"

namespace limpid {

/// Length of the shortest of the waves, in scene units; +inf for calm water.
double shortest_wave(std::span<const SineWave> waves);

/// How fine the grid of a water has to be for its waves, on lines from vertex to vertex. An edge is
/// no longer than a quarter of the shortest wave, which keeps two thirds of the squares of that
/// wave's slopes and nine tenths of those of one twice as long. Where it is seen wider than a
/// hundredth of its distance it is parted further, until it is no longer than a sixteenth of the
/// wave.
struct FinerWater {
  double shortest_wave = 1;  ///< length in scene units, above 0
  glm::dvec3 eye{0};
  std::size_t most = 2'000'000;  ///< triangles, in all
};

struct PartedWater {
  Model model;
  std::size_t triangles = 0;  ///< of its water
  double reach = 0;           ///< from the eye: so far the edges are short enough
};

/// The model with each edge of its water that is too long parted, in both triangles that have it.
/// Where that would make more triangles than `most` edges beyond a reach are parted only until they
/// are no longer than they are far away; where even that is too much the water stays as it is, and
/// the reach is 0. Of the vertices of parted water positions are left.
PartedWater with_finer_water(Model model, const FinerWater& how);

}  // namespace limpid
