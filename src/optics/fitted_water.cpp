#include "optics/fitted_water.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace limpid {
namespace {

// Pope & Fry 1997, 1/m.
constexpr Spectrum kPure = {.00663, .00473, .00454, .00495, .00635, .00922, .00979, .0106,
                            .0127,  .0150,  .0204,  .0325,  .0409,  .0434,  .0474,  .0565,
                            .0619,  .0695,  .0896,  .1351,  .2224,  .2644,  .2755,  .2916,
                            .3108,  .340,   .410,   .439,   .465,   .516,   .624};

// Prieur & Sathyendranath 1981: absorption of chlorophyll, over its value at 440 nm.
constexpr Spectrum kChlorophyll = {.687, .828, .913, .973, 1,    .944, .917, .870, .798, .750, .668,
                                   .618, .528, .474, .416, .357, .294, .276, .291, .282, .236, .252,
                                   .276, .317, .334, .356, .441, .595, .502, .329, .215};

// Jerlov 1976: K_d of his water types, 400 ... 700 nm by 25 nm, 1/m.
constexpr std::size_t kJerlovSize = 13;
constexpr double kJerlov[][kJerlovSize] = {
    {.028, .022, .019, .018, .027, .043, .063, .089, .235, .305, .36, .42, .56},    // I
    {.038, .031, .026, .025, .032, .048, .067, .094, .24, .31, .37, .43, .57},      // IA
    {.051, .042, .036, .033, .042, .054, .072, .099, .245, .315, .375, .435, .58},  // IB
    {.096, .081, .068, .062, .070, .076, .089, .115, .26, .335, .40, .465, .61},    // II
    {.185, .160, .135, .116, .115, .116, .120, .148, .295, .375, .445, .520, .66},  // III
    {.51, .36, .25, .17, .14, .13, .12, .15, .30, .37, .45, .51, .65},              // 1C
    {.78, .54, .39, .29, .22, .20, .19, .21, .33, .40, .46, .56, .71},              // 3C
    {1.10, .78, .56, .43, .36, .31, .30, .33, .40, .48, .54, .65, .80},             // 5C
    {1.60, 1.20, .89, .71, .58, .49, .46, .46, .48, .54, .63, .78, .92},            // 7C
    {2.40, 1.90, 1.60, 1.23, .99, .78, .63, .58, .60, .65, .76, .92, 1.10},         // 9C
};

bool is_typed(WaterType type) {
  return type >= WaterType::kJerlovI && type <= WaterType::kJerlov9C;
}

double jerlov_at(WaterType type, double wavelength) {
  const auto& table =
      kJerlov[static_cast<std::size_t>(type) - static_cast<std::size_t>(WaterType::kJerlovI)];
  const double place = (wavelength - 400) / 25;
  const auto before = std::min(static_cast<std::size_t>(place), kJerlovSize - 2);
  return std::lerp(table[before], table[before + 1], place - static_cast<double>(before));
}

template <class Of>
Spectrum spectrum(Of&& of) {
  Spectrum s;
  for (std::size_t i = 0; i < kSpectrumSize; ++i) s[i] = of(i, wavelength_of(i));
  return s;
}

/// A Gaussian lobe with a peak and a width on each side of it, as in Wyman et al.
double lobe(double wavelength, double peak, double per_left, double per_right) {
  const double t = (wavelength - peak) * (wavelength < peak ? per_left : per_right);
  return std::exp(-0.5 * t * t);
}

/// The CIE observer: X, Y and Z.
glm::dvec3 observer(double l) {
  return {1.056 * lobe(l, 599.8, .0264, .0323) + .362 * lobe(l, 442.0, .0624, .0374) -
              .065 * lobe(l, 501.1, .0490, .0382),
          .821 * lobe(l, 568.8, .0213, .0247) + .286 * lobe(l, 530.9, .0613, .0322),
          1.217 * lobe(l, 437.0, .0845, .0278) + .681 * lobe(l, 459.0, .0385, .0725)};
}

/// Planck's law at 6504 K, over its value at 550 nm.
double daylight(double l) {
  constexpr double kSecond = 1.4388e7;  // h c / k, in nm K
  const auto radiance = [](double at) {
    return std::pow(at / 550, -5) / std::expm1(kSecond / (at * 6504));
  };
  return radiance(l) / radiance(550);
}

/// Calls of(weights, channel of the result) for each channel.
template <class Of>
Rgb<double> each(const Rgb<Spectrum>& weights, Of&& of) {
  return {of(weights.r), of(weights.g), of(weights.b)};
}

double weighted(const Spectrum& weights, const Spectrum& values) {
  return std::inner_product(weights.begin(), weights.end(), values.begin(), 0.0);
}

double left_of(const Spectrum& weights, const Spectrum& rates, double distance) {
  double left = 0;
  for (std::size_t i = 0; i < kSpectrumSize; ++i)
    left += weights[i] * std::exp(-rates[i] * distance);
  return left;
}

/// The minimum of `of` in an interval, in which it falls up to the minimum and rises beyond it: by
/// the golden section, to a part in 1e9 of the interval.
template <class Of>
double least(double low, double high, Of&& of) {
  constexpr double kGolden = 0.6180339887498949;
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  double at_a = of(a), at_b = of(b);
  for (int i = 0; i < 44; ++i) {
    const bool left = at_a < at_b;
    (left ? high : low) = left ? b : a;
    (left ? b : a) = left ? a : b;
    (left ? at_b : at_a) = left ? at_a : at_b;
    double& next = left ? a : b;
    next = left ? high - kGolden * (high - low) : low + kGolden * (high - low);
    (left ? at_a : at_b) = of(next);
  }
  return (low + high) / 2;
}

}  // namespace

