#include "judge/trace/medium.h"

#include "ops/depth_fog_kernel.h"
#include "optics/water_index.h"

namespace limpid::trace {
namespace {

double share(double part, double whole) { return whole > 0 ? part / whole : 0; }
Rgb<double> shares(const Rgb<double>& part, const Rgb<double>& whole) {
  return {share(part.r, whole.r), share(part.g, whole.g), share(part.b, whole.b)};
}

}  // namespace

Medium::Medium(const Pass& pass, const Look& look, TruthOptions::Light light) {
  DepthFog::Params fog = look.of<DepthFog>();
  if (light == TruthOptions::Light::kPaths) fog.model = DepthFog::Model::kBeerLambert;
  const Rgb<double> scattering = Kernel<DepthFog>::scattering(fog);
  rate = Kernel<DepthFog>::extinction(fog);
  albedo = shares(scattering, rate);
  ambient = scattering * fog.ambient;
  anisotropy = fog.anisotropy;
  crosses = fog.crossing != DepthFog::Crossing::kNone;

  const auto band = [&](double ior) {
    Band one;
    one.ior = ior;
    one.light = water_light(fog, pass, ior);
    one.square = crosses ? ior * ior : 1;
    one.sun_on_water = shares(one.light.sun, scattering);
    const double enters = one.light.day ? one.light.spread * one.light.bottom * one.square : 0;
    one.sun_on_bottom = enters * pass.sun.color;
    return one;
  };
  const double gain = look.of<PrismSplit>().gain;
  if (gain == 0) {
    bands = {band(look.water.ior)};
  } else {
    const Rgb<double> index = water_index_rgb();
    const auto channel = [&](double own, const Rgb<double>& mask) {
      Band one = band(look.water.ior + gain * (own - index.g));
      one.mask = mask;
      return one;
    };
    bands = {channel(index.r, {1, 0, 0}), channel(index.g, {0, 1, 0}), channel(index.b, {0, 0, 1})};
    common = 1;
  }
  bends_sun = bands[common].light.day && fog.sunlight == DepthFog::Sunlight::kRefracted;
}

}  // namespace limpid::trace
