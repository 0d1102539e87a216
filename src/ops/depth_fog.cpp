#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "ops/depth_fog_kernel.h"
#include "ops/water_light.h"
#include "optics/fitted_water.h"

namespace limpid {
namespace {

using P = DepthFog::Params;

constexpr std::string_view kModels[] = {"linear", "beer_lambert", "radiative_transfer"};
constexpr std::string_view kDistances[] = {"eye", "ray", "refracted"};
constexpr std::string_view kSunlights[] = {"none", "straight", "refracted"};
constexpr std::string_view kCrossings[] = {"none", "radiance"};

constexpr Field<P> kFields[] = {
    choice<&P::model, kModels>("model", "Model of absorption and scattering."),
    choice<&P::distance, kDistances>("distance", "Measure of the path length in the water."),
    real<&P::density>("density", "1/scene unit", {0, 1e6}, "Slope of the linear fog.")
        .when("model", {"linear"}),
    real<&P::offset>("offset", "", {-1e6, 1e6},
                     "Offset of the linear fog: clear water up to offset / density.")
        .when("model", {"linear"}),
    color<&P::color>("color", "radiance", {0, 1e6}, "Color of the linear fog.")
        .when("model", {"linear"}),
    real<&P::alpha>("alpha", "", {0, 1}, "Opacity of the linear fog.").when("model", {"linear"}),
    color<&P::absorption>("absorption", "1/scene unit", {0, 1e6},
                          "Absorption coefficient; default: pure water.")
        .when("model", {"beer_lambert", "radiative_transfer"})
        .brings("water_type", "custom"),
    color<&P::scattering>("scattering", "1/scene unit", {0, 1e6},
                          "Scattering coefficient: murky water is bright in the sun.")
        .when("model", {"beer_lambert", "radiative_transfer"})
        .when("water_type",
              {"custom", "pure", "I", "IA", "IB", "II", "III", "1C", "3C", "5C", "7C", "9C"}),
    real<&P::murkiness>("murkiness", "", {0, 1},
                        "Chlorophyll of natural water: 0 is the clearest ocean, 1 a pond in bloom.")
        .when("model", {"beer_lambert", "radiative_transfer"})
        .brings("water_type", "case_1"),
    real<&P::sediment>("sediment", "g/m^3", {0, 10000},
                       "Additional mineral grains: they scatter light back, so that water is "
                       "brighter and hides the bottom.")
        .when("model", {"beer_lambert", "radiative_transfer"}),
    real<&P::cdom>(
        "cdom", "1/scene unit", {0, 1000},
        "Additional dissolved humus, by its absorption at 440 nm: yellow, then brown and dark.")
        .when("model", {"beer_lambert", "radiative_transfer"}),
    choice<&P::water_type, kWaterTypes>(
        "water_type",
        "Type of water: Jerlov's types replace absorption and, for beer_lambert, downward "
        "attenuation; case_1 replaces absorption and scattering by murkiness.")
        .when("model", {"beer_lambert", "radiative_transfer"}),
    real<&P::anisotropy>("anisotropy", "", {-0.99, 0.99},
                         "Mean cosine of the scattering angle; 0 is isotropic.")
        .when("model", {"beer_lambert", "radiative_transfer"}),
    color<&P::ambient>("ambient", "radiance", {0, 1e6},
                       "Ambient light besides the sun's; for radiative_transfer the sky's light, "
                       "if neither environment, scene nor visible sky give it.")
        .when("model", {"beer_lambert", "radiative_transfer"}),
    choice<&P::sunlight, kSunlights>("sunlight",
                                     "Path of the sunlight down to the point of scattering.")
        .when("model", {"beer_lambert", "radiative_transfer"}),
    choice<&P::crossing, kCrossings>("crossing", "Change of the light from below at the surface.")
        .when("model", {"beer_lambert", "radiative_transfer"}),
};

constexpr Rgb<double> kBlack{0, 0, 0};

double largest(const Rgb<double>& c) { return std::max({c.r, c.g, c.b}); }

/// The largest of of(channel) over the channels, where channel(color) selects from a color.
template <class Of>
double largest_of(Of&& of) {
  return std::max({of([](const Rgb<double>& c) { return c.r; }),
                   of([](const Rgb<double>& c) { return c.g; }),
                   of([](const Rgb<double>& c) { return c.b; })});
}

/// Largest difference between a color and the colors looked up.
double apart(const Rgb<double>& color, const Ranges& ranges) {
  const auto of = [](double c, const Range& seen) { return std::max(c - seen.min, seen.max - c); };
  return std::max(
      {of(color.r, ranges.color[0]), of(color.g, ranges.color[1]), of(color.b, ranges.color[2])});
}

/// Share that survives a path; 0 where it rounds to 0 in float.
double survives(double rate, double distance) {
  const double tau = bound_product(rate, distance);
  return tau > 104.5 ? 0 : std::exp(-tau);
}

/// An upper bound of column_light.
double column(double rate, double length) { return rate > 0 ? std::min(length, 1 / rate) : length; }

/// The share of linear fog in front of the end of a path.
double veil(const P& params, double distance) {
  return params.alpha * (1 - linear_fog(distance, params.density, params.offset));
}

}  // namespace

std::span<const Field<P>> DepthFog::fields() { return kFields; }

/// Density 0 leaves every pixel unchanged, unless a negative offset lifts the fog at distance 0.
bool Kernel<DepthFog>::neutral(const Params& p, StateSet) {
  if (p.model == Model::kLinear) return p.alpha == 0 || (p.density == 0 && p.offset >= 0);
  return p.water_type == WaterType::kCustom && absorption(p) == kBlack && scattering(p) == kBlack &&
         p.crossing == Crossing::kNone;
}

void Kernel<DepthFog>::work_in(const Primaries& primaries, Params& p) {
  p.fitted.reset();
  if (agree(primaries, kRec709)) return;
  p.fitted = fitted_water(primaries, {p.water_type, p.murkiness, p.sediment, p.cdom});
}

WaterCoefficients Kernel<DepthFog>::additions(const Params& params) {
  if (params.fitted) return params.fitted->additions;
  WaterCoefficients water = sediment_water(params.sediment);
  water.absorption = water.absorption + cdom_absorption(params.cdom);
  return water;
}

Rgb<double> Kernel<DepthFog>::absorption(const Params& params) {
  const auto of_type = [&] {
    if (params.water_type == WaterType::kCustom) return params.absorption;
    if (params.fitted) return params.fitted->type.absorption;
    if (params.water_type == WaterType::kCase1) return case_1_water(params.murkiness).absorption;
    return water_optics(params.water_type).absorption;
  };
  return of_type() + additions(params).absorption;
}

Rgb<double> Kernel<DepthFog>::scattering(const Params& params) {
  const auto of_type = [&] {
    if (params.water_type != WaterType::kCase1) return params.scattering;
    if (params.fitted) return params.fitted->type.scattering;
    return case_1_water(params.murkiness).scattering;
  };
  return of_type() + additions(params).scattering;
}

Rgb<double> Kernel<DepthFog>::extinction(const Params& params) {
  const bool transfers = params.model == Model::kRadiativeTransfer;
  const double wide = transfers ? 1 - narrow_share(params.anisotropy) : 1;
  return absorption(params) + wide * scattering(params);
}

bool Kernel<DepthFog>::wants_scattered_light(const P& params) {
  return params.model == Model::kRadiativeTransfer &&
         (scattering(params) != kBlack || params.crossing == Crossing::kRadiance);
}

double Kernel<DepthFog>::lit_depth(const P& params, const Pass& c) {
  return 1 / std::max(extinction(params).g + water_light(params, c, c.ior).down.g, 1e-6);
}

ScatteringWater Kernel<DepthFog>::scattering_water(const P& params, const Pass& c) {
  const WaterLight light = water_light(params, c, c.ior);
  return {.absorption = absorption(params),
          .scattering = scattering(params),
          .anisotropy = params.anisotropy,
          .beam = light.day ? glm::dot(light.to_sun, c.up) : 1,
          .ior = c.ior,
          .surface = params.crossing == Crossing::kRadiance,
          .inside = c.submersible};
}

double Kernel<DepthFog>::bound(const P& params, const Pass& c, const Ranges& ranges) {
  const double distance = ranges.fog_path.max, bright = ranges.brightest();
  if (params.model == Model::kLinear) {
    return bound_product(veil(params, distance), apart(params.color, ranges));
  }
  const WaterMedium m = medium_of(params, c);
  const double sun = m.water * brightest_phase(params, c, m);
  return largest_of([&](auto part) {
           const double taken = 1 - m.bottom * survives(part(m.rate) + part(m.down), distance);
           return bound_product(taken, bright) + bound_product(part(m.ambient) + sun * part(m.sun),
                                                               column(part(m.rate), distance));
         }) +
         most_multiple(m, distance);
}

void Kernel<DepthFog>::propagate_ranges(const P& params, const Pass& c, Ranges& ranges) {
  // With refraction, hit and path are those of refraction; else those of the pixel.
  Range path = c.made.has(StatePart::kPosition) ? ranges.hit : ranges.own;
  if (params.distance == Distance::kRefracted && c.made.has(StatePart::kPosition)) {
    path = ranges.path;
  } else if (params.distance == Distance::kRefracted) {
    const auto bent = [&](double cosine) {
      return cosine / std::max(refracted_cosine(cosine, 1 / c.ior), 1e-6);
    };
    const Range cosine = ranges.cosine();
    path = {bound_product(path.min, bent(std::max(cosine.min - 1e-6, 0.0))),
            bound_product(path.max, ranges.ray_length.max * bent(cosine.max))};
  } else if (params.distance == Distance::kRay) {
    path = {path.min * ranges.ray_length.min, bound_product(path.max, ranges.ray_length.max)};
  }
  ranges.fog_path = {0.999 * path.min, 1.001 * path.max};  // float rounds them

  const double bright = ranges.brightest();
  if (params.model == Model::kLinear) {
    ranges.transmittance = 1 - veil(params, ranges.fog_path.min);
    ranges.light = std::max({ranges.light, bright, largest(params.color)});
    return;
  }
  const WaterMedium m = medium_of(params, c);
  const double sun = m.water * brightest_phase(params, c, m);
  const auto sun_of = [&](auto part) {
    return bound_product(sun * part(m.sun), column(part(m.rate), ranges.fog_path.max));
  };
  ranges.transmittance =
      largest_of([&](auto part) { return m.bottom * survives(part(m.rate), ranges.fog_path.min); });
  if (m.multiple && c.planes.has(PlaneId::kShadow)) {
    const std::array<double, 3> rates = m.rates(), beams = m.beams(), skies = m.skies();
    for (std::size_t i = 0; i < 3; ++i) {
      const ScatteredLight& light = m.multiple[i];
      const double most =
          m.water * (beams[i] * light.most_bottom_sun + skies[i] * light.most_bottom_sky);
      ranges.detail = std::max(ranges.detail, survives(rates[i], ranges.fog_path.min) *
                                                  (1.05 * most + m.dry_skies()[i]));
    }
  }
  const double multiple = most_multiple(m, ranges.fog_path.max);
  ranges.sun_light = largest_of(sun_of) + multiple;
  ranges.sun_far = largest_of([&](auto part) {
    const double tau = bound_product(part(m.rate), ranges.fog_path.min);
    return bound_product(sun_of(part), tau > 2 ? 1 / tau : 0.5);
  });
  ranges.sun_far += multiple;
  ranges.light = std::max(
      ranges.light,
      largest_of([&](auto part) {
        return bright + bound_product(part(m.ambient), column(part(m.rate), ranges.fog_path.max)) +
               sun_of(part);
      }) + multiple);
}

double Kernel<DepthFog>::beyond(const P& params, const Pass& c, const Ranges& ranges) {
  const double distance = ranges.fog_path.min, bright = ranges.brightest();
  if (params.model == Model::kLinear) {
    const double full = veil(params, HUGE_VAL);
    return bound_product(1 - full, ranges.contrast()) +
           bound_product(full - veil(params, distance), apart(params.color, ranges));
  }
  const WaterMedium m = medium_of(params, c);
  const double sun = m.water * brightest_phase(params, c, m);
  return largest_of([&](auto part) {
           const double rate = part(m.rate);
           if (survives(rate, 3e38) > 0) return HUGE_VAL;  // no path is endless in float
           const double left = survives(rate, distance);
           return bound_product(left, m.bottom * bright) +
                  left / rate * (part(m.ambient) + sun * part(m.sun));
         }) +
         beyond_multiple(m, distance * refracted_cosine(0.0, 1 / c.ior));
}

/// Each layer stands for all that are deeper.
double Kernel<DepthFog>::beyond_multiple(const WaterMedium& m, double depth) {
  if (!m.multiple) return 0;
  double most = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double layers = std::log2(m.rates()[i] * depth / ScatteredLight::kFirstLayer);
    if (!(layers >= 0)) return HUGE_VAL;
    const auto layer = static_cast<std::size_t>(std::min(layers, ScatteredLight::kLayers - 1.0));
    const ScatteredLight& light = m.multiple[i];
    // Sunlight may fall with less loss than the layers say.
    const double down = std::array{m.down.r, m.down.g, m.down.b}[i];
    const double cosine = std::max(m.cosine, 0.02);
    const double fallen = down < m.rates()[i] / cosine ? m.cosine * std::exp(-down * depth) : 0;
    most = std::max(most, m.water * (m.beams()[i] * (light.beyond_sun[layer] +
                                                     fallen * light.beyond_bottom[layer]) +
                                     m.skies()[i] * light.beyond_sky[layer]));
  }
  return most;
}

