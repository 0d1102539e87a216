#include <string>

#include <gtest/gtest.h>

#include "limpid/ops/look.h"

namespace limpid {
namespace {

/// The default of each parameter and, for numbers, the range.
std::string declared() {
  std::string text;
  for (const Parameter& p : parameters(Look{})) {
    if (p.kind == FieldKind::kText) continue;  // the name of a file
    text += std::string(p.table) + "." + std::string(p.name) + " = " + to_string(p.value);
    if (p.range.min < p.range.max) {
      text += " in " + to_string(Value(p.range.min)) + " ... " + to_string(Value(p.range.max));
    }
    text += "\n";
  }
  return text;
}

// A saved look names its differences from the defaults of its version: another default makes other
// water of the look, and a narrower range refuses the look. So neither changes by accident.
TEST(SavedLooks, RelyOnTheseDefaultsAndRanges) {
  EXPECT_EQ(declared(), R"(water.ior = 1.333 in 1 ... 4
water.edges = mixed
wave_normals.model = slopes
wave_normals.filter = none
wave_normals.strength = 0.5 in 0 ... 4
wave_normals.tile_size = 4 in 1e-06 ... 1e+09
wave_normals.speed = 0.3 in -1000000 ... 1000000
wave_normals.direction = 135 in -360 ... 360
wave_normals.wind = 0 in 0 ... 30
wave_normals.waves = [] in -1000000 ... 1000000
prism_split.model = dispersion
prism_split.strength = 0 in -10 ... 10
prism_split.gain = 1 in 0 ... 100
refraction.model = snell
refraction.strength = 0.03 in -10 ... 10
refraction.rejection = shorten
refraction.steps = march in 0 ... 64
refraction.off_frame = continue
refraction.thickness = 0 in 0 ... 1000000
caustics.strength = 1 in 0 ... 10
caustics.sun_share = 0.8 in 0 ... 1
caustics.sunlight = refracted
depth_fog.model = beer_lambert
depth_fog.distance = refracted
depth_fog.density = 0.15 in 0 ... 1000000
depth_fog.offset = 0 in -1000000 ... 1000000
depth_fog.color = [0.02, 0.1, 0.12] in 0 ... 1000000
depth_fog.alpha = 0.9 in 0 ... 1
depth_fog.absorption = [0.34, 0.0565, 0.00922] in 0 ... 1000000
depth_fog.scattering = [0.1, 0.12, 0.14] in 0 ... 1000000
depth_fog.murkiness = 0.5 in 0 ... 1
depth_fog.sediment = 0 in 0 ... 10000
depth_fog.cdom = 0 in 0 ... 1000
depth_fog.water_type = II
depth_fog.anisotropy = 0.92 in -0.99 ... 0.99
depth_fog.ambient = [0.1, 0.1, 0.1] in 0 ... 1000000
depth_fog.sunlight = refracted
depth_fog.crossing = radiance
water_shadow.model = scatter
water_shadow.strength = 1 in 0 ... 1
water_shadow.shafts = 0 in 0 ... 1
fresnel_reflection.reflectance = exact
fresnel_reflection.power = 3 in 0 ... 100
fresnel_reflection.intensity = 1 in 0 ... 100
fresnel_reflection.f0 = 0.020373 in 0 ... 1
fresnel_reflection.source = planar
fresnel_reflection.lookup = ray
fresnel_reflection.facets = mean
fresnel_reflection.strength = 0.02 in -10 ... 10
fresnel_reflection.color = [0, 0, 0] in 0 ... 1000000
sun_highlight.model = ggx
sun_highlight.power = 200 in 0 ... 100000
sun_highlight.strength = 1 in 0 ... 1000000
sun_highlight.roughness = 0.01 in 0 ... 1
penetration.model = none
penetration.alpha = 1 in 0 ... 1
penetration.amount = 0.2 in 0 ... 1
penetration.power = 5 in 0 ... 100
)");
}

}  // namespace
}  // namespace limpid
