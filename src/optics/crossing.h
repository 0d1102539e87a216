#pragma once
#include "limpid/core/number.h"

/// @file
/// Radiance that crosses the surface downwards and upwards.

namespace limpid {

/// Share of even light from a half sphere that a flat surface of index 1.333 reflects, from above
/// and from below: fresnel_exact over all directions, weighted by the cosine. Walsh 1926, "The
/// Reflection Factor of a Polished Glass Surface for Diffused Light". The two satisfy (1 - 0.0664)
/// / 1.333^2 = 1 - 0.4746.
inline constexpr double kDiffuseAirToWater = 0.0664;
inline constexpr double kDiffuseWaterToAir = 0.4746;

/// Radiance of a bottom that the sun lights through the surface, seen through it from the air, over
/// its radiance without water: (1 - f_sun) / ior^2. f_sun is the reflectance towards the sun; the
/// viewer's own 1 - F and absorption are separate factors. The n^2 is a narrow cone below that
/// widens above (Preisendorfer 1976, "Hydrologic Optics"). Light that the surface reflects back
/// down to the bottom is left out: a bottom of albedo rho is brighter by 1 / (1 - 0.4746 rho).
template <class F>
LIMPID_INLINE F radiance_crossing(F ior, F f_sun) {
  return (F(1) - f_sun) / (ior * ior);
}

}  // namespace limpid
