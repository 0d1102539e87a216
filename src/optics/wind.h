#pragma once
#include <cmath>
#include <numbers>

#include "limpid/core/number.h"

/// @file
/// The effect of wind on open water. Winds are in m/s, 12.5 m over the water (10 m is within 3 %).

namespace limpid {

/// Mean squares of the slopes of the surface along the wind and across it.
struct WindSlopes {
  double along = 0, across = 0;
};

/// Slopes of a clean sea, ripples included; together nearly .003 + .00512 wind. Measured at 1 to 14
/// m/s, each to within .004. Cox & Munk 1954, "Measurement of the Roughness of the Sea Surface from
/// Photographs of the Sun's Glitter".
LIMPID_INLINE WindSlopes wind_slopes(double wind) {
  return {0.00316 * wind, 0.003 + 0.00192 * wind};
}

/// Phase speed, m/s, of waves of this length in m on deep water, driven by gravity and surface
/// tension. Lamb 1932, "Hydrodynamics".
LIMPID_INLINE double phase_speed(double length) {
  constexpr double kGravity = 9.81;    // m/s^2
  constexpr double kTension = 7.3e-5;  // surface tension over density at 20 C, m^3/s^2
  const double k = 2 * std::numbers::pi / length;
  return std::sqrt(kGravity / k + kTension * k);
}

/// Speed, m/s, at which the wind moves the water's skin, far from the shore. Wu 1975, "Wind-Induced
/// Drift Currents".
LIMPID_INLINE double skin_drift(double wind) { return 0.035 * wind; }

}  // namespace limpid
