#include "limpid/ops/depth_fog.h"

#include <numbers>

#include <glm/geometric.hpp>

#include "limpid/optics/crossing.h"
#include "limpid/optics/fresnel.h"

namespace limpid {
namespace {

using P = DepthFog::Params;

constexpr std::string_view kModels[] = {"linear", "beer_lambert"};
constexpr std::string_view kDistances[] = {"eye", "ray", "refracted"};
constexpr std::string_view kSunlights[] = {"none", "straight", "refracted"};
constexpr std::string_view kCrossings[] = {"none", "radiance"};

constexpr Field<P> kFields[] = {
    choice<&P::model, kModels>("model", "How light dies away with distance."),
    choice<&P::distance, kDistances>("distance", "How the way through the water is measured."),
    real<&P::density>("density", "1/scene unit", {0, 1e6}, "Slope of the linear fog."),
    real<&P::offset>("offset", "", {-1e6, 1e6},
                     "Taken off the linear fog; clear water up to offset / density."),
    color<&P::color>("color", "radiance", {0, 1e6}, "What the water itself looks like, linear."),
    real<&P::alpha>("alpha", "", {0, 1}, "Share of the linear fog that is blended in."),
    color<&P::absorption>("absorption", "1/scene unit", {0, 1e6},
                          "What the water swallows of the light; pure water by default."),
    color<&P::scattering>("scattering", "1/scene unit", {0, 1e6},
                          "What it throws elsewhere: murky water glows in the sun."),
    choice<&P::water_type, kWaterTypes>(
        "water_type", "Water by name: Jerlov's types replace absorption and the loss downwards."),
    real<&P::anisotropy>("anisotropy", "", {-0.99, 0.99},
                         "Mean cosine of the angle by which scattered light turns; 0 is evenly."),
    color<&P::ambient>("ambient", "radiance", {0, 1e6},
                       "Light from all around that is scattered besides the sun's."),
    choice<&P::sunlight, kSunlights>("sunlight", "The light's own way down to where it scatters."),
    choice<&P::crossing, kCrossings>("crossing",
                                     "What passing the surface does to light from below."),
};

constexpr Rgb<double> kBlack{0, 0, 0};

Rgb<double> absorption_of(const P& params) {
  if (params.water_type == WaterType::kCustom) return params.absorption;
  return water_optics(params.water_type).absorption;
}

}  // namespace

std::span<const Field<P>> DepthFog::fields() { return kFields; }

/// density 0 leaves every pixel as it is, unless a negative offset lifts the fog at distance 0.
bool DepthFog::neutral(const Params& p, StateSet) {
  if (p.model == Model::kLinear) return p.alpha == 0 || (p.density == 0 && p.offset >= 0);
  return p.water_type == WaterType::kCustom && p.absorption == kBlack && p.scattering == kBlack &&
         p.crossing == Crossing::kNone;
}

Rgb<double> DepthFog::extinction(const Params& params) {
  return absorption_of(params) + params.scattering;
}

DepthFog::Medium DepthFog::medium_of(const Params& params, const Context& c) {
  // A sun on the horizon gives the water no light, and would divide by 0.
  const double cosine = glm::dot(c.sun.direction, c.up);
  const bool day = c.has_sun && cosine > 1e-6;
  const double f_sun = day ? fresnel_exact(cosine, c.ior) : kDiffuseAirToWater;

  const bool custom = params.water_type == WaterType::kCustom;
  const Rgb<double> falling =
      custom || params.water_type == WaterType::kPure
          ? absorption_of(params) + (1 - params.anisotropy) * params.scattering
          : water_optics(params.water_type).down_attenuation;

  Medium m{};
  m.rate = extinction(params);
  m.ambient = params.scattering * params.ambient;
  m.to_sun = c.sun.direction;
  if (day) {
    const Rgb<double> facing = std::numbers::pi * params.scattering * c.sun.color;
    m.sun = facing;
    if (params.sunlight == Sunlight::kStraight) m.down = (1 / cosine) * falling;
    if (params.sunlight == Sunlight::kRefracted) {
      const double inside = refracted_cosine(cosine, 1 / c.ior);
      m.to_sun = (c.sun.direction - cosine * c.up) / c.ior + inside * c.up;
      m.down = (1 / inside) * falling;
      m.sun = ((1 - f_sun) * cosine / inside) * facing;
    }
  }
  const bool crosses = params.crossing == Crossing::kRadiance;
  m.bottom = crosses ? radiance_crossing(c.ior, f_sun) : 1;
  m.water = crosses ? radiance_crossing(c.ior, 0.0) : 1;
  m.glows = m.ambient != kBlack;
  m.sunlit = m.sun != kBlack;
  return m;
}

}  // namespace limpid
