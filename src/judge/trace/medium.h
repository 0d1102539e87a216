#pragma once
#include <vector>

#include "limpid/ops/look.h"

#include "judge/trace/truth.h"
#include "op/pass.h"
#include "ops/water_light.h"

namespace limpid::trace {

/// What is one and the same for the channels of one index of refraction.
struct Band {
  Rgb<double> mask{1, 1, 1};  ///< 1 for its channels, else 0
  double ior = 1.333;
  WaterLight light;
  Rgb<double> sun_on_water{0, 0, 0};   ///< irradiance under the surface, on what faces the sun
  Rgb<double> sun_on_bottom{0, 0, 0};  ///< color of the sun there, on what faces it
  double square = 1;  ///< radiance in the water over that in the air, where nothing is lost
};

/// The water as depth_fog, prism_split and water describe it.
struct Medium {
  /// Where all light is followed none counts as not scattered, whatever depth_fog's model is.
  Medium(const Pass& pass, const Look& look, TruthOptions::Light light);

  Rgb<double> rate{0, 0, 0};     ///< a + b
  Rgb<double> albedo{0, 0, 0};   ///< b / (a + b), 0 in clear water
  Rgb<double> ambient{0, 0, 0};  ///< b ambient
  double anisotropy = 0;
  bool crosses = false;     ///< whether the surface does anything to light from below
  bool bends_sun = false;   ///< whether sunlight has a direction of its own in the water
  std::vector<Band> bands;  ///< red, green, blue, or all in one
  std::size_t common = 0;   ///< the band of water.ior
};

}  // namespace limpid::trace
