#pragma once
#include <vector>

#include "limpid/ops/look.h"

#include "judge/trace/truth.h"
#include "op/pass.h"
#include "ops/water_light.h"

namespace limpid::trace {

/// Values for the channels with the same index of refraction.
struct Band {
  Rgb<double> mask{1, 1, 1};  ///< 1 for its channels, else 0
  double ior = 1.333;
  WaterLight light;
  Rgb<double> sun_on_water{0, 0, 0};   ///< irradiance under the surface, facing the sun
  Rgb<double> sun_on_bottom{0, 0, 0};  ///< color of the sun there, on a surface that faces it
  double square = 1;  ///< radiance in the water over that in the air, without losses
};

/// The water in the parameters of depth_fog, prism_split and water.
struct Medium {
  /// With Light::kPaths the narrow peak scatters, for any model of depth_fog.
  Medium(const Pass& pass, const Look& look, TruthOptions::Light light);

  Rgb<double> rate{0, 0, 0};     ///< a + b
  Rgb<double> albedo{0, 0, 0};   ///< b / (a + b), 0 in clear water
  Rgb<double> ambient{0, 0, 0};  ///< b ambient
  double anisotropy = 0;
  bool crosses = false;     ///< whether the surface changes light from below
  bool bends_sun = false;   ///< whether sunlight is refracted
  std::vector<Band> bands;  ///< red, green, blue, or all in one
  std::size_t common = 0;   ///< the band of water.ior
};

}  // namespace limpid::trace
