#pragma once
#include <optional>
#include <string>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "limpid/core/executor.h"
#include "limpid/core/plane.h"
#include "limpid/core/scene.h"
#include "limpid/raster/model.h"

namespace limpid {

struct Box {
  glm::dvec3 min, max;
};

/// Distance from the sun of the surfaces that it sees, on a grid across its direction. A point is
/// lit if its depth, less a bias, is not behind the map's: bias_texels texels along the surface's
/// slope (clamped to max_slope), plus `bias`. The result is the mean of 3x3 comparisons, blended
/// between texels.
struct ShadowMap {
  static constexpr double kBiasTexels = 2.5, kMaxSlope = 8;

  glm::dmat4 map_from_world{1.0};  ///< x, y in texels (centres at +0.5), z = depth from the sun
  glm::dmat3 sun_from_world{1.0};  ///< rotation alone; z points to the sun
  double texel = 1;                ///< scene units
  double bias = 0;                 ///< scene units
  Plane depth;                     ///< +inf where the sun sees nothing
};

/// Draws the map, `size` x `size` texels fitted to all objects that cast shadows: all instances but
/// the water; or, across the sun's direction, to their part within `bounds`. Throws Error for a
/// size outside 1 ... 16384 or a sun direction that is not unit.
ShadowMap make_shadow_map(const Model& model, const Sun& sun, const std::optional<Box>& bounds,
                          int size, Executor& executor, const std::string& simd = "");

/// The sun's visibility at a point with this unit normal: 1 lit ... 0; 0 where the surface faces
/// away, 1 outside the map. The raster pass evaluates the same in lanes.
double shadow_at(const ShadowMap& map, glm::dvec3 world, glm::dvec3 normal);

}  // namespace limpid
