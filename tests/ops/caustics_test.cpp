#include "op/pixel_start.h"
#include "op/plain_texture.h"
#include "ops/caustics_kernel.h"
#include "ops/tray.h"
#include "optics/water_index.h"

// The operator alone, with tables that are worked out by hand. complete/caustics_test.cpp tests the
// values in the tables.

namespace limpid {
namespace {

using test::Tray;

constexpr double kIor = 1.333;

/// A table whose value is base + x of the position: bilinear lookups are exact.
struct Ramp {
  explicit Ramp(double base, double per_x = 0) {
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        plane.view().at(x, y) = static_cast<float>(base + per_x * (4 * x - 128));
      }
    }
    table.count = 1;
    table.least = base - 128 * std::abs(per_x), table.most = base + 128 * std::abs(per_x);
    table.levels[0] = {plane.view(), {-128, -128}, 4};
  }
  Plane plane{rect_of({64, 64})};
  CausticsTable table;
};

/// Water 2 deep under a normal and a sun, seen straight from above, at one pixel.
struct Basin {
  Basin(const Ramp& ramp, glm::dvec3 to_sun) : tray({9, 5}) {
    tray.buffers.frame.caustics = &ramp.table;
    tray.scene.sun = Sun{.direction = glm::normalize(to_sun), .color = {3, 2, 1}};
    tray.scene.water->height = 0;
    params.sun_share = 1;
  }
  Pass pass() const { return {tray.scene, tray.buffers.frame, kIor, kWholeState}; }
  /// The light after refraction has found the bottom `drop` below the surface.
  Rgb<double> lit(int x, double drop, Vec3<double> normal = {0, 1, 0}) {
    const Pass c = pass();
    ReferenceState state(c, tray.buffers.frame, x, 2);
    state.pixel.normal = normal;
    const Refracted<double> ray = refract(state.pixel.to_viewer, normal, 1 / kIor);
    state.pixel.path = drop / -ray.direction.y;
    state.pixel.hit_depth = 10 + drop;
    return state.applied(params, c);
  }
  /// One pixel as a strip of its own.
  struct ReferenceState {
    using Number = double;
    Pixel<double> pixel;
    const Frame& frame;
    ReferenceState(const Pass& c, const Frame& of, int x, int y) : frame(of) {
      const RowRays<double> rays(c, y + 0.5);
      begin_pixel(c, rays, x + 0.5, 1.0, 10.0, 14.0, pixel);
      begin_state(kWholeState, c, Rgb<double>{0.5, 0.5, 0.5}, pixel);
    }
    struct Quad {
      double weight(int k) const { return k == 0 ? 1 : 0; }
    };
    struct Tap {
      const Frame& frame;
      static Quad quad(Vec2<double>) { return {}; }
      Four<double> read(PlaneId plane, const Quad&) const {
        const double value = frame.plane(plane).at(4, 2);
        return {value, value, value, value};
      }
      double nearest(PlaneId plane, Vec2<double>) const { return frame.plane(plane).at(4, 2); }
      static double grid(const View<const float>& table, Vec2<double> at) {
        return grid_at(table, at);
      }
    };
    template <class Fn>
    void probe(Fn&& fn) {
      fn(pixel, Tap{frame});
    }
    Rgb<double> applied(const Caustics::Params& by, const Pass& c) {
      Kernel<Caustics>::apply(by, c, *this);
      return pixel.transmitted;
    }
  };
  Tray tray;
  Caustics::Params params;
};

TEST(Caustics, MultiplyTheSunsShare) {
  const Ramp ramp(1.5);
  Basin basin(ramp, {0, 1, 0});
  test::expect_rgb(basin.lit(4, 2), {0.75, 0.75, 0.75});
  basin.params.sun_share = 0.8;
  test::expect_rgb(basin.lit(4, 2), {0.7, 0.7, 0.7});
  basin.params.strength = 0.5;
  test::expect_rgb(basin.lit(4, 2), {0.6, 0.6, 0.6});
  basin.tray.buffers.fill(PlaneId::kShadow, 0.5f);  // 0.4 of 0.6
  test::expect_rgb(basin.lit(4, 2),
                   {0.5 * (1 + 0.25 * 2 / 3), 0.5 * (1 + 0.25 * 2 / 3), 0.5 * (1 + 0.25 * 2 / 3)});
  basin.tray.buffers.fill(PlaneId::kShadow, 0);
  EXPECT_EQ(basin.lit(4, 2).r, 0.5);
}

// Light that is scattered on the 2 down to the bottom is no longer focused, even if only one color
// is scattered.
TEST(Caustics, FadeWhereTheWaterScattersThem) {
  for (int c = 0; c < 3; ++c) {
    Ramp ramp(1.5);
    ramp.table.scattered[static_cast<std::size_t>(c)] = 0.7;
    Rgb<double> expected{0.75, 0.75, 0.75};
    (c == 0 ? expected.r : c == 1 ? expected.g : expected.b) = 0.5 + 0.25 * std::exp(-0.7 * 2);
    Basin basin(ramp, {0, 1, 0});
    test::expect_rgb(basin.lit(4, 2), expected);
  }
}

