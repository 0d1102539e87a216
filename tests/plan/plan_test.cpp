#include "limpid/plan/plan.h"

#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpid/core/error.h"

#include "plan/leave_out.h"
#include "support.h"

namespace limpid {
namespace {

using testing::HasSubstr;

constexpr PlaneSet kBare = kColorPlanes | PlaneSet{PlaneId::kDepth};
constexpr PlaneSet kShadow{PlaneId::kShadow};
constexpr PlaneSet kAll = kBare | kReflectionPlanes | kSurfaceNormalPlanes | kShadow |
                          PlaneSet{PlaneId::kColorA, PlaneId::kSurfaceDepth};

/// A look in which nothing is neutral.
Look busy_look() {
  Look look = test::article_look();
  look.of<PrismSplit>().strength = 0.004;
  return look;
}

/// The verdicts of the operators in these tests.
std::string text(const Look& look, const Inputs& inputs, StateSet outputs = {}) {
  Plan plan = make_plan(look, inputs, outputs);
  const std::set<std::string_view> known{
      WaveNormals::kName, PrismSplit::kName,        Refraction::kName,   DepthFog::kName,
      WaterShadow::kName, FresnelReflection::kName, SunHighlight::kName, Penetration::kName};
  std::erase_if(plan.operators, [&](const auto& op) { return !known.contains(op.name); });
  return to_text(plan);
}

TEST(Plan, KeepsEverythingWhenAllIsThere) {
  EXPECT_EQ(text(busy_look(), {kAll, false, true}),
            "wave_normals        kept, model plate: the frame has surface normals\n"
            "prism_split         kept\n"
            "refraction          kept\n"
            "depth_fog           kept\n"
            "water_shadow        kept\n"
            "fresnel_reflection  kept\n"
            "sun_highlight       kept\n"
            "penetration         skipped: neutral, its parameters change nothing here\n");
}

TEST(Plan, SaysWhichInputIsAbsent) {
  EXPECT_EQ(text(busy_look(), {kBare, true, false}),
            "wave_normals        kept\n"
            "prism_split         kept\n"
            "refraction          kept\n"
            "depth_fog           kept\n"
            "water_shadow        skipped: input absent, no shadow\n"
            "fresnel_reflection  skipped: input absent, no reflection\n"
            "sun_highlight       skipped: input absent, no sun\n"
            "penetration         skipped: neutral, its parameters change nothing here\n");
}

TEST(Plan, MirrorsTheEnvironmentWithoutAReflection) {
  const Inputs inputs{.planes = kBare, .wave_map = true, .environment = true};
  const Plan plan = make_plan(busy_look(), inputs);
  EXPECT_THAT(to_text(plan),
              HasSubstr("fresnel_reflection  kept, source environment: the frame has "
                        "no reflection\n"));
  EXPECT_EQ(plan.look.of<FresnelReflection>().source, FresnelReflection::Source::kEnvironment);
  EXPECT_TRUE(plan.reads_environment);
  Look constant = busy_look();
  constant.of<FresnelReflection>().source = FresnelReflection::Source::kConstant;
  const Plan plain = make_plan(constant, inputs);
  EXPECT_EQ(plain.look.of<FresnelReflection>().source, FresnelReflection::Source::kConstant);
  EXPECT_FALSE(plain.reads_environment);
  EXPECT_THAT(text(constant, {kBare, true}), HasSubstr("fresnel_reflection  kept\n"));
}

TEST(Plan, ReadsTheEnvironmentBesideAReflectionOnlyToFillIt) {
  Inputs inputs{.planes = kAll, .wave_map = true, .environment = true};
  EXPECT_FALSE(make_plan(busy_look(), inputs).reads_environment);
  inputs.planes = kAll | PlaneSet{PlaneId::kReflectionValid};
  const Plan plan = make_plan(busy_look(), inputs);
  EXPECT_TRUE(plan.reads_environment);
  EXPECT_TRUE(plan.planes.has(PlaneId::kReflectionValid));
  EXPECT_THAT(to_text(plan), HasSubstr("fresnel_reflection  kept, environment where the reflection "
                                       "is not valid\n"));
}

// Without normals the surface is not tilted, so light is not refracted or split.
TEST(Plan, WithoutWavesThereIsNothingToRefract) {
  EXPECT_EQ(text(busy_look(), {kBare | kShadow, false, true}),
            "wave_normals        skipped: input absent, no normal map\n"
            "prism_split         skipped: neutral, its parameters change nothing here\n"
            "refraction          skipped: neutral, its parameters change nothing here\n"
            "depth_fog           kept\n"
            "water_shadow        kept\n"
            "fresnel_reflection  skipped: input absent, no reflection\n"
            "sun_highlight       kept\n"
            "penetration         skipped: neutral, its parameters change nothing here\n");
}

TEST(Plan, HasOnlyWhatItIsToldOf) {
  const std::string told = text(busy_look(), {.planes = kBare});
  EXPECT_THAT(told, HasSubstr("wave_normals        skipped: input absent, no normal map\n"));
  EXPECT_THAT(told, HasSubstr("sun_highlight       skipped: input absent, no sun\n"));
}

TEST(Plan, SkipsWhatItsParametersMakeNeutral) {
  Look look = test::article_look();
  look.of<Refraction>().strength = 0;
  look.of<DepthFog>().alpha = 0;
  look.of<WaterShadow>().strength = 0;
  look.of<SunHighlight>().strength = 0;
  EXPECT_EQ(text(look, {kAll, false, true}),
            "wave_normals        kept, model plate: the frame has surface normals\n"
            "prism_split         skipped: neutral, its parameters change nothing here\n"
            "refraction          skipped: neutral, its parameters change nothing here\n"
            "depth_fog           skipped: neutral, its parameters change nothing here\n"
            "water_shadow        skipped: neutral, its parameters change nothing here\n"
            "fresnel_reflection  kept\n"
            "sun_highlight       skipped: neutral, its parameters change nothing here\n"
            "penetration         skipped: neutral, its parameters change nothing here\n");
}

TEST(Plan, SkipsWavesThatNothingReads) {
  Look look = test::article_look();
  look.of<Refraction>().strength = 0;
  const Inputs no_mirror_no_sun{kAll - kReflectionPlanes, false, false};
  EXPECT_EQ(text(look, no_mirror_no_sun),
            "wave_normals        skipped: unread, no operator reads its results\n"
            "prism_split         skipped: neutral, its parameters change nothing here\n"
            "refraction          skipped: neutral, its parameters change nothing here\n"
            "depth_fog           kept\n"
            "water_shadow        kept\n"
            "fresnel_reflection  skipped: input absent, no reflection\n"
            "sun_highlight       skipped: input absent, no sun\n"
            "penetration         skipped: neutral, its parameters change nothing here\n");
  // Where the normal is an output, its planes are read.
  const Plan plan = make_plan(look, no_mirror_no_sun, {StatePart::kNormal});
  EXPECT_EQ(plan.of<WaveNormals>().verdict, Verdict::kKept);
  EXPECT_TRUE(plan.planes.covers(kSurfaceNormalPlanes));
}

TEST(Plan, SkipsThePrismWhenNothingIsRefractedAndKeepsItsLookupOtherwise) {
  Look look = busy_look();
  look.of<Refraction>().strength = 0;
  const Plan plan = make_plan(look, {kAll, false, true}, {});
  EXPECT_EQ(plan.of<PrismSplit>().verdict, Verdict::kKept);
  EXPECT_EQ(plan.of<Refraction>().verdict, Verdict::kKept)
      << "the prism is looked up by refraction";
}

TEST(Plan, PlateNormalsReplaceMaps) {
  Look look = test::article_look();
  ASSERT_EQ(look.of<WaveNormals>().model, WaveNormals::Model::kFourMaps);
  const Plan with = make_plan(look, {kAll, true, true}, {});
  EXPECT_EQ(with.look.of<WaveNormals>().model, WaveNormals::Model::kPlate);
  EXPECT_TRUE(with.planes.covers(kSurfaceNormalPlanes));
  const Plan without = make_plan(look, {kAll - kSurfaceNormalPlanes, true, true}, {});
  EXPECT_EQ(without.look.of<WaveNormals>().model, WaveNormals::Model::kFourMaps);
  // One channel of a normal is no normal.
  const PlaneSet partial = kAll - PlaneSet{PlaneId::kSurfaceNormalZ};
  EXPECT_EQ(make_plan(look, {partial, true, true}, {}).look.of<WaveNormals>().model,
            WaveNormals::Model::kFourMaps);
}

TEST(Plan, PlateNormalsThatAreAskedForMustBeThere) {
  Look look = test::article_look();
  look.of<WaveNormals>().model = WaveNormals::Model::kPlate;
  EXPECT_THAT(text(look, {kBare, true, true}),
              HasSubstr("wave_normals        skipped: input absent, no surface_normal\n"));
}

TEST(Plan, ReadsOnlyWhatTheKeptOperatorsRead) {
  Look look = busy_look();
  EXPECT_EQ(make_plan(look, {kAll, false, true}, {}).planes, kAll);
  look.of<WaterShadow>().strength = 0;
  look.of<SunHighlight>().strength = 0;
  EXPECT_EQ(make_plan(look, {kAll, false, true}, {}).planes, kAll - kShadow);
  EXPECT_EQ(make_plan(look, {kBare, false, false}, {}).planes, kBare);
  look = test::article_look();
  look.of<Refraction>().strength = 0;
  EXPECT_EQ(make_plan(look, {kAll - kReflectionPlanes - kShadow, false, false}, {}).planes,
            kBare | PlaneSet({PlaneId::kColorA, PlaneId::kSurfaceDepth}));
}

TEST(Plan, SaysWhatStateIsMade) {
  Look look = test::article_look();
  EXPECT_FALSE(make_plan(look, {kAll, false, true}, {}).made.has(StatePart::kPrism));
  EXPECT_TRUE(make_plan(busy_look(), {kAll, false, true}, {}).made.has(StatePart::kPrism));
  EXPECT_FALSE(make_plan(look, {kBare, false, true}, {}).made.has(StatePart::kFresnel));
}

// The fog measures the path through the water, even if the fog's color is switched off.
TEST(Plan, KeepsANeutralFogWhosePathIsWritten) {
  Look look = test::article_look();
  look.of<DepthFog>().alpha = 0;
  const Inputs inputs{kAll, false, true};
  EXPECT_THAT(text(look, inputs), HasSubstr("depth_fog           skipped: neutral"));
  EXPECT_THAT(text(look, inputs, {StatePart::kPath}), HasSubstr("depth_fog           kept"));
}

TEST(Plan, SaysWhichRuleDecided) {
  const Plan plan = make_plan(test::article_look(), {kAll - kReflectionPlanes, false, true});
  EXPECT_EQ(plan.of<WaveNormals>().rule, "take_better_input");
  EXPECT_EQ(plan.of<PrismSplit>().rule, "skip_neutral");
  EXPECT_EQ(plan.of<Refraction>().rule, "");
  EXPECT_EQ(plan.of<FresnelReflection>().rule, "skip_absent_input");
  std::set<std::string_view> names;
  for (const RuleInfo& rule : rules()) {
    EXPECT_TRUE(names.insert(rule.name).second) << rule.name;
    EXPECT_TRUE(rule.about.ends_with(".")) << rule.name;
  }
  EXPECT_THAT(names, testing::IsSupersetOf({"take_better_input", "skip_neutral", "copy_dry",
                                            "skip_hidden", "skip_invisible"}));
}

TEST(Plan, LeavesOutWhatItIsAskedToAndWhatOnlyThatNeeds) {
  const Inputs inputs{.planes = kBare | kShadow, .wave_map = true, .sun = true};
  const Plan plan = make_plan_without({"wave_normals", "depth_fog"}, busy_look(), inputs);
  EXPECT_EQ(to_text(plan.of<WaveNormals>()), "skipped: unread, it is left out");
  EXPECT_EQ(to_text(plan.of<DepthFog>()), "skipped: unread, it is left out");
  EXPECT_EQ(plan.of<Refraction>().verdict, Verdict::kNeutral);
  EXPECT_TRUE(plan.keeps<WaterShadow>());
  EXPECT_FALSE(plan.reads_wave_map);
  EXPECT_EQ(to_text(make_plan_without({}, busy_look(), inputs)),
            to_text(make_plan(busy_look(), inputs)));
  try {
    make_plan_without({"depth_fogs"}, busy_look(), inputs);
    ADD_FAILURE() << "an unknown operator was left out";
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), HasSubstr("did you mean 'depth_fog'?"));
  }
}

