#pragma once
#include "limpid/core/number.h"

/// @file
/// The luminance of a clear sky: the standard clear sky, type 12 of CIE S 011:2003, "Spatial
/// Distribution of Daylight - CIE Standard General Sky", as the logarithms of its two factors,
/// without exponentials and angles.

namespace limpid {

/// By elevation, whose sine is in 0 ... 1: log(1 - exp(-.32 / sine)), within .033. 0 at the
/// horizon, -1.27 at the zenith.
template <class F>
LIMPID_INLINE F clear_sky_by_elevation(F sine) {
  constexpr double kHalf = 0.28, kZenith = -1.27;
  const F square = sine * sine;
  return F(kZenith * (1 + kHalf)) * square / (square + F(kHalf));
}

/// By the angle x to the sun, whose cosine is in -1 ... 1: log(1 + 10 (exp(-3 x) - exp(-3 pi / 2))
/// + .45 cosine^2), within .01 up to a right angle; 0 beyond it, where that rises to .31 again.
template <class F>
LIMPID_INLINE F clear_sky_by_sun(F cosine) {
  constexpr double kAtSun = 2.43, kEnd = 1.46, kPower = 1.6;
  const F apart = sqrt(max(F(2) - F(2) * cosine, F(0)));  // of the unit vectors
  return F(kAtSun) * pow(max(F(1) - F(1 / kEnd) * apart, F(0)), kPower);
}

}  // namespace limpid
