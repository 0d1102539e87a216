#include "ops/caustics_kernel.h"
#include "ops/tray.h"
#include "plan/surveyed.h"

// Caustics::Sunlight::kRefracted: shadows move and slopes reflect as the water bends the sun's
// light. caustics_test.cpp tests the light that waves focus.

namespace limpid {
namespace {

using test::Tray;

/// Sets the share of sunlight on the bottom, and the colors under it: the sun has 1.5 times the
/// light of the sky.
template <class Lit>
void light(Tray& tray, const Lit& lit) {
  tray.buffers.set(PlaneId::kShadow, lit);
  for (int c = 0; c < 3; ++c) {
    tray.buffers.set(plane_after(PlaneId::kSunColorR, c),
                     [=](int x, int y) { return 0.3f * lit(x, y); });
    tray.buffers.set(plane_after(PlaneId::kColorR, c),
                     [=](int x, int y) { return 0.2f + 0.3f * lit(x, y); });
  }
}

/// A bottom 4 below calm water, seen straight from above, a unit a pixel, sun from the right at 0.6
/// of the vertical: straight light goes 16 / 3 to the left on its path down, refracted light 3. A
/// board lies on the water in columns 12 ... 15.
Tray under_a_board(int rows = 5) {
  Tray tray({24, rows});
  tray.scene.sun = Sun{.direction = {0.8, 0.6, 0}};
  const auto covered = [](double left, double right, int x) {
    return static_cast<float>(
        std::clamp(std::min(right, x + 1.0) - std::max(left, double(x)), 0.0, 1.0));
  };
  const auto lit = [=](int x, int) { return 1 - covered(12 - 16.0 / 3, 16 - 16.0 / 3, x); };
  light(tray, lit);
  tray.buffers.set(PlaneId::kSurfaceShadow, [=](int x, int) { return 1 - covered(12, 16, x); });
  tray.buffers.fill(PlaneId::kSurfaceDepth, 10).fill(PlaneId::kDepth, 14);
  tray.look.of<Caustics>() = {};
  tray.look.of<Refraction>().model = Refraction::Model::kSnell;
  return tray;
}

/// Without a shadow on the surface, as on a host's device, where no completer makes one.
test::Picture wet_without_surface_shadow(Tray& tray) {
  tray.buffers.frame.planes[index_of(PlaneId::kSurfaceShadow)] = {};
  Plan plan = make_plan(tray.look, test::inputs_of(tray.buffers.frame, tray.scene));
  plan.completed = plan.completed - PlaneSet{PlaneId::kSurfaceShadow};
  return test::picture_of(plan, tray.buffers.frame, tray.scene, test::by_reference);
}

TEST(Caustics, MoveShadowsToWhereTheWaterBendsThem) {
  Tray tray = under_a_board();
  const test::Picture dry = [&] {
    Tray straight = under_a_board();
    straight.look.of<Caustics>().sunlight = Caustics::Sunlight::kStraight;
    return straight.wet();
  }();
  const test::Picture wet = tray.wet();
  for (const int x : {7, 8, 9}) EXPECT_NEAR(dry.color(x, 2).r, 0.2, 1e-6) << x;
  for (const int x : {10, 11}) EXPECT_NEAR(wet.color(x, 2).r, 0.2, 1e-6) << x;
  EXPECT_NEAR(dry.color(11, 2).r, 0.5, 1e-6);
  // The pixels that straight light leaves dark are as bright as their neighbours.
  for (const int x : {4, 5, 7, 14, 16}) EXPECT_NEAR(wet.color(x, 2).r, 0.5, 1e-3) << x;
}

// The shadow on the bottom alone tells where the water bends it, too.
TEST(Caustics, MoveShadowsThatNoSurfaceTells) {
  Tray tray = under_a_board();
  const test::Picture without = wet_without_surface_shadow(tray), completed = tray.wet();
  for (const test::Picture* wet : {&without, &completed}) {
    for (const int x : {10, 11}) EXPECT_NEAR(wet->color(x, 2).r, 0.2, 1e-3) << x;
    for (const int x : {4, 5, 7, 14, 16}) EXPECT_NEAR(wet->color(x, 2).r, 0.5, 1e-3) << x;
  }
}

// A deck over the water from column 12 on, without a surface that ends there: the calm water under
// it gets no light, whatever the shadow on that water says.
TEST(Caustics, LetNoLightInUnderLand) {
  Tray tray = under_a_board();
  light(tray, [](int x, int) { return x < 7 || x > 11 ? 1.0f : 0.0f; });
  tray.buffers.frame.planes[index_of(PlaneId::kSurfaceDepth)] = {};
  tray.buffers.set(PlaneId::kDepth, [](int x, int) { return x < 12 ? 14.0f : 9.0f; });
  tray.buffers.fill(PlaneId::kSurfaceShadow, 1);
  const test::Picture wet = tray.wet();
  for (const int x : {3, 7}) EXPECT_NEAR(wet.color(x, 2).r, 0.5, 1e-3) << x;
  for (const int x : {10, 11}) EXPECT_NEAR(wet.color(x, 2).r, 0.2, 1e-3) << x;
}

// Without sun_color, too. The light of the sun, 1.5 times that of the sky, is told by the scene, or
// by the edges of the shadow if it has enough of them.
TEST(Caustics, MoveShadowsOfASunThatIsEstimated) {
  for (const int which : {0, 1, 2, 3}) {
    const bool of_surface = which % 2 == 1, told_by_edges = which >= 2;
    const int rows = told_by_edges ? 101 : 5, row = rows / 2;
    Tray tray = under_a_board(rows);
    if (!told_by_edges) tray.scene.sky = {{0.4, 0.4, 0.4}};
    for (int c = 0; c < 3; ++c) {
      tray.buffers.frame.planes[index_of(plane_after(PlaneId::kSunColorR, c))] = {};
    }
    if (!of_surface) tray.buffers.frame.planes[index_of(PlaneId::kSurfaceShadow)] = {};
    const test::Picture wet = tray.wet();
    for (const int x : {10, 11}) EXPECT_NEAR(wet.color(x, row).r, 0.2, 1e-3) << x;
    for (const int x : {4, 5, 7, 14, 16}) EXPECT_NEAR(wet.color(x, row).r, 0.5, 1e-3) << x;
  }
}

// Beside a step, the bottom in the direction of the sun is another.
TEST(Caustics, LeaveShadowsWhoseBottomElsewhereIsNotShown) {
  Tray tray = under_a_board();
  tray.buffers.set(PlaneId::kDepth, [](int x, int) { return x < 7 ? 11.0f : 14.0f; });
  const test::Picture wet = wet_without_surface_shadow(tray);
  for (const int x : {8, 9}) EXPECT_NEAR(wet.color(x, 2).r, 0.2, 1e-3) << x;
}

// A bottom 8 deep, over which refraction moves the sun's light by 14 / 3, is in shade in columns 3
// to 5. Where it rises there towards the sun, the shade is its own, and nothing casts it.
TEST(Caustics, LeaveTheShadeOfSlopesThatFaceAway) {
  Tray tray = under_a_board();
  const auto lit = [](int x, int) { return x < 3 || x > 5 ? 1.0f : 0.0f; };
  light(tray, lit);
  for (const bool rises : {false, true}) {
    tray.buffers.set(PlaneId::kDepth,
                     [=](int x, int) { return rises && x > 3 && x < 7 ? 17.0f : 18.0f; });
    EXPECT_NEAR(wet_without_surface_shadow(tray).color(8, 2).r, rises ? 0.5 : 0.2, 0.01) << rises;
  }
}

TEST(Caustics, LeaveShadowsThatAreCastInTheWater) {
  Tray tray = under_a_board();
  tray.buffers.fill(PlaneId::kSurfaceShadow, 1);  // the caster of the shadow lies deeper
  const test::Picture wet = tray.wet();
  for (const int x : {7, 8, 9}) EXPECT_NEAR(wet.color(x, 2).r, 0.2, 1e-6) << x;
  EXPECT_NEAR(wet.color(14, 2).r, 0.5, 1e-6);
}

// A block in columns 12 ... 15 is 3 high: straight light leaves 4 columns beside it dark, refracted
// light 2.25. A block that the picture does not show, because it is flat there, may be as long.
TEST(Caustics, ShortenShadowsOfObjectsInTheWater) {
  for (const bool shown : {true, false}) {
    Tray tray = under_a_board();
    const auto lit = [](int x, int) { return x < 8 || x > 11 ? 1.0f : 0.0f; };
    light(tray, lit);
    tray.buffers.fill(PlaneId::kSurfaceShadow, 1);
    tray.buffers.set(PlaneId::kDepth,
                     [=](int x, int) { return shown && x > 11 && x < 16 ? 11.0f : 14.0f; });
    const test::Picture wet = tray.wet();
    for (const int x : {10, 11}) EXPECT_NEAR(wet.color(x, 2).r, 0.2, 1e-3) << x;
    EXPECT_NEAR(wet.color(8, 2).r, shown ? 0.5 : 0.2, 1e-3);
    EXPECT_NEAR(wet.color(5, 2).r, 0.5, 1e-3);
  }
}

// Over a shallow bottom, which is everywhere near below the way of straight light, too.
TEST(Caustics, LeaveShadowsOnAFlatBottom) {
  Tray tray = under_a_board();
  tray.scene.water->height = -3.9;  // 13.9 away: the water is 0.1 deep
  tray.buffers.fill(PlaneId::kSurfaceDepth, 13.9f).fill(PlaneId::kSurfaceShadow, 1);
  const test::Picture wet = tray.wet();
  for (const int x : {7, 8, 9}) EXPECT_NEAR(wet.color(x, 2).r, 0.2, 1e-3) << x;
  EXPECT_NEAR(wet.color(14, 2).r, 0.5, 1e-3);
}

// In the edge of such a shadow, where straight light passes the block by less than a pixel.
TEST(Caustics, LeaveNoOutlineOfShadowsOfObjectsInTheWater) {
  Tray tray = under_a_board();
  const auto lit = [](int x, int) { return x < 7 || x > 11 ? 1.0f : x == 7 ? 0.4f : 0.0f; };
  light(tray, lit);
  tray.buffers.fill(PlaneId::kSurfaceShadow, 1);
  tray.buffers.set(PlaneId::kDepth, [](int x, int) { return x > 11 && x < 16 ? 11.0f : 14.0f; });
  const test::Picture wet = tray.wet();
  for (const int x : {6, 7, 8}) EXPECT_NEAR(wet.color(x, 2).r, 0.5, 1e-3) << x;
}

// Something hides the bottom, which the layer below shows; what hides it is in the sun.
TEST(Caustics, MoveShadowsOfHiddenPlaces) {
  Tray tray = under_a_board();
  for (int c = 0; c < 3; ++c) {
    const View<const float> floor = tray.buffers.frame.plane(plane_after(PlaneId::kColorR, c));
    tray.buffers.set(plane_after(PlaneId::kBelowR, c),
                     [&](int x, int y) { return floor.at(x, y); });
    tray.buffers.fill(plane_after(PlaneId::kColorR, c), 0.5f);
    tray.buffers.fill(plane_after(PlaneId::kSunColorR, c), 0.3f);
  }
  tray.buffers.fill(PlaneId::kBelowDepth, 14).fill(PlaneId::kDepth, 12).fill(PlaneId::kShadow, 1);
  const test::Picture wet = tray.wet();
  for (const int x : {10, 11}) EXPECT_NEAR(wet.color(x, 2).r, 0.2, 1e-3) << x;
  for (const int x : {4, 5, 7, 14, 16}) EXPECT_NEAR(wet.color(x, 2).r, 0.5, 1e-3) << x;
}

// On land beside the water the sun shines, but no light enters there.
TEST(Caustics, MoveShadowsOfTheShore) {
  Tray tray = under_a_board();
  tray.buffers.fill(PlaneId::kSurfaceShadow, 1);
  tray.buffers.set(PlaneId::kSurfaceDepth,
                   [](int x, int) { return x >= 12 && x < 16 ? test::kInf : 10.0f; });
  const test::Picture wet = tray.wet();
  for (const int x : {10, 11}) EXPECT_NEAR(wet.color(x, 2).r, 0.2, 1e-6) << x;
  for (const int x : {4, 5, 7}) EXPECT_NEAR(wet.color(x, 2).r, 0.5, 1e-3) << x;
}

/// A bottom that rises to the right, without the board.
Tray on_a_slope(double rise, double deepest = 14.003) {
  Tray tray = under_a_board();
  tray.buffers.fill(PlaneId::kShadow, 1).fill(PlaneId::kSurfaceShadow, 1);
  for (int c = 0; c < 3; ++c) {
    tray.buffers.fill(plane_after(PlaneId::kSunColorR, c), 0.3f);
    tray.buffers.fill(plane_after(PlaneId::kColorR, c), 0.5f);
  }
  tray.buffers.set(PlaneId::kDepth,
                   [=](int x, int) { return static_cast<float>(deepest - rise * (x - 12)); });
  return tray;
}

// Straight light goes 4 / 3 to the left per unit of depth, refracted light 3 / 4.
TEST(Caustics, LightSlopesAsTheWaterBendsTheSun) {
  for (const double rise : {-0.25, 0.0, 0.25}) {
    const double expected = 0.2 + 0.3 * (1 - 0.75 * rise) / (1 - 4.0 / 3 * rise);
    const test::Picture wet = on_a_slope(rise).wet();
    for (int x = 0; x < 24; ++x) {
      EXPECT_NEAR(wet.color(x, 2).r, expected, 3e-4) << rise << " at " << x;
    }
    Tray straight = on_a_slope(rise);
    straight.look.of<Caustics>().sunlight = Caustics::Sunlight::kStraight;
    EXPECT_NEAR(straight.wet().color(12, 2).r, 0.5, 1e-6);
  }
}

// Down the picture is towards +z: the same slopes, turned.
TEST(Caustics, LightSlopesDownThePictureLikeSlopesAlongIt) {
  for (const double rise : {-0.25, 0.25}) {
    Tray tray = on_a_slope(0);
    tray.scene.sun = Sun{.direction = {0, 0.6, 0.8}};
    tray.buffers.set(PlaneId::kDepth,
                     [=](int, int y) { return static_cast<float>(14.003 - rise * (y - 2)); });
    const double expected = 0.2 + 0.3 * (1 - 0.75 * rise) / (1 - 4.0 / 3 * rise);
    for (int y = 0; y < 5; ++y) EXPECT_NEAR(tray.wet().color(12, y).r, expected, 3e-4) << rise;
  }
}

TEST(Caustics, LightSlopesOfPlatesWithoutShadows) {
  Tray tray = on_a_slope(0.25);
  for (const PlaneId shadow : {PlaneId::kShadow, PlaneId::kSurfaceShadow}) {
    tray.buffers.frame.planes[index_of(shadow)] = {};
  }
  EXPECT_NEAR(tray.wet().color(12, 2).r, 0.2 + 0.3 * 0.8125 * 1.5, 3e-4);
}

TEST(Caustics, SayWhatThePlateHasNoPlanesFor) {
  const auto preferred = [](PlaneSet planes, Caustics::Sunlight asked) {
    Caustics::Params params{.sunlight = asked};
    const std::string said(Kernel<Caustics>::prefer(params, {.planes = planes}));
    return std::pair(said, params.sunlight);
  };
  const PlaneSet shadows{PlaneId::kShadow, PlaneId::kSurfaceShadow};
  using enum Caustics::Sunlight;
  EXPECT_EQ(preferred({}, kStraight), std::pair(std::string(), kStraight));
  EXPECT_EQ(
      preferred(shadows, kRefracted),
      std::pair(std::string("no sun_color, the strength of sunlight is estimated"), kRefracted));
  EXPECT_EQ(preferred(PlaneSet{PlaneId::kSurfaceShadow}, kRefracted),
            std::pair(std::string("sunlight on the bottom stays unrefracted"), kStraight));
  EXPECT_EQ(preferred(kSunColorPlanes, kRefracted),
            std::pair(std::string("shadows on the bottom stay unrefracted"), kRefracted));
  EXPECT_EQ(preferred(kSunColorPlanes | PlaneSet{PlaneId::kSurfaceShadow}, kRefracted),
            std::pair(std::string("shadows on the bottom stay unrefracted"), kRefracted));
  EXPECT_EQ(preferred(kSunColorPlanes | PlaneSet{PlaneId::kShadow}, kRefracted),
            std::pair(std::string(), kRefracted));
  EXPECT_EQ(preferred(kSunColorPlanes | shadows, kRefracted), std::pair(std::string(), kRefracted));
}

TEST(Caustics, LightSlopesWithoutFocusingToo) {
  Tray tray = on_a_slope(0.25);
  tray.look.of<Caustics>().strength = 0;
  EXPECT_NEAR(tray.wet().color(12, 2).r, 0.2 + 0.3 * 0.8125 * 1.5, 3e-4);
}

// At most twice the light; none on a slope that refracted light cannot reach.
TEST(Caustics, LightSteepSlopesWithinBounds) {
  EXPECT_NEAR(on_a_slope(0.7).wet().color(12, 2).r, 0.2 + 0.3 * 2, 1e-6);
  EXPECT_NEAR(on_a_slope(1.5).wet().color(12, 2).r, 0.2, 1e-6);
}

// A step is no slope, on whichever side of it a pixel lies.
TEST(Caustics, SeeNoSlopeAcrossAnEdge) {
  Tray tray = on_a_slope(0);
  tray.buffers.set(PlaneId::kDepth, [](int x, int) { return x < 12 ? 14.003f : 11.7f; });
  const test::Picture wet = tray.wet();
  for (int x = 0; x < 24; ++x) EXPECT_NEAR(wet.color(x, 2).r, 0.5, 1e-4) << x;
}

// Steps of half precision would look like slopes.
TEST(Caustics, SeeNoSlopeInDepthsOfHalfPrecision) {
  EXPECT_NEAR(on_a_slope(0.25, 14).wet().color(12, 2).r, 0.5, 1e-6);
}

/// A crest in front hides the entry points from column 10 on, and shows its own shadow.
Tray behind_a_crest() {
  Tray tray = under_a_board();
  tray.buffers.set(PlaneId::kSurfaceDepth, [](int x, int) { return x >= 10 ? 7.0f : 10.0f; });
  return tray;
}

// The shadow on the bottom then tells where the water bends it.
TEST(Caustics, MoveShadowsWhoseEntryPointAWaveHides) {
  const test::Picture wet = behind_a_crest().wet();
  EXPECT_NEAR(wet.color(7, 2).r, 0.5, 1e-3);
  for (const int x : {10, 11}) EXPECT_NEAR(wet.color(x, 2).r, 0.2, 1e-3) << x;
}

TEST(Caustics, LeaveShadowsOfWhichNeitherSurfaceNorBottomTells) {
  Tray tray = behind_a_crest();
  tray.buffers.set(PlaneId::kDepth, [](int x, int) { return x < 7 ? 11.0f : 14.0f; });
  const test::Picture wet = tray.wet();
  for (const int x : {8, 9}) EXPECT_NEAR(wet.color(x, 2).r, 0.2, 1e-6) << x;
}

// A board over the water hides the near part of it from the view. Light enters there, as behind it.
TEST(Caustics, LetLightInWhereTheWaterIsHidden) {
  constexpr Size kSize{64, 48};
  constexpr double kFloor = -1.5, kBoard = 0.4, kEnds = 2.5;
  Scene scene = test::simple_scene(kSize);
  scene.sun = Sun{.direction = {0, 0.6, 0.8}, .color = {3, 3, 3}};
  test::Buffers b(rect_of(kSize));
  const Rays rays = rays_of(*scene.camera, {kSize.width, kSize.height});
  struct Seen {
    double board, floor, water;  ///< eye depths
  };
  const auto seen = [&](int y) {
    const glm::dvec3 ray = rays.ray_at(32, y + 0.5);
    const auto at = [&](double height) { return ray.y < 0 ? (height - 2) / ray.y : HUGE_VAL; };
    return Seen{-at(kBoard) * ray.z < kEnds ? at(kBoard) : HUGE_VAL, at(kFloor), at(0)};
  };
  b.set(PlaneId::kDepth,
        [&](int, int y) { return static_cast<float>(std::min(seen(y).board, seen(y).floor)); });
  b.set(PlaneId::kBelowDepth, [&](int, int y) { return static_cast<float>(seen(y).floor); });
  b.set(PlaneId::kSurfaceDepth, [&](int, int y) {
    return seen(y).board < HUGE_VAL ? test::kInf : static_cast<float>(seen(y).water);
  });
  b.fill(PlaneId::kShadow, 1).fill(PlaneId::kSurfaceShadow, 1);
  for (int c = 0; c < 3; ++c) {
    b.fill(plane_after(PlaneId::kColorR, c), 0.5f).fill(plane_after(PlaneId::kSunColorR, c), 0.3f);
    b.fill(plane_after(PlaneId::kBelowR, c), 0.5f);
  }
  Look look = test::still_look();
  look.of<Caustics>() = {};
  look.of<Refraction>().model = Refraction::Model::kSnell;
  const test::Picture wet = test::reference(look, b.frame, scene);
  int rows = 0;
  for (int y = 0; y < kSize.height; ++y) {
    if (!(seen(y).water < 20) || seen(y).board < HUGE_VAL) continue;
    EXPECT_NEAR(wet.color(32, y).r, 0.5, 0.02) << y;
    ++rows;
  }
  EXPECT_GT(rows, 8);
}

// The whole visible surface lies in shadow. At the right edge light enters beyond the picture,
// where shadows are unknown; the light between the two has no step.
TEST(Caustics, LoseShadowsTowardsTheEdgeOfThePicture) {
  Tray tray = under_a_board();
  tray.buffers.fill(PlaneId::kSurfaceShadow, 0).fill(PlaneId::kShadow, 1);
  for (int c = 0; c < 3; ++c) {
    tray.buffers.fill(plane_after(PlaneId::kSunColorR, c), 0.3f);
    tray.buffers.fill(plane_after(PlaneId::kColorR, c), 0.5f);
  }
  const test::Picture wet = tray.wet();
  EXPECT_NEAR(wet.color(12, 2).r, 0.2, 1e-6);
  EXPECT_NEAR(wet.color(22, 2).r, 0.5, 1e-6);
  int between = 0;
  for (int x = 12; x < 22; ++x) {
    EXPECT_GE(wet.color(x + 1, 2).r, wet.color(x, 2).r - 1e-6) << x;
    between += wet.color(x, 2).r > 0.21 && wet.color(x, 2).r < 0.49;
  }
  EXPECT_GT(between, 0);
}

}  // namespace
}  // namespace limpid
