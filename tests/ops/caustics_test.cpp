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
  basin.params.sunlight = Caustics::Sunlight::kStraight;
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

// The shadow plane shows the object in front of bottom that is filled in, and no surface shows the
// shadow on it. Of a layer that is not lit, the light stays whole, and is not known.
TEST(Caustics, LeaveTheSunOnBottomThatIsFilledIn) {
  const Ramp ramp(1);
  Basin basin(ramp, {0.8, 0.6, 0});
  for (int c = 0; c < 3; ++c) basin.tray.buffers.fill(plane_after(PlaneId::kSunColorR, c), 0.3f);
  basin.tray.buffers.fill(PlaneId::kShadow, 0).fill(PlaneId::kDepth, 11);
  Pass c = basin.pass();
  BottomLayer layer{};
  c.bottom_layer = &layer;
  for (const bool lit : {false, true}) {
    layer.lit = lit;
    for (const double filled : {0.0, 1.0}) {
      Basin::ReferenceState state(c, basin.tray.buffers.frame, 4, 2);
      state.pixel.path = 4, state.pixel.hit_depth = 14;
      state.pixel.filled = filled;
      state.applied(basin.params, c);
      EXPECT_EQ(state.pixel.dry_lit, filled);
      EXPECT_EQ(state.pixel.dry_lit_known, lit ? filled : 0);
    }
  }
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