WaterSpectra spectra_of(const NamedWater& water) {
  WaterSpectra spectra;
  if (water.type == WaterType::kPure) spectra.absorption = kPure;
  if (water.type == WaterType::kCase1) {
    const auto at = [&](std::size_t i, double l) {
      return case_1_water_at(l, kPure[i], kChlorophyll[i], water.murkiness);
    };
    spectra.absorption = spectrum([&](std::size_t i, double l) { return at(i, l).absorption; });
    spectra.scattering = spectrum([&](std::size_t i, double l) { return at(i, l).scattering; });
  }
  if (is_typed(water.type)) {
    spectra.down_attenuation =
        spectrum([&](std::size_t, double l) { return jerlov_at(water.type, l); });
    spectra.absorption = spectrum([&](std::size_t i, double) {
      return detail::absorption_from_down_attenuation(spectra.down_attenuation[i], kPure[i]);
    });
  }
  return spectra;
}

Rgb<Spectrum> channel_weights(const Primaries& primaries) {
  const glm::dmat3 rgb_from_xyz = glm::inverse(xyz_from(primaries));
  const auto of_channel = [&](int channel) {
    Spectrum weights = spectrum(
        [&](std::size_t, double l) { return daylight(l) * (rgb_from_xyz * observer(l))[channel]; });
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (double& weight : weights) weight /= sum;
    return weights;
  };
  return {of_channel(0), of_channel(1), of_channel(2)};
}

Rgb<double> light_left(const Rgb<Spectrum>& weights, const Spectrum& rates, double distance) {
  return each(weights, [&](const Spectrum& w) { return left_of(w, rates, distance); });
}

Rgb<double> fitted_rates(const Rgb<Spectrum>& weights, const Spectrum& rates) {
  const auto ends = std::minmax_element(rates.begin(), rates.end());
  const double low = *ends.first, high = *ends.second;  // clang 14 captures no bindings
  if (low == high) return {low, low, low};
  // Path lengths from where nothing is lost to where nothing is left.
  constexpr int kDistances = 192;
  const double first = std::log(1e-3 / high), last = std::log(30 / low);
  return each(weights, [&](const Spectrum& w) {
    std::vector<double> distances(kDistances), left(kDistances);
    for (int i = 0; i < kDistances; ++i) {
      distances[i] = std::exp(std::lerp(first, last, i / (kDistances - 1.0)));
      left[i] = left_of(w, rates, distances[i]);
    }
    const auto error = [&](double log_rate) {
      const double rate = std::exp(log_rate);
      double sum = 0;
      for (int i = 0; i < kDistances; ++i) {
        const double apart = std::exp(-rate * distances[i]) - left[i];
        sum += apart * apart;
      }
      return sum;
    };
    return std::exp(least(std::log(low / 10), std::log(high), error));
  });
}

FittedWater fitted_water(const Primaries& primaries, const NamedWater& water) {
  const Rgb<Spectrum> weights = channel_weights(primaries);
  const auto mean = [&](const Spectrum& s) {
    return each(weights, [&](const Spectrum& w) { return std::max(weighted(w, s), 0.0); });
  };
  const WaterSpectra own = spectra_of(water);
  const Spectrum swallowed = spectrum([&](std::size_t, double l) {
    return sediment_water_at(l, water.sediment).absorption + cdom_absorption_at(l, water.cdom);
  });
  const double thrown = sediment_water_at(550, water.sediment).scattering;  // for all channels
  return {{fitted_rates(weights, own.absorption), mean(own.scattering)},
          fitted_rates(weights, own.down_attenuation),
          {fitted_rates(weights, swallowed), {thrown, thrown, thrown}}};
}

}  // namespace limpid
