#include "limpid/optics/water_types.h"

#include <cmath>
#include <iterator>

#include <gtest/gtest.h>

namespace limpid {
namespace {

constexpr int kCount = static_cast<int>(WaterType::kCase1) + 1;

TEST(WaterTypes, EachHasAWord) {
  ASSERT_EQ(std::size(kWaterTypes), kCount);
  EXPECT_EQ(kWaterTypes[static_cast<int>(WaterType::kCustom)], "custom");
  EXPECT_EQ(kWaterTypes[static_cast<int>(WaterType::kPure)], "pure");
  EXPECT_EQ(kWaterTypes[static_cast<int>(WaterType::kJerlovIB)], "IB");
  EXPECT_EQ(kWaterTypes[static_cast<int>(WaterType::kJerlovIII)], "III");
  EXPECT_EQ(kWaterTypes[static_cast<int>(WaterType::kJerlov1C)], "1C");
  EXPECT_EQ(kWaterTypes[static_cast<int>(WaterType::kJerlov9C)], "9C");
}

TEST(WaterTypes, PureWaterOnlyAbsorbs) {
  const WaterOptics pure = water_optics(WaterType::kPure);
  EXPECT_EQ(pure.absorption, (Rgb<double>{.340, .0565, .00922}));
  EXPECT_EQ(pure.down_attenuation, pure.absorption);
}

// Jerlov's IA lies half way between I and IB, in every color.
TEST(WaterTypes, OceanWatersAreEvenSteps) {
  const Rgb<double> clear = water_optics(WaterType::kJerlovI).down_attenuation;
  const Rgb<double> between = water_optics(WaterType::kJerlovIA).down_attenuation;
  const Rgb<double> murkier = water_optics(WaterType::kJerlovIB).down_attenuation;
  EXPECT_NEAR(std::sqrt(clear.r * murkier.r), between.r, 0.01 * between.r);
  EXPECT_NEAR(std::sqrt(clear.g * murkier.g), between.g, 0.01 * between.g);
  EXPECT_NEAR(std::sqrt(clear.b * murkier.b), between.b, 0.01 * between.b);
}

TEST(WaterTypes, MurkinessHandWorked) {
  const WaterCoefficients ocean = case_1_water(0), pond = case_1_water(1);  // .03 and 30 mg/m^3
  EXPECT_NEAR(ocean.absorption.b, 0.01763, 2e-5);  // (.00922 + .06 .944 .03^.65) (1 + .2 e^-.14)
  EXPECT_NEAR(ocean.scattering.g, 0.03602, 2e-5);  // .3 .03^.62 + .00758 (400 / 550)^4.32
  EXPECT_NEAR(pond.absorption.r, 0.5406, 1e-4);    // (.34 + .06 .356 30^.65) (1 + .2 e^-2.94)
  EXPECT_NEAR(pond.absorption.g, 0.2627, 1e-4);
  EXPECT_NEAR(pond.absorption.b, 0.6174, 1e-4);  // (.00922 + .06 .944 30^.65) (1 + .2 e^-.14)
  EXPECT_NEAR(pond.scattering.r, 2.0921, 5e-4);  // .3 30^.62 550 / 650 + .00758 (400 / 650)^4.32
  EXPECT_NEAR(pond.scattering.g, 2.4733, 5e-4);
  EXPECT_NEAR(pond.scattering.b, 3.0251, 5e-4);
  // Murkier water lets less light through and sends more back; blue ocean, green pond.
  for (double m = 0; m < 0.95; m += 0.1) {
    const WaterCoefficients less = case_1_water(m), more = case_1_water(m + 0.1);
    EXPECT_LT(less.absorption.b, more.absorption.b);
    EXPECT_LT(less.scattering.b, more.scattering.b);
  }
  EXPECT_LT(ocean.absorption.b, ocean.absorption.g);
  EXPECT_GT(pond.absorption.b, pond.absorption.g);
}

TEST(WaterTypes, SedimentAndHumusHandWorked) {
  const WaterCoefficients sediment = sediment_water(10);  // g/m^3
  EXPECT_EQ(sediment.scattering, (Rgb<double>{5, 5, 5}));
  EXPECT_NEAR(sediment.absorption.r, 0.03214, 1e-5);  // .41 e^-2.5461
  EXPECT_NEAR(sediment.absorption.b, 0.37618, 1e-5);  // .41 e^-.0861
  const Rgb<double> humus = cdom_absorption(2);
  EXPECT_NEAR(humus.r, 0.10573, 1e-5);  // 2 e^-2.94
  EXPECT_NEAR(humus.g, 0.42876, 1e-5);  // 2 e^-1.54
  EXPECT_NEAR(humus.b, 1.73872, 1e-5);  // 2 e^-.14
  EXPECT_EQ(sediment_water(0).absorption, (Rgb<double>{0, 0, 0}));
  EXPECT_EQ(cdom_absorption(0), (Rgb<double>{0, 0, 0}));
}

TEST(WaterTypes, CustomIsEmpty) {
  EXPECT_EQ(water_optics(WaterType::kCustom).absorption, (Rgb<double>{0, 0, 0}));
  EXPECT_EQ(water_optics(WaterType::kCustom).down_attenuation, (Rgb<double>{0, 0, 0}));
}

TEST(WaterTypes, JerlovHandWorked) {
  const WaterOptics clear = water_optics(WaterType::kJerlovI);
  EXPECT_EQ(clear.down_attenuation, (Rgb<double>{.36, .063, .019}));
  EXPECT_NEAR(clear.absorption.r, .34632, 5e-6);  // .36 / 1.0395
  EXPECT_NEAR(clear.absorption.g, .06061, 5e-6);
  EXPECT_NEAR(clear.absorption.b, .01828, 5e-6);
  const WaterOptics murky = water_optics(WaterType::kJerlov9C);
  EXPECT_EQ(murky.down_attenuation, (Rgb<double>{.76, .63, 1.60}));
  EXPECT_NEAR(murky.absorption.b, 1.53920, 5e-6);
  EXPECT_EQ(detail::absorption_from_down_attenuation(0.3, 0.34), 0.34);
}

TEST(WaterTypes, NoneIsClearerThanPureWaterAndEachMurkierThanTheLast) {
  for (int i = 2; i <= static_cast<int>(WaterType::kJerlov9C); ++i) {
    const WaterOptics w = water_optics(static_cast<WaterType>(i));
    const WaterOptics before = water_optics(static_cast<WaterType>(i - 1));
    for (auto channel : {&Rgb<double>::r, &Rgb<double>::g, &Rgb<double>::b}) {
      EXPECT_GE(w.absorption.*channel, kPureWaterAbsorption.*channel) << i;
      EXPECT_LT(w.absorption.*channel, w.down_attenuation.*channel) << i;
      EXPECT_GE(w.down_attenuation.*channel, before.down_attenuation.*channel) << i;
    }
  }
}

// Ocean water is blue, coastal water green.
TEST(WaterTypes, ClearestColor) {
  const auto down = [](WaterType type) { return water_optics(type).down_attenuation; };
  EXPECT_LT(down(WaterType::kJerlovI).b, down(WaterType::kJerlovI).g);
  EXPECT_LT(down(WaterType::kJerlov1C).g, down(WaterType::kJerlov1C).b);
}

}  // namespace
}  // namespace limpid
