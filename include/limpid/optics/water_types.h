#pragma once
#include <cstddef>
#include <string_view>

#include "limpid/core/vec.h"

/// @file
/// Waters by name: how much light they take, at 650, 550 and 450 nm.

namespace limpid {

/// Jerlov's types run from the clearest ocean (I) to III, then from clear coast (1C) to 9C.
enum class WaterType {
  kCustom,  ///< numbers of one's own
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
};

/// The words for WaterType, in its order.
inline constexpr std::string_view kWaterTypes[] = {"custom", "pure", "I",  "IA", "IB", "II",
                                                   "III",    "1C",   "3C", "5C", "7C", "9C"};

struct WaterOptics {
  Rgb<double> absorption;        ///< a, 1/m: taken from a ray
  Rgb<double> down_attenuation;  ///< K_d, 1/m: how light from above fades with depth
};

/// Absorption of pure water, 1/m. Pope & Fry 1997, "Absorption Spectrum (380-700 nm) of Pure Water.
/// II. Integrating Cavity Measurements".
inline constexpr Rgb<double> kPureWaterAbsorption{0.340, 0.0565, 0.00922};

namespace detail {
/// Gordon 1989, "Can the Lambert-Beer Law Be Applied to the Diffuse Attenuation Coefficient of
/// Ocean Water?": K_d = 1.0395 D0 (a + b_b). With the sun overhead (D0 = 1) and what is scattered
/// back (b_b) left out, so murky types come out a little too absorbing.
constexpr double absorption_from_down_attenuation(double k, double pure) {
  const double a = k / 1.0395;
  return a > pure ? a : pure;
}
}  // namespace detail

/// kPure: absorption for both, its little scattering left out. The types: K_d of Jerlov 1976,
/// "Marine Optics", and the absorption that goes with it, never below that of pure water. kCustom
/// is zero throughout: its numbers are elsewhere.
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
  };
  const Rgb<double> k = kDownAttenuation[static_cast<std::size_t>(type)];
  if (type == WaterType::kCustom || type == WaterType::kPure) return {k, k};
  const Rgb<double> pure = kPureWaterAbsorption;
  return {{detail::absorption_from_down_attenuation(k.r, pure.r),
           detail::absorption_from_down_attenuation(k.g, pure.g),
           detail::absorption_from_down_attenuation(k.b, pure.b)},
          k};
}

}  // namespace limpid
