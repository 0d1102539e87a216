#include "trace/medium.h"

#include <numbers>

#include <glm/geometric.hpp>

#include "limpid/optics/crossing.h"
#include "limpid/optics/fresnel.h"
#include "limpid/optics/refract.h"
#include "limpid/optics/water_index.h"
#include "limpid/optics/water_types.h"

namespace limpid::trace {
namespace {

/// K: what light from above loses for each length of its way down.
Rgb<double> falling_loss(const DepthFog::Params& fog) {
  const bool typed = fog.water_type != WaterType::kCustom && fog.water_type != WaterType::kPure;
  if (typed) return water_optics(fog.water_type).down_attenuation;
  // What is scattered goes on forwards, mostly.
  return DepthFog::extinction(fog) - fog.anisotropy * fog.scattering;
}

Band band_of(const Scene& scene, const DepthFog::Params& fog, double ior) {
  using Sunlight = DepthFog::Sunlight;
  Band band;
  band.ior = ior;
  const bool crosses = fog.crossing == DepthFog::Crossing::kRadiance;
  band.water = crosses ? radiance_crossing(ior, 0.0) : 1;
  band.bottom = crosses ? radiance_crossing(ior, kDiffuseAirToWater) : 1;
  if (!scene.sun) return band;

  const glm::dvec3 &up = scene.water->up, &to_sun = scene.sun->direction;
  const double cosine = glm::dot(to_sun, up), lost = fresnel_exact(cosine, ior);
  if (crosses) band.bottom = radiance_crossing(ior, lost);
  band.to_sun = to_sun;
  band.sun = std::numbers::pi * fog.scattering * scene.sun->color;
  if (fog.sunlight == Sunlight::kStraight) band.down = (1 / cosine) * falling_loss(fog);
  if (fog.sunlight == Sunlight::kRefracted) {
    const double inside = refracted_cosine(cosine, 1 / ior);
    band.to_sun = (to_sun - cosine * up) / ior + inside * up;
    band.spread = cosine / inside;
    band.down = (1 / inside) * falling_loss(fog);
    band.sun = ((1 - lost) * band.spread) * band.sun;
  }
  return band;
}

}  // namespace

Medium::Medium(const Scene& scene, const Look& look) {
  const DepthFog::Params& fog = look.of<DepthFog>();
  rate = DepthFog::extinction(fog);
  ambient = fog.scattering * fog.ambient;
  anisotropy = fog.anisotropy;
  sunlit = scene.sun && fog.scattering * scene.sun->color != Rgb<double>{0, 0, 0};
  bends_sun = scene.sun && fog.sunlight == DepthFog::Sunlight::kRefracted;

  const double gain = look.of<PrismSplit>().gain;
  if (gain == 0) {
    bands = {band_of(scene, fog, look.water.ior)};
    return;
  }
  const Rgb<double> index = water_index_rgb();
  const auto channel = [&](double own, const Rgb<double>& mask) {
    Band band = band_of(scene, fog, look.water.ior + gain * (own - index.g));
    band.mask = mask;
    return band;
  };
  bands = {channel(index.r, {1, 0, 0}), channel(index.g, {0, 1, 0}), channel(index.b, {0, 0, 1})};
  common = 1;
}

}  // namespace limpid::trace
