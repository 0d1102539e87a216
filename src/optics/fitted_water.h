#pragma once
#include <array>
#include <cstddef>

#include "limpid/core/color_space.h"
#include "limpid/core/vec.h"
#include "limpid/optics/water_types.h"

/// @file
/// Natural waters by their spectra, 400 ... 700 nm by 10 nm, and their coefficients for the red,
/// green and blue of a working space.

namespace limpid {

inline constexpr std::size_t kSpectrumSize = 31;
using Spectrum = std::array<double, kSpectrumSize>;
inline constexpr double wavelength_of(std::size_t i) { return 400 + 10 * static_cast<double>(i); }

/// A water type and the substances mixed into it, as DepthFog::Params has them.
struct NamedWater {
  WaterType type;
  double murkiness = 0, sediment = 0, cdom = 0;
};

/// Absorption and scattering per length, 1/m, for each wavelength.
struct WaterSpectra {
  Spectrum absorption{}, scattering{}, down_attenuation{};
};
/// The spectra of the type alone: 0 for kCustom; those of water_optics() and case_1_water() for
/// other wavelengths than theirs. Pope & Fry 1997; Jerlov 1976, table XXVII, which has every 25 nm;
/// Prieur & Sathyendranath 1981, "An Optical Classification of Coastal and Oceanic Waters Based on
/// the Specific Spectral Absorption Curves of Phytoplankton Pigments, Dissolved Organic Matter, and
/// Other Particulate Materials".
WaterSpectra spectra_of(const NamedWater& water);

/// The weight of each wavelength in red, green and blue of white light: the sums are 1. The light
/// is that of a black body of 6504 K, about daylight; the observer is CIE 1931 as fitted by Wyman,
/// Sloan & Shirley 2013, "Simple Analytic Approximations to the CIE XYZ Color Matching Functions".
/// Other light counts as its share of the white light in each channel, so that light and space need
/// not have the same white.
Rgb<Spectrum> channel_weights(const Primaries& primaries);

/// Red, green and blue left of white light after a path: the curve that fitted_rates() fits.
Rgb<double> light_left(const Rgb<Spectrum>& weights, const Spectrum& rates, double distance);

/// The rates s of red, green and blue by which exp(-s path) is nearest to light_left(): the
/// integral of the squared difference over the logarithm of the path, over all paths, is least. So
/// each length counts only by the difference that it shows. A spectrum equal at all wavelengths
/// gives its rate for all channels, and an empty one 0.
Rgb<double> fitted_rates(const Rgb<Spectrum>& weights, const Spectrum& rates);

/// Absorption is fitted. Scattering is its mean over white light, because in-scatter must be right
/// already where the path begins.
FittedWater fitted_water(const Primaries& primaries, const NamedWater& water);

}  // namespace limpid
