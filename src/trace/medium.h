#pragma once
#include <vector>

#include <glm/vec3.hpp>

#include "limpid/core/scene.h"
#include "limpid/ops/look.h"

namespace limpid::trace {

/// What is one and the same for the channels of one index of refraction.
struct Band {
  Rgb<double> mask{1, 1, 1};  ///< 1 for its channels, else 0
  double ior = 1.333;
  glm::dvec3 to_sun{0, 1, 0};  ///< unit, in the water
  double spread = 1;           ///< of the sunlight, which the surface makes a wider beam
  Rgb<double> down{0, 0, 0};   ///< what it loses for each depth
  Rgb<double> sun{0, 0, 0};    ///< b E', scattered for each length
  /// What leaving the water makes of light: of that of the bottom, lit through the surface, and of
  /// that of the water.
  double bottom = 1, water = 1;
};

/// The water as depth_fog, prism_split and water describe it (ops/depth_fog.h has the formulas).
struct Medium {
  Medium(const Scene& scene, const Look& look);

  Rgb<double> rate{0, 0, 0};     ///< a + b
  Rgb<double> ambient{0, 0, 0};  ///< b ambient
  double anisotropy = 0;
  bool sunlit = false;      ///< whether it scatters sunlight
  bool bends_sun = false;   ///< whether sunlight has a direction of its own in the water
  std::vector<Band> bands;  ///< red, green, blue, or all in one
  std::size_t common = 0;   ///< the band of water.ior
};

}  // namespace limpid::trace
