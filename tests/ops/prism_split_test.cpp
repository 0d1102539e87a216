#include "ops/prism_split_kernel.h"
#include "ops/probe_strip.h"
#include "ops/tray.h"
#include "optics/water_index.h"

namespace limpid {
namespace {

using test::Tray;

/// Every channel is x + 1000 y. Tilt (.48, .36); strength 1/12 on 50 x 100 pixels: a split of
/// (.04, .03) uv = (2, 3) pixels.
Tray counting_tray() {
  Tray tray({50, 100});
  for (PlaneId id : {PlaneId::kColorR, PlaneId::kColorG, PlaneId::kColorB}) {
    tray.buffers.set(id, [](int x, int y) { return float(x + 1000 * y); });
  }
  tray.buffers.normal({0.48, 0.8, 0.36});
  tray.look.of<PrismSplit>().strength = 1.0 / 12;
  return tray;
}

TEST(PrismSplit, RedAcrossGreenHalfwayBlueDown) {
  const test::Picture got = counting_tray().wet();
  test::expect_rgb(rgb_of(got, Aov::kTransmitted, 10, 20), {20012, 21511, 23010}, 0.05);
}

TEST(PrismSplit, ComesOnTopOfTheRefraction) {
  Tray tray = counting_tray();
  tray.look.of<Refraction>().strength = 1.0 / 12;
  const test::Picture got = tray.wet();
  test::expect_rgb(rgb_of(got, Aov::kTransmitted, 10, 20), {23014, 24513, 26012}, 0.05);
}

TEST(PrismSplit, ZeroIsOneLookupForAllChannels) {
  Tray tray = counting_tray();
  tray.look.of<PrismSplit>().strength = 0;
  test::expect_rgb(rgb_of(tray.wet(), Aov::kTransmitted, 10, 20), {20010, 20010, 20010}, 0);
}

TEST(PrismSplit, CalmWaterDoesNotSplit) {
  Tray tray = counting_tray();
  tray.buffers.normal({0, 1, 0});
  test::expect_rgb(rgb_of(tray.wet(), Aov::kTransmitted, 10, 20), {20010, 20010, 20010}, 0);
}

// The planner looks as far for objects before the water: tilts are below 1.
TEST(PrismSplit, ReachesAsFarAsTheSteepestTilt) {
  const PrismSplit::Params params{PrismSplit::Model::kAxis, 0.25, 0};
  test::ProbeStrip strip;
  strip.pixels.push_back(test::random_pixel(1, {}));
  strip.pixels[0].tilt = {1, 1};
  const test::Buffers buffers = test::noisy_frame(rect_of({4, 3}));
  Kernel<PrismSplit>::apply(params, Pass(test::simple_scene({4, 3}), buffers.frame, 1.333, {}),
                            strip);
  EXPECT_NEAR(strip.pixels[0].prism_r.x, Kernel<PrismSplit>::reach(params), 1e-12);
  EXPECT_NEAR(strip.pixels[0].prism_b.y, Kernel<PrismSplit>::reach(params), 1e-12);
}

// In a thin prism a channel's offset is (n - 1) / (n of green - 1) of green's.
TEST(PrismSplit, StretchesOffsetsByTheIndexAlone) {
  const test::Buffers buffers = test::noisy_frame(rect_of({4, 3}));
  const auto stretch = [&](const PrismSplit::Params& params, double ior) {
    return Kernel<PrismSplit>::stretch(params,
                                       Pass(test::simple_scene({4, 3}), buffers.frame, ior, {}));
  };
  const Rgb<double> index = water_index_rgb();
  const double widest = std::max(index.g - index.r, index.b - index.g);
  EXPECT_NEAR(stretch({PrismSplit::Model::kDispersion, 0, 3}, 1.333), 1 + 3 * widest / 0.333,
              1e-12);
  EXPECT_EQ(stretch({PrismSplit::Model::kDispersion, 0, 3}, 1), 1) << "nothing is bent";
  EXPECT_EQ(stretch({PrismSplit::Model::kAxis, 0.25, 3}, 1.333), 1);
}

TEST(PrismSplit, ReflectionIsNotSplit) {
  Tray tray = counting_tray();
  for (int c = 0; c < 3; ++c) {
    tray.buffers.set(plane_after(PlaneId::kReflectionR, c), [](int x, int) { return float(x); });
  }
  tray.look.of<FresnelReflection>().strength = 0;
  const Rgb<double> mirrored = rgb_of(tray.wet(), Aov::kReflected, 10, 20);
  EXPECT_EQ(mirrored.r, mirrored.g);
  EXPECT_EQ(mirrored.r, mirrored.b);
}

}  // namespace
}  // namespace limpid