double Kernel<DepthFog>::most_multiple(const WaterMedium& m, double distance) {
  if (!m.multiple) return 0;
  double most = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const ScatteredLight& light = m.multiple[i];
    const double depth = bound_product(m.rates()[i], distance);
    const auto up_to = [&](double slope, double all) {
      return std::min(bound_product(slope, depth), all);
    };
    const double of_sun = up_to(light.slope_sun, light.most_sun) + light.most_bottom_sun;
    const double of_sky = up_to(light.slope_sky, light.most_sky) + light.most_bottom_sky;
    most = std::max(most, m.water * (m.beams()[i] * of_sun + m.skies()[i] * of_sky));
  }
  return 1.05 * most;  // for the error of the fits
}

/// The largest value of the phase function: views go down into the water at least as steeply as
/// refraction leads them, and the sun stands above it.
double Kernel<DepthFog>::brightest_phase(const P& params, const Pass& c, const WaterMedium& m) {
  if (!m.sunlit) return 0;
  const double sink = refracted_cosine(0.0, 1 / c.ior);
  const double rise = glm::dot(m.to_sun, c.up);
  const double level = std::sqrt(std::max((1 - sink * sink) * (1 - rise * rise), 0.0));
  const double least = params.anisotropy < 0 ? -1 : level - sink * rise;
  return henyey_greenstein(least, params.anisotropy) * 1.0001;
}