TEST(Plan, HoldsTheErrorThatItMayMake) {
  const Inputs inputs{kAll, false, true};
  EXPECT_EQ(make_plan(busy_look(), inputs).max_error, 0);
  const Plan plan = make_plan(busy_look(), inputs, {StatePart::kPath}, 0.002);
  EXPECT_EQ(plan.max_error, 0.002);
  EXPECT_EQ(plan.outputs, StateSet{StatePart::kPath});
  EXPECT_THAT(to_text(plan), HasSubstr("\nmax_error           0.002\n"));
  for (double bad : {-1e-9, std::nan(""), HUGE_VAL}) {
    EXPECT_THROW(make_plan(busy_look(), inputs, {}, bad), Error) << bad;
  }
}

TEST(Plan, RefusesWhatNoWaterCanBePutInto) {
  const auto refusal = [](const Look& look, PlaneSet planes) -> std::string {
    try {
      make_plan(look, {planes, false, false}, {});
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_THAT(refusal({}, kBare - PlaneSet{PlaneId::kColorG}), HasSubstr("no color"));
  EXPECT_THAT(refusal({}, kColorPlanes), HasSubstr("no depth"));
  Look bad;
  bad.of<DepthFog>().density = -1;
  EXPECT_EQ(refusal(bad, kAll), "depth_fog.density = -1: expected 0 ... 1000000 (1/scene unit)");
  EXPECT_EQ(refusal({}, kBare), "");
}

}  // namespace
}  // namespace limpid
