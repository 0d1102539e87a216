#include "limpid/plan/survey.h"

#include <gtest/gtest.h>

#include "plan/surveyed.h"

namespace limpid {
namespace {

using test::Buffers;
using test::surveyed;

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
Look look() {
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
  const Survey survey = survey_of(look(), b.frame);
  EXPECT_EQ(map_of(survey, 3), "fff\nfff\nfff\nfff\nfff\n");
  EXPECT_EQ(survey.summary().open.cells, 15);
  EXPECT_EQ(survey.summary().open.pixels, 384 * 80);
  EXPECT_EQ(survey.summary().wet, 384 * 80);
  EXPECT_EQ(survey.summary().bound, 0);
}

TEST(Survey, DryCellsAreToldApart) {
  Buffers b = tray(rect_of(kSize));
  b.set(PlaneId::kSurfaceDepth, [](int x, int y) { return x < 128 && y < 32 ? test::kInf : 4.0f; });
  EXPECT_EQ(map_of(survey_of(look(), b.frame), 3), ".ff\n.ff\nfff\nfff\nfff\n")
      << "the depth of a dry pixel may still lie behind the surface";
  put(b, PlaneId::kSurfaceDepth, 127, 31, 5.9f);
  EXPECT_EQ(map_of(survey_of(look(), b.frame), 3), ".ff\nfff\nfff\nfff\nfff\n") << "one wet pixel";
}

// What stands before the water is in reach of the cells around it, if near enough to their edge:
// within 4 pixels and 2 for filtering, and then as far as the 32 x 16 pixels of its block go.
TEST(Survey, ForegroundAtTheEdgeOfACellCountsForItsNeighbour) {
  const auto map_with = [&](int x, int y, const Look& look) {
    Buffers b = tray(rect_of(kSize));
    put(b, PlaneId::kDepth, x, y, 3);
    return map_of(survey_of(look, b.frame), 3);
  };
  EXPECT_EQ(map_with(192, 40, look()), "fff\nf#f\nf#f\nf#f\nfff\n");
  EXPECT_EQ(map_with(160, 40, look()), "fff\nf#f\nf#f\nf#f\nfff\n");
  EXPECT_EQ(map_with(159, 40, look()), "fff\n##f\n##f\n##f\nfff\n");
  EXPECT_EQ(map_with(127, 40, look()), "fff\n##f\n##f\n##f\nfff\n");
  EXPECT_EQ(map_with(255, 0, look()), "f##\nf##\nfff\nfff\nfff\n");
  EXPECT_EQ(map_with(256, 79, look()), "fff\nfff\nfff\nf##\nf##\n");
}

}  // namespace
}  // namespace limpid
