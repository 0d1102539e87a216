#include "trace/medium.h"

#include "limpid/optics/water_index.h"

namespace limpid::trace {

Medium::Medium(const Context& context, const Look& look) {
  const DepthFog::Params& fog = look.of<DepthFog>();
  rate = DepthFog::extinction(fog);
  ambient = fog.scattering * fog.ambient;
  anisotropy = fog.anisotropy;

  const auto band = [&](double ior) {
    Band one;
    one.ior = ior;
    one.light = water_light(fog, context, ior);
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
