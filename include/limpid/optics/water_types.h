#pragma once
#include <cmath>
#include <cstddef>
#include <string_view>

#include "limpid/core/vec.h"

/// @file
/// Named water types: their absorption and scattering at 650, 550 and 450 nm, which stand for red,
/// green and blue of Rec.709. For other primaries the coefficients are fitted to spectra
/// (Scene::primaries).

namespace limpid {

/// Jerlov's types run from the clearest ocean (I) to III, then from clear coast (1C) to 9C.
enum class WaterType {
  kCustom,  ///< DepthFog::Params::absorption and scattering
  kPure,
  kJerlovI,
  kJerlovIA,
  kJerlovIB,
  kJerlovII,
  kJerlovIII,
  kJerlov1C,
  kJerlov3C,
  kJerlov5C,
  kJerlov7C,
  kJerlov9C,
  kCase1,  ///< by chlorophyll: case_1_water()
};

/// The words for WaterType, in its order.
inline constexpr std::string_view kWaterTypes[] = {
    "custom", "pure", "I", "IA", "IB", "II", "III", "1C", "3C", "5C", "7C", "9C", "case_1"};

struct WaterOptics {
  Rgb<double> absorption;        ///< a, 1/m
  Rgb<double> down_attenuation;  ///< K_d, 1/m: diffuse attenuation of daylight with depth
};

/// Absorption of pure water, 1/m. Pope & Fry 1997, "Absorption Spectrum (380-700 nm) of Pure Water.
/// II. Integrating Cavity Measurements".
inline constexpr Rgb<double> kPureWaterAbsorption{0.340, 0.0565, 0.00922};

namespace detail {
/// Gordon 1989, "Can the Lambert-Beer Law Be Applied to the Diffuse Attenuation Coefficient of
/// Ocean Water?": K_d = 1.0395 D0 (a + b_b). With the sun overhead (D0 = 1) and without backscatter
/// (b_b = 0), so murky types absorb slightly too much.
constexpr double absorption_from_down_attenuation(double k, double pure) {
  const double a = k / 1.0395;
  return a > pure ? a : pure;
}
}  // namespace detail

/// kPure: the absorption for both members, without its small scattering. Jerlov's types: K_d of
/// Jerlov 1976, "Marine Optics", and the absorption that belongs to it, at least that of pure
/// water. All zero for kCustom and kCase1, whose coefficients are parameters.
constexpr WaterOptics water_optics(WaterType type) {
  constexpr Rgb<double> kDownAttenuation[] = {
      {0, 0, 0},  // kCustom
      kPureWaterAbsorption,
      {.36, .063, .019},   // I
      {.37, .067, .026},   // IA
      {.375, .072, .036},  // IB
      {.40, .089, .068},   // II
      {.445, .120, .135},  // III
      {.45, .12, .25},     // 1C
      {.46, .19, .39},     // 3C
      {.54, .30, .56},     // 5C
      {.63, .46, .89},     // 7C
      {.76, .63, 1.60},    // 9C
      {0, 0, 0},           // kCase1
  };
  const Rgb<double> k = kDownAttenuation[static_cast<std::size_t>(type)];
  const bool typed = type >= WaterType::kJerlovI && type <= WaterType::kJerlov9C;
  if (!typed) return {k, k};
  const Rgb<double> pure = kPureWaterAbsorption;
  return {{detail::absorption_from_down_attenuation(k.r, pure.r),
           detail::absorption_from_down_attenuation(k.g, pure.g),
           detail::absorption_from_down_attenuation(k.b, pure.b)},
          k};
}

/// Absorption and scattering coefficients of water, 1/m.
struct WaterCoefficients {
  Rgb<double> absorption, scattering;
};

/// The same at one wavelength.
struct WaterCoefficientsAt {
  double absorption, scattering;
};

/// Case 1 waters (Morel & Prieur 1977, "Analysis of variations in ocean color"): algae make them
/// murky and green. `murkiness` 0 ... 1 is chlorophyll C = .03 ... 30 mg/m^3, ten times as much for
/// each third: the clearest oceans, coasts, a pond in bloom. Mobley 1994, "Light and Water", at a
/// wavelength l in nm, where pure water absorbs a_pure and chlorophyll A(l) times as much as at 440
/// nm:
///
///     a = (a_pure + .06 A(l) C^.65) (1 + .2 exp(-.014 (l - 440)))  Prieur & Sathyendranath 1981
///     b = b_pure + .3 C^.62 550 / l                                Gordon & Morel 1983
///     b_pure = .00758 (400 / l)^4.32                               Morel 1974, of sea water
inline WaterCoefficientsAt case_1_water_at(double wavelength, double pure, double of_chlorophyll,
                                           double murkiness) {
  const double chlorophyll = 0.03 * std::pow(1000, murkiness);
  const double absorbs = 0.06 * std::pow(chlorophyll, 0.65);
  const double scatters = 0.3 * std::pow(chlorophyll, 0.62);
  return {(pure + absorbs * of_chlorophyll) * (1 + 0.2 * std::exp(-0.014 * (wavelength - 440))),
          0.00758 * std::pow(400 / wavelength, 4.32) + scatters * 550 / wavelength};
}

/// Coefficients that `grams` of mineral sediment per cubic metre add: scattering that is nearly the
/// same for all wavelengths (Babin et al. 2003, "Light Scattering Properties of Marine Particles in
/// Coastal and Open Ocean Waters as Related to the Particle Mass Concentration"), and absorption
/// that is 1/12 of it at 443 nm (Babin et al. 2003, "Variations in the Light Absorption
/// Coefficients of Phytoplankton, Nonalgal Particles, and Dissolved Organic Matter in Coastal
/// Waters Around Europe").
inline WaterCoefficientsAt sediment_water_at(double wavelength, double grams) {
  return {0.041 * grams * std::exp(-0.0123 * (wavelength - 443)), 0.5 * grams};
}

/// Absorption, 1/m, of dissolved organic matter (CDOM: humus, yellow substance), from its
/// absorption at 440 nm. Bricaud, Morel & Prieur 1981, "Absorption by Dissolved Organic Matter of
/// the Sea (Yellow Substance) in the UV and Visible Domains".
inline double cdom_absorption_at(double wavelength, double at_440) {
  return at_440 * std::exp(-0.014 * (wavelength - 440));
}

namespace detail {
constexpr WaterCoefficients of_channels(const WaterCoefficientsAt& r, const WaterCoefficientsAt& g,
                                        const WaterCoefficientsAt& b) {
  return {{r.absorption, g.absorption, b.absorption}, {r.scattering, g.scattering, b.scattering}};
}
}  // namespace detail

/// The three functions above at 650, 550 and 450 nm.
inline WaterCoefficients case_1_water(double murkiness) {
  const Rgb<double>& pure = kPureWaterAbsorption;
  return detail::of_channels(case_1_water_at(650, pure.r, 0.356, murkiness),
                             case_1_water_at(550, pure.g, 0.357, murkiness),
                             case_1_water_at(450, pure.b, 0.944, murkiness));
}
inline WaterCoefficients sediment_water(double grams) {
  return detail::of_channels(sediment_water_at(650, grams), sediment_water_at(550, grams),
                             sediment_water_at(450, grams));
}
inline Rgb<double> cdom_absorption(double at_440) {
  return {cdom_absorption_at(650, at_440), cdom_absorption_at(550, at_440),
          cdom_absorption_at(450, at_440)};
}

/// A named water type and its additions, fitted to other primaries than Rec.709.
struct FittedWater {
  WaterCoefficients type;        ///< scattering of kCase1 alone; of kCustom nothing
  Rgb<double> down_attenuation;  ///< of Jerlov's types
  WaterCoefficients additions;   ///< sediment and dissolved organic matter
};

}  // namespace limpid
