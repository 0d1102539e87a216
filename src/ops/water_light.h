#pragma once
#include <glm/vec3.hpp>

#include "limpid/ops/depth_fog.h"

#include "op/pass.h"

namespace limpid {

/// What becomes of the sun's light in water of an index of refraction, and of what leaves it
/// (ops/depth_fog.h has the formulas).
struct WaterLight {
  bool day = false;            ///< a sun at the horizon or under it counts as none
  glm::dvec3 to_sun{0, 1, 0};  ///< unit, in the water
  double spread = 1;           ///< of the sunlight, which the surface makes a wider beam
  Rgb<double> down{0, 0, 0};   ///< K / cos_sun: what it loses for each depth
  Rgb<double> beam{0, 0, 0};   ///< E' / pi: what a white Lambert surface shows that faces it
  Rgb<double> sun{0, 0, 0};    ///< b E', scattered for each length
  /// What leaving the water makes of light: of that of the bottom, lit through the surface, and of
  /// that of the water.
  double bottom = 1, water = 1;
};

/// `ior` below 1 is for who bends each color by its own: beyond its critical angle the sun is
/// reflected whole and spread, sun and bottom (with `crossing`) are 0.
WaterLight water_light(const DepthFog::Params& params, const Pass& c, double ior);

}  // namespace limpid