// On a level bottom: 0.6 of the sun's color, and the sky.
TEST(Caustics, SunAndSkyTellTheShare) {
  const Ramp ramp(1.5);
  Basin basin(ramp, {0.8, 0.6, 0});
  basin.tray.scene.sky = SkyLight{{0.6, 0.4, 1.4}};
  const Rgb<double> lit = basin.lit(4, 2);
  test::expect_rgb(lit, {0.5 * (1 + 0.5 * 0.75), 0.5 * (1 + 0.5 * 0.75), 0.5 * (1 + 0.5 * 0.3)});
}

// At x = 0, seen straight down, light that reaches the bottom enters calm water at `aside` towards
// the sun.
TEST(Caustics, AreLookedUpWhereCalmWaterLetsTheirLightIn) {
  const Ramp ramp(1.5, 0.1);
  Basin basin(ramp, {0.8, 0.6, 0});
  const double sine = 0.8 / kIor, aside = sine / std::sqrt(1 - sine * sine);
  const double expected = 0.5 * (1.5 + 0.1 * 2 * aside);
  test::expect_rgb(basin.lit(4, 2), {expected, expected, expected});
  test::expect_rgb(basin.lit(6, 2), {expected + 0.1, expected + 0.1, expected + 0.1});
}

TEST(Caustics, FollowTheRayThatTheWaveBends) {
  const Ramp ramp(1.5, 0.1);
  Basin basin(ramp, {0, 1, 0});
  const Vec3<double> normal{0.6, 0.8, 0};
  const Refracted<double> ray = refract(Vec3<double>{0, 1, 0}, normal, 1 / kIor);
  const double x = -2 * ray.direction.x / ray.direction.y;
  const double expected = 0.5 * (1.5 + 0.1 * x);
  test::expect_rgb(basin.lit(4, 2, normal), {expected, expected, expected});
}

TEST(Caustics, AreCalmLightBeyondTheTable) {
  const Ramp ramp(3);
  Basin basin(ramp, {0, 1, 0});
  basin.tray.scene.water->height = 0;
  CausticsTable far = ramp.table;
  far.levels[0].corner = {500, 500};
  basin.tray.buffers.frame.caustics = &far;
  EXPECT_EQ(basin.lit(4, 2).r, 0.5);
}

TEST(Caustics, WhoseTableIsSharpenedBelowZeroAreNone) {
  const Ramp ramp(-0.2);
  Basin basin(ramp, {0, 1, 0});
  EXPECT_EQ(basin.lit(4, 2).r, 0);
}

TEST(Caustics, LeaveWhatHasNoBottom) {
  const Ramp ramp(3);
  Basin basin(ramp, {0, 1, 0});
  EXPECT_EQ(basin.lit(4, HUGE_VAL).r, 0.5);
}

TEST(Caustics, AreBoundByTheTablesValuesAndMeetTheirBound) {
  for (const double value : {0.3, 1.5}) {
    const Ramp ramp(value);
    Basin basin(ramp, {0, 1, 0});
    basin.params.strength = 0.5, basin.params.sun_share = 0.6;
    Ranges ranges;
    for (Range& color : ranges.color) color = {0.1, 0.5};
    ranges.shadow = {1, 1};
    ranges.transmittance = 0.25;
    Kernel<Caustics>::propagate_ranges(basin.params, basin.pass(), ranges);
    const double change = 0.25 * std::abs(basin.lit(4, 2).r - 0.5);
    const double bound = Kernel<Caustics>::bound(basin.params, basin.pass(), ranges);
    EXPECT_NEAR(change, 0.25 * 0.5 * 0.5 * 0.6 * std::abs(value - 1), 1e-7);
    EXPECT_GE(bound, change);
    EXPECT_LE(bound, 1.3 * change);
  }
}

TEST(Caustics, SunColorTellsTheSunsLight) {
  const Ramp ramp(1.5);
  Basin basin(ramp, {0, 1, 0});
  for (int c = 0; c < 3; ++c) basin.tray.buffers.fill(plane_after(PlaneId::kSunColorR, c), 0.3f);
  test::expect_rgb(basin.lit(4, 2), {0.65, 0.65, 0.65});
  basin.tray.buffers.fill(PlaneId::kShadow, 0.5f);  // the plane includes the shadow already
  basin.params.sunlight = Caustics::Sunlight::kStraight;
  test::expect_rgb(basin.lit(4, 2), {0.65, 0.65, 0.65});
  basin.tray.buffers.fill(PlaneId::kSunColorG, 9);  // the share is at most all of the light
  test::expect_rgb(basin.lit(4, 2), {0.65, 0.75, 0.65});
}

