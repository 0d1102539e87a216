#pragma once
#include <vector>

#include "limpid/op/context.h"
#include "limpid/ops/look.h"

#include "ops/water_light.h"

namespace limpid::trace {

/// What is one and the same for the channels of one index of refraction.
struct Band {
  Rgb<double> mask{1, 1, 1};  ///< 1 for its channels, else 0
  double ior = 1.333;
  WaterLight light;
};

/// The water as depth_fog, prism_split and water describe it.
struct Medium {
  Medium(const Context& context, const Look& look);

  Rgb<double> rate{0, 0, 0};     ///< a + b
  Rgb<double> ambient{0, 0, 0};  ///< b ambient
  double anisotropy = 0;
  bool bends_sun = false;   ///< whether sunlight has a direction of its own in the water
  std::vector<Band> bands;  ///< red, green, blue, or all in one
  std::size_t common = 0;   ///< the band of water.ior
};

}  // namespace limpid::trace
