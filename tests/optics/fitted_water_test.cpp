#include "optics/fitted_water.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>

/// Natural waters in working spaces other than Rec.709.

namespace limpid {
namespace {

Primaries space(const char* name) { return find_color_space(name).value(); }

/// Every water that has a name, including the murky waters.
std::vector<NamedWater> waters() {
  std::vector<NamedWater> all;
  for (int t = static_cast<int>(WaterType::kPure); t < static_cast<int>(WaterType::kCase1); ++t) {
    all.push_back({static_cast<WaterType>(t)});
  }
  for (const double murkiness : {0.0, 0.3, 0.6, 1.0}) {
    all.push_back({WaterType::kCase1, murkiness});
  }
  return all;
}

std::string name_of(const NamedWater& water) {
  return std::string(kWaterTypes[static_cast<std::size_t>(water.type)]) + " " +
         std::to_string(water.murkiness);
}

/// The water's absorption in Rec.709, at three wavelengths.
Rgb<double> absorption_709(const NamedWater& water) {
  return water.type == WaterType::kCase1 ? case_1_water(water.murkiness).absorption
                                         : water_optics(water.type).absorption;
}

Rgb<double> left(const Rgb<double>& rates, double distance) {
  return {std::exp(-rates.r * distance), std::exp(-rates.g * distance),
          std::exp(-rates.b * distance)};
}

double apart(const Rgb<double>& a, const Rgb<double>& b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

/// The largest difference over paths of a millimetre to three kilometres, or to `most`.
double worst(const std::function<double(double)>& at, double most = 3000) {
  double largest = 0;
  for (double distance = 1e-3; distance <= most; distance *= 1.05)
    largest = std::max(largest, at(distance));
  return largest;
}

TEST(FittedWater, SpectraGoThroughTheThreeWavelengthsOfRec709) {
  constexpr std::size_t kRed = 25, kGreen = 15, kBlue = 5;  // 650, 550, 450 nm
  const auto at_three = [](const Spectrum& s) { return Rgb<double>{s[kRed], s[kGreen], s[kBlue]}; };
  for (const NamedWater& water : waters()) {
    const WaterSpectra spectra = spectra_of(water);
    EXPECT_EQ(at_three(spectra.absorption), absorption_709(water)) << name_of(water);
    if (water.type == WaterType::kCase1) {
      EXPECT_EQ(at_three(spectra.scattering), case_1_water(water.murkiness).scattering);
    } else if (water.type != WaterType::kPure) {
      const Rgb<double> down = water_optics(water.type).down_attenuation;
      EXPECT_LT(apart(at_three(spectra.down_attenuation), down), 1e-12) << name_of(water);
    }
  }
}

TEST(FittedWater, WhiteIsWhite) {
  for (const std::string& name : color_space_names()) {
    const Rgb<Spectrum> weights = channel_weights(*find_color_space(name));
    for (const Spectrum* w : {&weights.r, &weights.g, &weights.b}) {
      EXPECT_NEAR(std::accumulate(w->begin(), w->end(), 0.0), 1, 1e-12) << name;
    }
  }
}

TEST(FittedWater, GrayWaterStaysGray) {
  Spectrum gray;
  gray.fill(.25);
  const Rgb<Spectrum> weights = channel_weights(space("ACEScg"));
  EXPECT_EQ(fitted_rates(weights, gray), (Rgb<double>{.25, .25, .25}));
  EXPECT_EQ(fitted_rates(weights, {}), (Rgb<double>{0, 0, 0}));
  const FittedWater none = fitted_water(space("ACEScg"), {WaterType::kCustom});
  EXPECT_EQ(none.type.absorption, (Rgb<double>{0, 0, 0}));
  EXPECT_EQ(none.additions.absorption, (Rgb<double>{0, 0, 0}));
  // Nearly gray: each rate lies between the least and the largest.
  for (std::size_t i = 0; i < kSpectrumSize; ++i) gray[i] = .25 + 1e-6 * static_cast<double>(i);
  const Rgb<double> near = fitted_rates(weights, gray);
  for (const double rate : {near.r, near.g, near.b}) {
    EXPECT_GE(rate, gray.front());
    EXPECT_LE(rate, gray.back());
  }
  EXPECT_LT(near.b, near.r);  // short wavelengths are absorbed less
}

TEST(FittedWater, NoOtherRateFitsBetter) {
  const Rgb<Spectrum> weights = channel_weights(space("ACEScg"));
  for (const NamedWater& water : waters()) {
    const Spectrum rates = spectra_of(water).absorption;
    const Rgb<double> best = fitted_rates(weights, rates);
    const auto error_of = [&](double rate, double Rgb<double>::*channel) {
      double sum = 0;
      for (double distance = 1e-3; distance < 1e4; distance *= 1.1) {
        const double difference =
            std::exp(-rate * distance) - light_left(weights, rates, distance).*channel;
        sum += difference * difference;
      }
      return sum;
    };
    for (const auto channel : {&Rgb<double>::r, &Rgb<double>::g, &Rgb<double>::b}) {
      const double least = error_of(best.*channel, channel);
      for (double by = 1.02; by < 20; by *= 1.1) {
        EXPECT_GT(error_of(best.*channel * by, channel), least) << name_of(water) << " " << by;
        EXPECT_GT(error_of(best.*channel / by, channel), least) << name_of(water) << " " << by;
      }
    }
  }
}

/// White light after absorption by the rates of each channel, beside the whole spectrum; the
/// numbers of Rec.709 would be off by more.
TEST(FittedWater, IsNearTheSpectrumAtEveryLength) {
  for (const char* name : {"ACEScg", "Rec.2020", "P3-D65"}) {
    const Primaries primaries = space(name);
    const Rgb<Spectrum> weights = channel_weights(primaries);
    for (const NamedWater& water : waters()) {
      const Spectrum rates = spectra_of(water).absorption;
      const auto off_by = [&](const Rgb<double>& of) {
        return worst([&](double distance) {
          return apart(left(of, distance), light_left(weights, rates, distance));
        });
      };
      const double fitted = off_by(fitted_water(primaries, water).type.absorption);
      EXPECT_LT(fitted, .065) << name << " " << name_of(water);
      EXPECT_LT(fitted, off_by(absorption_709(water))) << name << " " << name_of(water);
    }
  }
}

/// A white plate in Rec.709 that is made wet and then converted, beside a white plate that is made
/// wet in ACEScg: their difference is the error of three wavelengths and three rates for a
/// spectrum.
TEST(FittedWater, ConvertedBeforeIsNearlyConvertedAfter) {
  const Primaries acescg = space("ACEScg");
  const glm::dmat3 convert = rgb_from_rgb(acescg, kRec709);
  for (const NamedWater& water : waters()) {
    const Rgb<double> rates = absorption_709(water);
    const Rgb<double> fit = fitted_water(acescg, water).type.absorption;
    const auto after = [&](double distance) {
      const Rgb<double> c = left(rates, distance);
      const glm::dvec3 v = convert * glm::dvec3(c.r, c.g, c.b);
      return Rgb<double>{v.x, v.y, v.z};
    };
    const double fitted =
        worst([&](double distance) { return apart(left(fit, distance), after(distance)); });
    const double unfitted =
        worst([&](double distance) { return apart(left(rates, distance), after(distance)); });
    EXPECT_LT(fitted, .12) << name_of(water);
    if (rates.g < .1) {  // clear: red and green are far apart
      EXPECT_GT(unfitted, 1.8 * fitted) << name_of(water);
    }
  }
}

TEST(FittedWater, MixedInIsAddedTo) {
  const Primaries acescg = space("ACEScg");
  const FittedWater clear = fitted_water(acescg, {WaterType::kCase1, .3});
  const FittedWater murky = fitted_water(acescg, {WaterType::kCase1, .3, 20, .5});
  EXPECT_EQ(murky.type.absorption, clear.type.absorption);
  EXPECT_EQ(murky.additions.scattering, (Rgb<double>{10, 10, 10}));
  EXPECT_EQ(clear.additions.scattering, (Rgb<double>{0, 0, 0}));
  // Humus and grains absorb blue most.
  EXPECT_GT(murky.additions.absorption.b, murky.additions.absorption.g);
  EXPECT_GT(murky.additions.absorption.g, murky.additions.absorption.r);
  EXPECT_GT(murky.additions.absorption.r, 0);
}

}  // namespace
}  // namespace limpid