/// A bottom 4 below calm water, seen straight from above, a unit a pixel, sun from the right at 0.6
/// of the vertical: straight light goes 16 / 3 to the left on its path down, refracted light 3. A
/// board lies on the water in columns 12 ... 15.
Tray under_a_board() {
  Tray tray({24, 5});
  tray.scene.sun = Sun{.direction = {0.8, 0.6, 0}};
  const auto covered = [](double left, double right, int x) {
    return static_cast<float>(
        std::clamp(std::min(right, x + 1.0) - std::max(left, double(x)), 0.0, 1.0));
  };
  const auto lit = [=](int x, int) { return 1 - covered(12 - 16.0 / 3, 16 - 16.0 / 3, x); };
  tray.buffers.set(PlaneId::kShadow, lit);
  tray.buffers.set(PlaneId::kSurfaceShadow, [=](int x, int) { return 1 - covered(12, 16, x); });
  for (int c = 0; c < 3; ++c) {
    tray.buffers.set(plane_after(PlaneId::kSunColorR, c),
                     [=](int x, int y) { return 0.3f * lit(x, y); });
    tray.buffers.set(plane_after(PlaneId::kColorR, c),
                     [=](int x, int y) { return 0.2f + 0.3f * lit(x, y); });
  }
  tray.buffers.fill(PlaneId::kSurfaceDepth, 10).fill(PlaneId::kDepth, 14);
  tray.look.of<Caustics>() = {};
  tray.look.of<Refraction>().model = Refraction::Model::kSnell;
  return tray;
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
  tray.buffers.frame.planes[index_of(PlaneId::kSurfaceShadow)] = {};
  const test::Picture wet = tray.wet();
  for (const int x : {10, 11}) EXPECT_NEAR(wet.color(x, 2).r, 0.2, 1e-3) << x;
  for (const int x : {4, 5, 7, 14, 16}) EXPECT_NEAR(wet.color(x, 2).r, 0.5, 1e-3) << x;
}

// Beside a step, the bottom in the direction of the sun is another.
TEST(Caustics, LeaveShadowsWhoseBottomElsewhereIsNotShown) {
  Tray tray = under_a_board();
  tray.buffers.frame.planes[index_of(PlaneId::kSurfaceShadow)] = {};
  tray.buffers.set(PlaneId::kDepth, [](int x, int) { return x < 7 ? 11.0f : 14.0f; });
  const test::Picture wet = tray.wet();
  for (const int x : {8, 9}) EXPECT_NEAR(wet.color(x, 2).r, 0.2, 1e-3) << x;
}

TEST(Caustics, LeaveShadowsThatAreCastInTheWater) {
  Tray tray = under_a_board();
  tray.buffers.fill(PlaneId::kSurfaceShadow, 1);  // the caster of the shadow lies deeper
  const test::Picture wet = tray.wet();
  for (const int x : {7, 8, 9}) EXPECT_NEAR(wet.color(x, 2).r, 0.2, 1e-6) << x;
  EXPECT_NEAR(wet.color(14, 2).r, 0.5, 1e-6);
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
  EXPECT_EQ(preferred(shadows, kRefracted),
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

// The shadow plane shows the object in front of bottom that is filled in, and no surface shows the
// shadow on it.
TEST(Caustics, LeaveTheSunOnBottomThatIsFilledIn) {
  const Ramp ramp(1);
  Basin basin(ramp, {0.8, 0.6, 0});
  for (int c = 0; c < 3; ++c) basin.tray.buffers.fill(plane_after(PlaneId::kSunColorR, c), 0.3f);
  basin.tray.buffers.fill(PlaneId::kShadow, 0).fill(PlaneId::kDepth, 11);
  const Pass c = basin.pass();
  for (const double filled : {0.0, 1.0}) {
    Basin::ReferenceState state(c, basin.tray.buffers.frame, 4, 2);
    state.pixel.path = 4, state.pixel.hit_depth = 14;
    state.pixel.dry_lit_known = filled;
    state.applied(basin.params, c);
    EXPECT_EQ(state.pixel.dry_lit, filled);
    EXPECT_EQ(state.pixel.dry_lit_known, filled);
  }
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

// Red is bent less than green, blue more: in the view and in the light.
TEST(Caustics, PartColorsAsTheirIndicesDo) {
  const Ramp ramp(1.5, 0.1);
  Basin basin(ramp, {0.8, 0.6, 0});
  const Pass c = basin.pass();
  Basin::ReferenceState state(c, basin.tray.buffers.frame, 4, 2);
  state.pixel.path = 2, state.pixel.hit_depth = 12;
  state.pixel.dispersion = {-0.02, 0, 0.03};
  const Rgb<double> lit = state.applied(basin.params, c);
  const auto expected = [](double index) {
    const double sine = 0.8 / index;
    return 0.5 * (1.5 + 0.1 * 2 * sine / std::sqrt(1 - sine * sine));
  };
  test::expect_rgb(lit, {expected(kIor - 0.02), expected(kIor), expected(kIor + 0.03)});
}

}  // namespace
}  // namespace limpid
