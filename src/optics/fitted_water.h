#pragma once
#include <array>
#include <cstddef>

#include "limpid/core/color_space.h"
#include "limpid/core/vec.h"
#include "limpid/optics/water_types.h"

/// @file
/// Natural waters by their spectra, 400 ... 700 nm by 10 nm, and what they are for the red, green
/// and blue of a working space.

namespace limpid {

inline constexpr std::size_t kSpectrumSize = 31;
using Spectrum = std::array<double, kSpectrumSize>;
inline constexpr double wavelength_of(std::size_t i) { return 400 + 10 * static_cast<double>(i); }

/// A water by its name and what is mixed into it, as DepthFog::Params has them.
struct NamedWater {
  WaterType type;
  double murkiness = 0, sediment = 0, cdom = 0;
};

/// What a length of it takes and throws elsewhere, 1/m, for each wavelength.
struct WaterSpectra {
  Spectrum absorption{}, scattering{}, down_attenuation{};
};
/// Of the type alone: of kCustom nothing; as water_optics() and case_1_water() at other wavelengths
/// than theirs. Pope & Fry 1997; Jerlov 1976, table XXVII, which has every 25 nm; Prieur &
/// Sathyendranath 1981, "An Optical Classification of Coastal and Oceanic Waters Based on the
/// Specific Spectral Absorption Curves of Phytoplankton Pigments, Dissolved Organic Matter, and
/// Other Particulate Materials".
WaterSpectra spectra_of(const NamedWater& water);

/// How much each wavelength counts for red, green and blue of white light: their sums are 1. The
/// light is that of a black body of 6504 K, about daylight; the observer is that of CIE 1931 as
/// Wyman, Sloan & Shirley 2013, "Simple Analytic Approximations to the CIE XYZ Color Matching
/// Functions", has it. What the three show of other light is taken for the share of it that white
/// light shows, so that light and space need not have the same white.
Rgb<Spectrum> channel_weights(const Primaries& primaries);

/// What is left of white light after a way, of red, green and blue: what fitted_rates() fits.
Rgb<double> light_left(const Rgb<Spectrum>& weights, const Spectrum& rates, double way);

/// The rates s of red, green and blue by which exp(-s way) is nearest to light_left(): the integral
/// of the squared difference over the logarithm of the way, over all ways, is least. So no length
/// counts more than others but by what it shows of the difference. A spectrum that is the same for
/// all wavelengths is that rate for all channels, and an empty one 0.
Rgb<double> fitted_rates(const Rgb<Spectrum>& weights, const Spectrum& rates);

/// What is taken is fitted; what is thrown elsewhere is the mean of what white light meets, for it
/// is light that is to be right already where the way begins.
FittedWater fitted_water(const Primaries& primaries, const NamedWater& water);

}  // namespace limpid
