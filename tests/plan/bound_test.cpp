#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "complete/completer.h"
#include "op/ranges.h"
#include "ops/depth_fog_kernel.h"
#include "ops/kernels.h"
#include "ops/water_shadow_kernel.h"
#include "plan/patchy_frame.h"

// The declared bound of each operator, on whole frames whose ranges are found pixel by pixel, with
// any of the other operators running.

namespace limpid {
namespace {

using test::Picture;

constexpr int kFinder = Chain::index_of<Refraction>();
constexpr Range kNothing{HUGE_VAL, -HUGE_VAL};

void widen(Range& range, double value) {
  range = {std::min(range.min, value), std::max(range.max, value)};
}

void widen(Range& range, const View<const float>& view) {
  for (int y = view.window.y0; y < view.window.y1; ++y) {
    for (int x = view.window.x0; x < view.window.x1; ++x) widen(range, view.at(x, y));
  }
}

/// The ranges of the frame, with all values of its planes in reach. False where no pixel is wet.
bool ranges_of(const Frame& frame, const Pass& pass, Ranges& ranges) {
  ranges.surface = ranges.own = ranges.looked_up = ranges.sink = kNothing;
  ranges.shadow = ranges.own_shadow = {1, 1};
  ranges.ray_length = kNothing;
  const Rect work = frame.work();
  const View<const float>& surface = frame.plane(PlaneId::kSurfaceDepth);
  const PlaneId own_shadow =
      frame.plane(PlaneId::kSurfaceShadow) ? PlaneId::kSurfaceShadow : PlaneId::kShadow;
  if (frame.plane(own_shadow)) ranges.own_shadow = kNothing;
  for (int y = work.y0; y < work.y1; ++y) {
    const RowRays<double> rays(pass, y - pass.corner.y + 0.5);
    for (int x = work.x0; x < work.x1; ++x) {
      const double at = x - pass.corner.x + 0.5;
      const double water = surface ? surface.at(x, y) : rays.calm_depth(at);
      const double dry = frame.plane(PlaneId::kDepth).at(x, y);
      if (!(water < dry)) continue;
      const glm::dvec3 ray = pass.rays.ray_at(at, y - pass.corner.y + 0.5);
      widen(ranges.surface, water);
      widen(ranges.own, dry - water);
      widen(ranges.sink, -glm::dot(pass.up, ray));
      widen(ranges.ray_length, glm::length(ray));
      if (frame.plane(own_shadow)) widen(ranges.own_shadow, frame.plane(own_shadow).at(x, y));
    }
  }
  const SeenPlanes planes = SeenPlanes::of(pass);
  widen(ranges.looked_up, frame.plane(planes.depth));
  for (int c = 0; c < 3; ++c) {
    Range& color = ranges.color[static_cast<std::size_t>(c)];
    color = kNothing;
    widen(color, frame.plane(plane_after(planes.color, c)));
    widen(color, frame.plane(plane_after(PlaneId::kColorR, c)));
    // Pixels where nothing was hit show no light.
    if (!std::isfinite(ranges.own.max) || !std::isfinite(ranges.looked_up.max)) widen(color, 0.0);
  }
  if (frame.plane(PlaneId::kShadow)) {
    ranges.shadow = kNothing;
    widen(ranges.shadow, frame.plane(PlaneId::kShadow));
  }
  return ranges.surface.min <= ranges.surface.max;
}

double farthest(const Picture& a, const Picture& b, const Rect& work) {
  double most = 0;
  for (int y = work.y0; y < work.y1; ++y) {
    for (int x = work.x0; x < work.x1; ++x) {
      for (int c = 0; c < 3; ++c) {
        const double want = a.target.color[c].at(x, y), got = b.target.color[c].at(x, y);
        // The bound holds within rounding to float.
        most = std::max(most, std::abs(want - got) - 1e-6 * (1 + std::abs(want)));
      }
    }
  }
  return most;
}

/// By how much operators change the picture when refraction finds another place.
double displaced(const Plan& plan, const Ranges& ranges) {
  double sum = 0;
  if (plan.keeps<DepthFog>()) {
    sum += Kernel<DepthFog>::displaced(plan.look.of<DepthFog>(), ranges);
  }
  if (plan.keeps<WaterShadow>()) {
    sum += Kernel<WaterShadow>::displaced(plan.look.of<WaterShadow>(), ranges);
  }
  return sum;
}

struct Known {
  int runs = 0;        ///< frames in which the operator runs
  int finite = 0;      ///< frames in which the bound is finite
  double closest = 0;  ///< largest change over bound
};

TEST(Bound, NoOperatorMattersMoreThanItSays) {
  std::array<Known, Chain::kCount> known;
  Known hidden;
  int with_shafts = 0;
  for (int seed = 0; seed < 400; ++seed) {
    const Rect display = rect_of({40, 30});
    const test::Buffers buffers = test::patchy_frame(display, seed);
    const Scene scene = test::patchy_scene(display);
    const Frame& frame = buffers.frame;
    const Plan whole = make_plan(test::patchy_look(seed), test::inputs_of(frame, scene));
    Plan plan = whole;
    const auto skip = [](Plan& from, int op) { from.operators[op].verdict = Verdict::kInvisible; };
    // The operator that finds the path for others stays. Draws go by name, whatever else is in the
    // chain.
    Kernels::for_each([&]<class Op, int I>() {
      int draw = 0;
      for (const char letter : Op::kName) draw += letter;
      if (I != kFinder && plan.keeps(I) && test::noise(seed, draw, 5) < 0.3f) skip(plan, I);
    });
    Completer completer;
    const Frame completed = completer.complete(
        whole, frame, Pass(scene, frame, plan.look.water.ior, plan.made), *make_executor(1));
    const Pass pass(scene, completed, plan.look.water.ior, plan.made);
    Ranges ranges;
    Frame shaded = frame;  // of what completers make, ranges know the shadow alone
    shaded.planes[index_of(PlaneId::kSurfaceShadow)] = completed.plane(PlaneId::kSurfaceShadow);
    if (!ranges_of(shaded, pass, ranges)) continue;
    ranges.hit = ranges.own;
    ranges.path = {0, 0};
    ranges.light = ranges.brightest();
    Kernels::for_each([&]<class Op, int I>() {
      if constexpr (requires { Op::propagate_ranges(plan.look.of<Op>(), pass, ranges); }) {
        if (whole.keeps(I)) Op::propagate_ranges(plan.look.of<Op>(), pass, ranges);
      }
    });
    const CausticsTable* in_water = pass.caustics ? pass.caustics->in_water : nullptr;
    with_shafts += plan.keeps<WaterShadow>() && in_water && in_water->count > 0;
    const bool fog = plan.keeps<DepthFog>();
    if (!fog) ranges.transmittance = 1;
    const Picture all = test::picture_of(plan, frame, scene, test::by_reference);
    Kernels::for_each([&]<class Op, int I>() {
      if (!plan.keeps(I)) return;
      ++known[I].runs;
      double bound = Op::bound(plan.look.of<Op>(), pass, ranges);
      if (std::is_same_v<Op, Kernel<Refraction>>) bound += displaced(plan, ranges);
      ASSERT_GE(bound, 0) << Op::kName;
      if (!std::isfinite(bound)) return;
      Plan without = plan;
      skip(without, I);
      const double change =
          farthest(all, test::picture_of(without, frame, scene, test::by_reference), frame.work());
      EXPECT_LE(change, bound * (1 + 1e-6)) << Op::kName << ", seed " << seed;
      ++known[I].finite;
      if (bound > 0) known[I].closest = std::max(known[I].closest, change / bound);
    });
    if (!fog || !plan.keeps<Refraction>()) continue;
    double beyond = Kernel<DepthFog>::beyond(plan.look.of<DepthFog>(), pass, ranges);
    beyond += displaced(plan, ranges);
    if (!std::isfinite(beyond)) continue;
    CellNeeds opaque;
    opaque.opaque = true;
    opaque.skips = 1u << kFinder;
    const double change =
        farthest(all, test::run_as(opaque, plan, frame, scene, test::by_reference), frame.work());
    EXPECT_LE(change, beyond * (1 + 1e-6)) << "seed " << seed;
    ++hidden.finite;
    if (beyond > 0) hidden.closest = std::max(hidden.closest, change / beyond);
  }
  EXPECT_EQ(known[Chain::index_of<WaveNormals>()].finite, 0) << "all hangs on the normals";
  // A bound that no change nearly reaches is useless.
  int ran = 0;
  Kernels::for_each([&]<class Op, int I>() {
    if (std::is_same_v<Op, Kernel<WaveNormals>> || known[I].runs == 0) return;
    ++ran;
    EXPECT_GT(known[I].finite, 10) << Op::kName;
    // The brightest place of a table of noise hardly ever meets the brightest texel: see
    // ops/caustics_test.cpp.
    const bool of_table = std::is_same_v<Op, Kernel<Caustics>>;
    EXPECT_GT(known[I].closest, of_table ? 0.1 : 0.4) << Op::kName;
  });
  EXPECT_GE(ran, 7) << "patchy_look() varies them";
  EXPECT_GT(with_shafts, 20);
  EXPECT_GT(hidden.finite, 100);
  EXPECT_GT(hidden.closest, 0.95);
}

}  // namespace
}  // namespace limpid
