#pragma once
#include <glm/vec3.hpp>

#include "limpid/ops/depth_fog.h"

#include "op/pass.h"

namespace limpid {

/// The sun's light in water of an index of refraction, and the factors for light that leaves the
/// water (ops/depth_fog.h has the formulas).
struct WaterLight {
  bool day = false;            ///< false for a sun at or below the horizon
  glm::dvec3 to_sun{0, 1, 0};  ///< unit, in the water
  double spread = 1;           ///< of the sunlight, which the surface widens to a broader beam
  Rgb<double> down{0, 0, 0};   ///< K / cos_sun: loss per unit of depth
  Rgb<double> beam{0, 0, 0};   ///< E' / pi: radiance of a white Lambert surface that faces the beam
  Rgb<double> sun{0, 0, 0};    ///< b E', scattered per unit of length
  /// Factors for light that leaves the water: for the light of the bottom, lit through the surface,
  /// and for the light of the water.
  double bottom = 1, water = 1;
};

/// `ior` below 1 is for dispersion, which bends each color by its own index: beyond its critical
/// angle the sun is totally reflected, and spread, sun and bottom (with `crossing`) are 0.
WaterLight water_light(const DepthFog::Params& params, const Pass& c, double ior);

}  // namespace limpid
