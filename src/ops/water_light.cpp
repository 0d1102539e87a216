#include "ops/water_light.h"

#include <algorithm>
#include <numbers>

#include <glm/geometric.hpp>

#include "ops/depth_fog_kernel.h"
#include "optics/crossing.h"
#include "optics/fresnel.h"

namespace limpid {
namespace {

bool transfers(const DepthFog::Params& params) {
  return params.model == DepthFog::Model::kRadiativeTransfer;
}

/// K: loss of light from above per unit of its way down.
Rgb<double> falling_loss(const DepthFog::Params& params) {
  if (transfers(params)) return Kernel<DepthFog>::extinction(params);
  const WaterType type = params.water_type;
  const bool typed = type >= WaterType::kJerlovI && type <= WaterType::kJerlov9C;
  // Most light is scattered forwards.
  const double turned = 1 - params.anisotropy;
  if (typed) {
    const WaterCoefficients additions = Kernel<DepthFog>::additions(params);
    const Rgb<double> down =
        params.fitted ? params.fitted->down_attenuation : water_optics(type).down_attenuation;
    return down + additions.absorption + turned * additions.scattering;
  }
  return Kernel<DepthFog>::absorption(params) + turned * Kernel<DepthFog>::scattering(params);
}

}  // namespace

WaterLight water_light(const DepthFog::Params& params, const Pass& c, double ior) {
  using Sunlight = DepthFog::Sunlight;
  WaterLight light;
  // A sun on the horizon gives the water no light; it would divide by 0.
  const double cosine = glm::dot(c.sun.direction, c.up);
  light.day = c.has_sun && cosine > 1e-6;
  light.to_sun = c.sun.direction;
  const double lost = light.day ? fresnel_exact(cosine, ior) : kDiffuseAirToWater;
  if (params.crossing == DepthFog::Crossing::kRadiance) {
    light.bottom = radiance_crossing(ior, lost);
    light.water = radiance_crossing(ior, 0.0);
  }
  if (!light.day) {
    // Mean cosine of the sky's light on its way down.
    const double steep = params.sunlight == Sunlight::kRefracted ? 0.83 : 0.6;
    if (transfers(params) && params.sunlight != Sunlight::kNone) {
      light.down = (1 / steep) * falling_loss(params);
    }
    return light;
  }

  light.beam = c.sun.color;
  if (params.sunlight == Sunlight::kStraight) light.down = (1 / cosine) * falling_loss(params);
  if (params.sunlight == Sunlight::kRefracted) {
    const double inside = refracted_cosine(cosine, 1 / ior);
    const bool enters = inside > 0;
    // A level beam never gets deeper.
    light.down = (1 / std::max(inside, 1e-30)) * falling_loss(params);
    light.spread = enters ? cosine / inside : 0;
    light.beam = (enters ? (1 - lost) * cosine / inside : 0) * c.sun.color;
    light.to_sun = enters ? (c.sun.direction - cosine * c.up) / ior + inside * c.up : c.up;
  }
  light.sun = std::numbers::pi * Kernel<DepthFog>::scattering(params) * light.beam;
  return light;
}

}  // namespace limpid
