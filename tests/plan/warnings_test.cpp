#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpid/plan/plan.h"

#include "support.h"

// A parameter that is set and has no effect is reported.

namespace limpid {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr PlaneSet kBare = kColorPlanes | PlaneSet{PlaneId::kDepth};

std::vector<std::string> warnings(const Look& look) {
  return make_plan(look, {.planes = kBare}).warnings;
}

TEST(PlanWarnings, DefaultsGiveNone) { EXPECT_THAT(warnings(Look{}), IsEmpty()); }

TEST(PlanWarnings, ASettingThatTheModelDoesNotReadIsNamed) {
  Look look;
  look.set("prism_split", "model", "axis");
  look.set("prism_split", "gain", 2.0);
  EXPECT_THAT(warnings(look), ElementsAre("prism_split.gain = 2 changes nothing: model is axis, "
                                          "expected model = dispersion"));
}

TEST(PlanWarnings, OfTwoConditionsTheFirstThatFailsIsNamed) {
  Look look;
  look.set("fresnel_reflection", "strength", 0.5);
  EXPECT_THAT(warnings(look),
              ElementsAre("fresnel_reflection.strength = 0.5 changes nothing: lookup is ray, "
                          "expected lookup = offset"));
  look.set("fresnel_reflection", "source", "constant");
  EXPECT_THAT(warnings(look),
              ElementsAre("fresnel_reflection.strength = 0.5 changes nothing: source is constant, "
                          "expected source = planar or auto"));
}

TEST(PlanWarnings, AValueAtItsDefaultIsNotTold) {
  Look look;
  look.set("depth_fog", "color", Rgb<double>{0.02, 0.10, 0.12});
  EXPECT_THAT(warnings(look), IsEmpty());
}

TEST(PlanWarnings, AnAbsorptionIsThatOfCustomWater) {
  Look look;
  look.set("depth_fog", "water_type", "3C");
  look.set("depth_fog", "absorption", Rgb<double>{0.4, 0.1, 0.05});
  EXPECT_EQ(look.of<DepthFog>().water_type, WaterType::kCustom) << "the later word wins";
  EXPECT_THAT(warnings(look), IsEmpty());
  look.set("depth_fog", "water_type", "II");
  EXPECT_EQ(look.of<DepthFog>().water_type, WaterType::kJerlovII) << "and the one after it";
  EXPECT_THAT(warnings(look),
              ElementsAre("depth_fog.absorption = [0.4, 0.1, 0.05] changes nothing: water_type is "
                          "II, expected water_type = custom"));
}

TEST(PlanWarnings, WhatAWindTakesThePlaceOfIsTold) {
  Look look;
  look.set("wave_normals", "speed", 0.2);
  look.set("wave_normals", "direction", 20.0);
  EXPECT_THAT(warnings(look), ElementsAre("wave_normals.direction = 20 changes nothing: model is "
                                          "slopes, expected model = two_flows or wind above 0"));
  look.set("wave_normals", "wind", 5.0);
  EXPECT_THAT(warnings(look), ElementsAre("wave_normals.speed = 0.2 changes nothing: wind is 5, "
                                          "expected wind = 0"));
  look.set("wave_normals", "model", "sines");
  look.set("wave_normals", "speed", 0.3);
  look.set("wave_normals", "direction", 135.0);
  EXPECT_THAT(warnings(look),
              ElementsAre("wave_normals.wind = 5 changes nothing: model is sines, expected model "
                          "= four_maps or two_flows or dudv or slopes"));
}

TEST(PlanWarnings, HalfALayerBelowIsNotRead) {
  const PlaneSet half = kBare | PlaneSet{PlaneId::kBelowDepth};
  EXPECT_FALSE(make_plan(Look{}, {.planes = half}).planes.has(PlaneId::kBelowDepth));
  const PlaneSet whole = kBare | kBelowPlanes;
  EXPECT_TRUE(make_plan(Look{}, {.planes = whole}).planes.covers(kBelowPlanes));
}

}  // namespace
}  // namespace limpid
