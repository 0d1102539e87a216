#pragma once
#include <cmath>

#include "limpid/core/vec.h"

namespace limpid {

/// The wavelengths, in micrometres, that represent the three channels where water differs by
/// wavelength.
constexpr double kRedWavelength = 0.650;
constexpr double kGreenWavelength = 0.550;
constexpr double kBlueWavelength = 0.450;

/// Index of refraction of pure water at 20 C, by the wavelength in micrometres, 0.182 ... 1.129.
/// Daimon & Masumura 2007, "Measurement of the Refractive Index of Distilled Water from the
/// Near-Infrared Region to the Ultraviolet Region". Sea water has about 0.006 more.
inline double water_index(double wavelength) {
  const double square = wavelength * wavelength;
  const double sum = 0.5684027565 * square / (square - 0.005101829712) +
                     0.1726177391 * square / (square - 0.01821153936) +
                     0.02086189578 * square / (square - 0.02620722293) +
                     0.1130748688 * square / (square - 10.69792721);
  return std::sqrt(1 + sum);
}

/// 1.33167, 1.33468, 1.33961 for red, green and blue.
inline Rgb<double> water_index_rgb() {
  return {water_index(kRedWavelength), water_index(kGreenWavelength), water_index(kBlueWavelength)};
}

}  // namespace limpid
