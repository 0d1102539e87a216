#include "limpid/plan/survey.h"

#include <cstdio>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpid/core/simd.h"

#include "op/pass.h"
#include "plan/predict.h"
#include "plan/surveyed.h"

namespace limpid {
namespace {

using test::Buffers;
using test::surveyed;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

constexpr int kWaves = Chain::index_of<WaveNormals>(), kPrism = Chain::index_of<PrismSplit>(),
              kRefraction = Chain::index_of<Refraction>(), kShadow = Chain::index_of<WaterShadow>(),
              kHighlight = Chain::index_of<SunHighlight>();

/// Water at depth 4 over a bottom at depth 6, lit, seen level from above: 3 x 5 cells, offsets by
/// less than a cell.
constexpr Size kSize{384, 80};

Buffers tray(Rect display) {
  Buffers b(display);
  for (PlaneId id : {PlaneId::kColorR, PlaneId::kColorG, PlaneId::kColorB}) b.fill(id, 0.5f);
  b.fill(PlaneId::kDepth, 6).fill(PlaneId::kSurfaceDepth, 4).fill(PlaneId::kShadow, 1);
  b.normal({0, 1, 0});
  return b;
}

void put(Buffers& b, PlaneId id, int x, int y, float value) {
  const View<const float>& view = b.frame.plane(id);
  const_cast<float&>(view.at(x, y)) = value;
}

/// Offsets of at most 0.01: 4 pixels across, 1 down.
Look short_look() {
  Look look = test::article_look();
  look.of<Refraction>().strength = 0.01;
  return look;
}

Scene scene_of(const Frame& frame) { return test::simple_scene(frame.display.size()); }

Plan plan_of(const Look& look, const Frame& frame, double max_error = 0, StateSet outputs = {}) {
  return make_plan(look, test::inputs_of(frame, scene_of(frame)), outputs, max_error);
}

Survey survey_of(const Look& look, const Frame& frame, double max_error = 0,
                 StateSet outputs = {}) {
  return surveyed(plan_of(look, frame, max_error, outputs), frame, scene_of(frame));
}

/// A row of letters for each row of cells: "." dry, "o" opaque, "f" free of foreground, "#" else.
std::string map_of(const Survey& survey, int across) {
  std::string text;
  for (int i = 0; i < survey.count(); ++i) {
    const CellNeeds& needs = survey.cell(i);
    text += needs.dry ? '.' : needs.opaque ? 'o' : needs.open ? 'f' : '#';
    if (i % across == across - 1) text += '\n';
  }
  return text;
}

TEST(Survey, WaterAloneHasNoForeground) {
  const Buffers b = tray(rect_of(kSize));
  const Survey survey = survey_of(short_look(), b.frame);
  EXPECT_EQ(map_of(survey, 3), "fff\nfff\nfff\nfff\nfff\n");
  EXPECT_EQ(survey.summary().open.cells, 15);
  EXPECT_EQ(survey.summary().open.pixels, 384 * 80);
  EXPECT_EQ(survey.summary().wet, 384 * 80);
  EXPECT_EQ(survey.summary().bound, 0);
}

TEST(Survey, DryCellsAreToldApart) {
  Buffers b = tray(rect_of(kSize));
  b.set(PlaneId::kSurfaceDepth, [](int x, int y) { return x < 128 && y < 32 ? test::kInf : 4.0f; });
  EXPECT_EQ(map_of(survey_of(short_look(), b.frame), 3), ".ff\n.ff\nfff\nfff\nfff\n")
      << "the depth of a dry pixel may still lie behind the surface";
  put(b, PlaneId::kSurfaceDepth, 127, 31, 5.9f);
  EXPECT_EQ(map_of(survey_of(short_look(), b.frame), 3), ".ff\nfff\nfff\nfff\nfff\n")
      << "one wet pixel";
}

// An object before the water is in reach of the cells around, if near enough to their edge: within
// 4 pixels and 2 for filtering, and then as far as the 32 x 16 pixels of its block go.
TEST(Survey, ForegroundAtTheEdgeOfACellCountsForItsNeighbour) {
  const auto map_with = [&](int x, int y, const Look& look) {
    Buffers b = tray(rect_of(kSize));
    put(b, PlaneId::kDepth, x, y, 3);
    return map_of(survey_of(look, b.frame), 3);
  };
  EXPECT_EQ(map_with(192, 40, short_look()), "fff\nf#f\nf#f\nf#f\nfff\n");
  EXPECT_EQ(map_with(160, 40, short_look()), "fff\nf#f\nf#f\nf#f\nfff\n");
  EXPECT_EQ(map_with(159, 40, short_look()), "fff\n##f\n##f\n##f\nfff\n");
  EXPECT_EQ(map_with(127, 40, short_look()), "fff\n##f\n##f\n##f\nfff\n");
  EXPECT_EQ(map_with(255, 0, short_look()), "f##\nf##\nfff\nfff\nfff\n");
  EXPECT_EQ(map_with(256, 79, short_look()), "fff\nfff\nfff\nf##\nf##\n");
}

TEST(Survey, OverscanIsInReach) {
  const Rect data{-100, -20, 484, 100};
  const auto map_with = [&](int x, int y) {
    Buffers b = tray(rect_of(kSize));
    for (PlaneId id : {PlaneId::kColorR, PlaneId::kColorG, PlaneId::kColorB}) {
      b.set(
          id, [](int, int) { return 0.5f; }, data);
    }
    b.set(
        PlaneId::kSurfaceDepth, [](int, int) { return 4.0f; }, data);
    b.set(
        PlaneId::kDepth, [&](int i, int j) { return i == x && j == y ? 3.0f : 6.0f; }, data);
    return map_of(survey_of(short_look(), b.frame), 3);
  };
  EXPECT_EQ(map_with(-1, 8), "#ff\n#ff\nfff\nfff\nfff\n");
  EXPECT_EQ(map_with(-40, 8), "fff\nfff\nfff\nfff\nfff\n") << "out of reach";
  EXPECT_EQ(map_with(384, 81), "fff\nfff\nfff\nfff\nff#\n");
}

// Every plane with lookups counts, even if its window is larger than the depth's window.
TEST(Survey, AShadowBesideThePictureIsInReach) {
  Buffers b = tray(rect_of(kSize));
  b.set(PlaneId::kShadow, [](int x, int) { return x < 0 ? 0.0f : 1.0f; }, {-100, -20, 484, 100});
  const Survey survey = survey_of(short_look(), b.frame);
  EXPECT_TRUE(survey.at(0, 40).needs(kShadow));
  EXPECT_FALSE(survey.at(383, 40).needs(kShadow));
}

TEST(Survey, IsTheSameWhereverTheWindowOfThePictureLies) {
  Look look = short_look();
  DepthFog::Params& fog = look.of<DepthFog>();
  fog.alpha = 1, fog.density = 0.001, fog.distance = DepthFog::Distance::kRay;
  const Buffers b = tray(rect_of(kSize)), far = tray({3000, -2000, 3384, -1920});
  const Survey judge = survey_of(look, b.frame, 0.01), survey = survey_of(look, far.frame, 0.01);
  EXPECT_GT(judge.summary().bound, 0);
  ASSERT_EQ(survey.count(), judge.count());
  for (int i = 0; i < judge.count(); ++i) EXPECT_EQ(survey.cell(i), judge.cell(i)) << i;
}

TEST(Survey, EveryPixelIsInACell) {
  for (const Size size : {Size{1, 1}, {1, 37}, {37, 1}, {127, 16}, {128, 17}, {129, 15}}) {
    const Rect display{5, -3, 5 + size.width, -3 + size.height};
    const Buffers b = tray(display);
    const Survey survey = survey_of(short_look(), b.frame);
    std::int64_t pixels = 0;
    for (int i = 0; i < survey.count(); ++i) {
      const Rect cell = survey.pixels(i);
      pixels += cell.area();
      EXPECT_EQ(&survey.at(cell.x0, cell.y0), &survey.cell(i));
      EXPECT_EQ(&survey.at(cell.x1 - 1, cell.y1 - 1), &survey.cell(i));
      EXPECT_TRUE(survey.cell(i).open);
    }
    EXPECT_EQ(pixels, display.area());
    EXPECT_EQ(survey.count(), (size.width + 127) / 128 * ((size.height + 15) / 16));
  }
}

TEST(Survey, ShortenNeedsWaterAllAround) {
  Look shorten = short_look();
  shorten.of<Refraction>().rejection = Refraction::Rejection::kShorten;
  Buffers b = tray(rect_of(kSize));
  EXPECT_EQ(map_of(survey_of(shorten, b.frame), 3), "fff\nfff\nfff\nfff\nfff\n");
  put(b, PlaneId::kSurfaceDepth, 159, 40, test::kInf);
  EXPECT_EQ(map_of(survey_of(shorten, b.frame), 3), "fff\n##f\n##f\n##f\nfff\n")
      << "a dry texel does not count, however deep";
  EXPECT_EQ(map_of(survey_of(short_look(), b.frame), 3), "fff\nfff\nfff\nfff\nfff\n");
  // Taps at the edge of a plane read other pixels than taps within another plane's window.
  b = tray(rect_of(kSize));
  b.set(PlaneId::kDepth, [](int, int) { return 6.0f; }, {-9, -9, 400, 90});
  EXPECT_EQ(survey_of(shorten, b.frame).summary().open.cells, 0);
}

/// Fog that is full after 1 unit of path.
Look murky() {
  Look look = short_look();
  DepthFog::Params& fog = look.of<DepthFog>();
  fog.alpha = 1;
  fog.density = 1;
  return look;
}

TEST(Survey, FullFogHidesWhatIsBehindIt) {
  Buffers b = tray(rect_of(kSize));
  EXPECT_EQ(map_of(survey_of(murky(), b.frame), 3), "ooo\nooo\nooo\nooo\nooo\n");
  put(b, PlaneId::kDepth, 159, 40, 4.9f);
  EXPECT_EQ(map_of(survey_of(murky(), b.frame), 3), "ooo\nffo\nffo\nffo\nooo\n");
  const Survey survey = survey_of(murky(), b.frame);
  EXPECT_FALSE(survey.at(0, 0).needs(kRefraction));
  EXPECT_FALSE(survey.at(0, 0).open) << "nothing is looked up";
  EXPECT_TRUE(survey.at(0, 40).needs(kRefraction));
  Look thin = murky();
  thin.of<DepthFog>().alpha = 0.99;
  EXPECT_EQ(survey_of(thin, b.frame).summary().opaque.cells, 0) << "1 % of the bottom is left";
}

// After a path of length 2: of the bottom 1 - 0.999 (2 0.4995) = 0.001999 is left, of a color 0.48
// off the fog's color.
TEST(Survey, AnErrorMakesThinnerFogOpaque) {
  Look look = murky();
  look.of<DepthFog>().density = 0.4995;
  const Buffers b = tray(rect_of(kSize));
  EXPECT_EQ(survey_of(look, b.frame, 0).summary().opaque.cells, 0);
  EXPECT_EQ(survey_of(look, b.frame, 0.0009).summary().opaque.cells, 0);
  const Survey survey = survey_of(look, b.frame, 0.001);
  EXPECT_EQ(survey.summary().opaque.cells, 15);
  EXPECT_NEAR(survey.summary().bound, 0.001999 * 0.48, 1e-6);
}

// Positions that are written must be computed.
TEST(Survey, WhatIsWrittenIsNotSkipped) {
  const Buffers b = tray(rect_of(kSize));
  EXPECT_EQ(survey_of(murky(), b.frame, 0, {StatePart::kPath}).summary().opaque.cells, 0);
  EXPECT_EQ(survey_of(murky(), b.frame, 0, {StatePart::kPosition}).summary().opaque.cells, 0);
  const Survey light = survey_of(murky(), b.frame, 0, kOutputTerms);
  EXPECT_EQ(light.summary().opaque.cells, 15);
  EXPECT_EQ(light.summary().skipped[Chain::index_of<WaterShadow>()].cells, 15);
}

TEST(Survey, WavesThatNothingReadsInACellAreNotMade) {
  Buffers b = tray(rect_of(kSize));
  put(b, PlaneId::kDepth, 0, 0, 4.9f);
  Look look = murky();
  look.of<PrismSplit>().strength = 0.002;
  const Survey both = survey_of(look, b.frame);
  EXPECT_TRUE(both.at(383, 79).needs(kWaves)) << "the highlight reads them";
  EXPECT_FALSE(both.at(383, 79).needs(kPrism)) << "nothing is refracted";
  look.of<SunHighlight>().strength = 0;
  const Survey survey = survey_of(look, b.frame);
  EXPECT_FALSE(survey.at(383, 79).needs(kWaves));
  EXPECT_TRUE(survey.at(0, 0).needs(kWaves));
  EXPECT_TRUE(survey.at(0, 0).needs(kPrism));
}

TEST(Survey, ShadowIsSkippedWhereAllIsLitAndTheGlintWhereNothingIs) {
  Buffers b = tray(rect_of(kSize));
  const Survey all = survey_of(short_look(), b.frame);
  EXPECT_EQ(all.summary().skipped[Chain::index_of<WaterShadow>()].cells, 15);
  EXPECT_EQ(all.summary().runs[kHighlight].cells, 15);
  put(b, PlaneId::kShadow, 159, 40, 0.99f);
  const Survey survey = survey_of(short_look(), b.frame);
  EXPECT_EQ(survey.summary().skipped[Chain::index_of<WaterShadow>()].cells, 15 - 6)
      << "in reach of two columns and three rows";
  EXPECT_TRUE(survey.at(0, 40).needs(kShadow));
  EXPECT_FALSE(survey.at(0, 0).needs(kShadow));
  b.set(PlaneId::kShadow, [](int x, int) { return x < 128 ? 0.0f : 1.0f; });
  const Survey dark = survey_of(short_look(), b.frame);
  EXPECT_FALSE(dark.at(127, 0).needs(kHighlight));
  EXPECT_TRUE(dark.at(128, 0).needs(kHighlight));
}

TEST(Survey, SnellsRaysMayReachTheWholePicture) {
  Look snell = murky();
  snell.of<Refraction>() = {.rejection = Refraction::Rejection::kSnap, .steps = 0};
  Buffers b = tray(rect_of(kSize));
  EXPECT_EQ(survey_of(snell, b.frame).summary().opaque.cells, 15);
  snell.of<DepthFog>().density = 0.1;
  EXPECT_EQ(survey_of(snell, b.frame).summary().open.cells, 15);
  put(b, PlaneId::kDepth, 383, 79, 3);
  EXPECT_EQ(survey_of(snell, b.frame).summary().open.cells, 0);
  snell.of<Refraction>().rejection = Refraction::Rejection::kShorten;
  EXPECT_EQ(survey_of(snell, tray(rect_of(kSize)).frame).summary().open.cells, 0);
}

// Fog by the refracted path, of rays that go on for as long as the bottom under their own pixel
// lies below the surface.
TEST(Survey, AShallowPixelOpensItsCellAlone) {
  Look look = murky();
  look.of<DepthFog>().distance = DepthFog::Distance::kRefracted;
  look.of<Refraction>() = {.rejection = Refraction::Rejection::kSnap, .steps = 0};
  Buffers b = tray(rect_of(kSize));
  b.fill(PlaneId::kDepth, 24);
  put(b, PlaneId::kDepth, 40, 5, 4.5f);
  EXPECT_EQ(map_of(survey_of(look, b.frame), 3), "foo\nooo\nooo\nooo\nooo\n");
}

// Where a plane holds the surface, no depth under the calm surface is known: a march may end at
// once.
TEST(Survey, AMarchThroughWavyWaterMayBeShort) {
  Look look = murky();
  look.of<DepthFog>().distance = DepthFog::Distance::kRefracted;
  look.of<DepthFog>().density = 2;
  look.of<Refraction>() = {.rejection = Refraction::Rejection::kSnap, .steps = Refraction::kMarch};
  Buffers b = tray(rect_of(kSize));
  b.fill(PlaneId::kDepth, 4.1f);
  EXPECT_EQ(survey_of(look, b.frame).summary().opaque.cells, 0);
}

// Without a plane of the surface the surface is the scene's plane, which ends at the horizon.
TEST(Survey, TheCalmPlaneIsMetBelowTheHorizon) {
  const Size size{256, 256};
  Buffers b(rect_of(size));
  for (PlaneId id : {PlaneId::kColorR, PlaneId::kColorG, PlaneId::kColorB}) b.fill(id, 0.5f);
  b.fill(PlaneId::kDepth, 1e6f);
  Scene scene = test::simple_scene(size);
  scene.camera->view = glm::lookAt(glm::dvec3(0, 2, 0), glm::dvec3(0, 2, -1), glm::dvec3(0, 1, 0));
  const Plan plan = make_plan(short_look(), test::inputs_of(b.frame, scene));
  const Survey survey = surveyed(plan, b.frame, scene);
  EXPECT_EQ(map_of(survey, 2).substr(0, 8 * 3), "..\n..\n..\n..\n..\n..\n..\n..\n");
  EXPECT_EQ(survey.summary().dry.cells, 16);
  EXPECT_EQ(survey.summary().wet, 256 * 128);
}

TEST(Survey, ViewsThatBeginInTheWaterNeedEverything) {
  const Buffers b = tray(rect_of(kSize));
  Scene scene = scene_of(b.frame);
  scene.water->height = 1.95;
  const Plan plan = make_plan(short_look(), test::inputs_of(b.frame, scene));
  const Survey survey = surveyed(plan, b.frame, scene);
  EXPECT_EQ(survey.summary().full.cells, 15);
}

TEST(Survey, DependsOnNeitherThreadsNorInstructionSetNorWhatWasSeenBefore) {
  const Buffers b = test::noisy_frame(rect_of({300, 50}));
  const Scene scene = scene_of(b.frame);
  const Plan plan = plan_of(short_look(), b.frame, 0.01);
  const Pass pass(scene, b.frame, 1.333, plan.made);
  const Survey judge = surveyed(plan, b.frame, scene);
  Survey survey;
  survey.make(plan_of(murky(), tray(rect_of(kSize)).frame), tray(rect_of(kSize)).frame,
              Pass(scene_of(tray(rect_of(kSize)).frame), tray(rect_of(kSize)).frame, 1.333, {}),
              *make_executor(1));
  for (const std::string& simd : simd_targets()) {
    survey.make(plan, b.frame, pass, *make_executor(2), simd);
    ASSERT_EQ(survey.count(), judge.count());
    for (int i = 0; i < judge.count(); ++i) EXPECT_EQ(survey.cell(i), judge.cell(i)) << simd;
  }
}

TEST(Survey, InterleavedAndTurnedPlanesAreSeenAsTheyAre) {
  const Rect display = rect_of(kSize);
  Buffers b = tray(display);
  put(b, PlaneId::kDepth, 159, 40, 3);
  // The same depths, every third float of rows that go upwards.
  std::vector<float> floats(3 * 384 * 80, -1);
  for (int y = 0; y < 80; ++y) {
    for (int x = 0; x < 384; ++x) {
      floats[static_cast<std::size_t>(3 * ((79 - y) * 384 + x) + 1)] =
          b.frame.plane(PlaneId::kDepth).at(x, y);
    }
  }
  b.frame.planes[index_of(PlaneId::kDepth)] = {&floats[3 * 79 * 384 + 1], 3, -3 * 384, display};
  EXPECT_EQ(map_of(survey_of(short_look(), b.frame), 3), "fff\n##f\n##f\n##f\nfff\n");
}

// --- the text of a survey -----------------------------------------------------------------------

TEST(Survey, IsToldAsText) {
  Buffers b = tray(rect_of(kSize));
  b.set(PlaneId::kSurfaceDepth, [](int x, int y) { return x < 128 && y < 32 ? test::kInf : 4.0f; });
  const Plan plan = plan_of(murky(), b.frame);
  const std::string text = to_text(plan, surveyed(plan, b.frame, scene_of(b.frame)));
  EXPECT_THAT(text, HasSubstr("refraction          skipped: invisible, fog hides its effect, "
                              "it changes no bit of the picture [skip_hidden]\n"));
  EXPECT_THAT(text, HasSubstr("water_shadow        skipped: invisible, it changes no bit of the "
                              "picture [skip_invisible]\n"));
  EXPECT_THAT(text, HasSubstr("sun_highlight       kept\n"));
  EXPECT_THAT(text, HasSubstr("cells of 128x16 pixels, 86.7 % of them wet\n"));
  EXPECT_THAT(text, ContainsRegex("  dry +2 +13\\.3 %"));
  EXPECT_THAT(text, ContainsRegex("  opaque +13 +86\\.7 %"));
  EXPECT_THAT(text, ContainsRegex("  sun_highlight +86\\.7 %"));
  EXPECT_THAT(text, Not(HasSubstr("measured")));
  const std::vector<double> seconds(Chain::kCount + 1, 0.0125);
  const std::string measured = to_text(plan, surveyed(plan, b.frame, scene_of(b.frame)), seconds);
  EXPECT_THAT(measured, HasSubstr("measured"));
  EXPECT_THAT(measured, ContainsRegex("sun_highlight .* 12\\.500 ms"));
}

/// The text behind the name in the row that begins with this name.
std::string row_of(const std::string& text, const std::string& name) {
  const std::size_t at = text.find("\n  " + name + " ");
  if (at == std::string::npos) return "no row";
  const std::size_t begin = at + 3 + name.size();
  return text.substr(begin, text.find('\n', begin) - begin);
}

TEST(Survey, TextHasTheCellsPixelsAndTimesOfTheSummary) {
  Buffers b = tray({0, 0, 300, 80});  // the last cells of a row are 44 pixels wide
  b.set(PlaneId::kSurfaceDepth, [](int x, int y) { return x < 128 && y < 32 ? test::kInf : 4.0f; });
  const Plan plan = plan_of(short_look(), b.frame, 1e-3);
  const Survey survey = surveyed(plan, b.frame, scene_of(b.frame));
  const Survey::Summary& s = survey.summary();
  ASSERT_EQ(s.all.pixels, 300 * 80);
  ASSERT_EQ(s.dry.pixels, 128 * 32);
  const std::vector<double> seconds(Chain::kCount + 1, 0.002);
  const std::string text = to_text(plan, survey, seconds);
  const auto expect_cells = [&](const std::string& name, const CellCount& count) {
    int cells = -1;
    double share = -1;
    ASSERT_EQ(std::sscanf(row_of(text, name).c_str(), "%d %lf %%", &cells, &share), 2) << text;
    EXPECT_EQ(cells, count.cells) << name;
    EXPECT_NEAR(share, static_cast<double>(count.pixels) / 240, 0.051) << name;
  };
  expect_cells("all", s.all);
  expect_cells("dry", s.dry);
  expect_cells("foreground-free", s.open);
  expect_cells("full", s.full);
  double total = 0;
  int rows = 0;
  const auto expect_time = [&](const std::string& name, std::int64_t pixels, double ns) {
    double share = -1, predicted = -1, measured = -1;
    ASSERT_EQ(std::sscanf(row_of(text, name).c_str(), "%lf %% %lf ms %lf ms", &share, &predicted,
                          &measured),
              3)
        << name << ":\n"
        << text;
    EXPECT_NEAR(share, static_cast<double>(pixels) / 240, 0.051) << name;
    EXPECT_NEAR(predicted, 1e-6 * ns, 5.1e-4) << name;
    EXPECT_NEAR(measured, 2, 1e-9) << name;
    total += 1e-6 * ns;
    ++rows;
  };
  for (int i = 0; i < Chain::kCount; ++i) {
    if (!plan.keeps(i)) continue;
    const std::int64_t pixels = s.runs[static_cast<std::size_t>(i)].pixels;
    expect_time(std::string(plan.operators[static_cast<std::size_t>(i)].name), pixels,
                predicted_ns(plan, i) * static_cast<double>(pixels));
  }
  ASSERT_GT(rows, 3);
  expect_time("all else", 300 * 80,
              kPredictedWetNs * (300 * 80 - 128 * 32) + kPredictedDryNs * 128 * 32);
  double predicted = -1, measured = -1;
  ASSERT_EQ(std::sscanf(row_of(text, "sum").c_str(), "%lf ms %lf ms", &predicted, &measured), 2);
  EXPECT_NEAR(predicted, total, 5.1e-4);
  EXPECT_NEAR(measured, 2 * rows, 1e-9);
  EXPECT_THAT(text, HasSubstr("\nmax_error 0.001: no pixel has an error above "));
  EXPECT_TRUE(text.ends_with(" ms\n"));
  EXPECT_THAT(to_text(plan_of(short_look(), b.frame), survey), Not(HasSubstr("max_error")));
}

TEST(Survey, AnOperatorIsInvisibleOnlyWhereNoCellNeedsIt) {
  const Buffers b = tray(rect_of(kSize));
  const Plan plan = plan_of(short_look(), b.frame);
  const std::vector<PlannedOperator> seen =
      operators_seen(plan, surveyed(plan, b.frame, scene_of(b.frame)));
  EXPECT_EQ(seen[kShadow].verdict, Verdict::kInvisible);
  EXPECT_EQ(seen[kRefraction].verdict, Verdict::kKept);
  EXPECT_EQ(plan.operators[kShadow].verdict, Verdict::kKept) << "the plan is what is run";
}

}  // namespace
}  // namespace limpid