std::optional<WaterMedium> Kernel<DepthFog>::medium(const Params& params, const Pass& c) {
  if (params.model == Model::kLinear) return {};
  return medium_of(params, c);
}

WaterMedium Kernel<DepthFog>::medium_of(const Params& params, const Pass& c) {
  const WaterLight light = water_light(params, c, c.ior);
  WaterMedium m{};
  m.anisotropy = params.anisotropy;
  m.rate = extinction(params);
  m.down = light.down;
  m.ambient = scattering(params) * params.ambient;
  m.cosine = light.day ? std::clamp(glm::dot(light.to_sun, c.up), 0.0, 1.0) : 1;
  if (wants_scattered_light(params) && c.scattered_light) {
    const double above = glm::dot(c.sun.direction, c.up);
    m.multiple = c.scattered_light;
    m.ambient = kBlack;
    m.beam = light.beam;
    // Light that the surface transmits keeps its radiance over the square of the index.
    m.sky = (params.crossing == Crossing::kRadiance ? c.ior * c.ior : 1) *
            (c.has_sky ? c.sky : params.ambient);
    m.dry_sun = (light.bottom * (light.day ? above : 0)) * c.sun.color;
    m.dry_sky = light.bottom * (c.has_sky ? c.sky : params.ambient);
    m.per_bottom = light.bottom > 0 ? 1 / light.bottom : 0;
    m.square = params.anisotropy * params.anisotropy;
    m.scatters = scattering(params) != kBlack;
    m.turns = params.anisotropy != 0;
    m.inside = c.submersible;
  }
  m.sun = light.sun;
  m.to_sun = light.to_sun;
  m.bottom = light.bottom;
  m.water = light.water;
  m.glows = m.ambient != kBlack;
  m.sunlit = m.sun != kBlack;
  return m;
}

PathMeasure Kernel<DepthFog>::path_measure(const P& params) {
  PathMeasure measure{.along_axis = params.distance == Distance::kEye, .ends = {}};
  if (params.model != Model::kLinear) {
    measure.extinction = extinction(params);
  } else if (params.density > 0) {
    measure.ends = (1 + std::max(params.offset, 0.0)) / params.density;
  }
  return measure;
}

}  // namespace limpid
