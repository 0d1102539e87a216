#include <array>
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "plan/patchy_frame.h"

// The operators that the planner leaves out change no channel by more than the planner says.

namespace limpid {
namespace {

using test::Picture;

constexpr int kSeeds = 120;

/// How many opaque and open cells surveys found, and how many skip each operator.
struct Found {
  int opaque = 0, open = 0;
  std::array<int, Chain::kCount> skipped{};

  void count(const Survey& survey) {
    for (int i = 0; i < survey.count(); ++i) {
      const CellNeeds& needs = survey.cell(i);
      opaque += needs.opaque;
      open += needs.open;
      for (int op = 0; op < Chain::kCount; ++op) skipped[op] += !needs.dry && !needs.needs(op);
    }
  }
};

template <class... Ops>
void expect_skipped(const Found& found) {
  (..., [&] { EXPECT_GT(found.skipped[Chain::index_of<Ops>()], 0) << Ops::kName; }());
}

struct Job {
  explicit Job(int seed)
      : display(test::patchy_display(seed)),
        buffers(test::patchy_frame(display, seed)),
        scene(test::patchy_scene(display)),
        look(test::patchy_look(seed)) {}
  Plan plan(double max_error) const {
    return make_plan(look, test::inputs_of(buffers.frame, scene), {}, max_error);
  }
  Rect display;
  test::Buffers buffers;
  Scene scene;
  Look look;
};

TEST(Promise, WithoutAnErrorNotABitIsAnother) {
  Found found;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const Job job(seed);
    const Frame& frame = job.buffers.frame;
    const Plan plan = job.plan(0);
    const Survey survey = test::surveyed_completed(plan, frame, job.scene);
    const Picture whole = test::picture_of(plan, frame, job.scene, test::by_fused);
    test::for_each_as_surveyed(survey, plan, frame, job.scene, test::by_fused,
                               [&](const CellNeeds& needs, int x, int y, const Picture& picture) {
                                 for (int c = 0; c < 3; ++c) {
                                   const float want = whole.target.color[c].at(x, y);
                                   const float got = picture.target.color[c].at(x, y);
                                   ASSERT_EQ(std::memcmp(&want, &got, sizeof want), 0)
                                       << "seed " << seed << " at " << x << ", " << y << ": " << got
                                       << " for " << want << ", skips " << needs.skips
                                       << (needs.opaque ? " opaque" : "");
                                 }
                               });
    ASSERT_EQ(survey.summary().bound, 0);
    found.count(survey);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(found.opaque, 0);
  EXPECT_GT(found.open, 0);
  expect_skipped<PrismSplit, Refraction, WaterShadow, SunHighlight>(found);
}

TEST(Promise, WithAnErrorNoChannelIsOffByMore) {
  Found found;
  double closest = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const Job job(seed);
    const Frame& frame = job.buffers.frame;
    const Picture exact = test::picture_of(job.plan(0), frame, job.scene, test::by_reference);
    for (double error : {1e-4, 2e-3, 5e-2}) {
      const Plan plan = job.plan(error);
      const Survey survey = test::surveyed_completed(plan, frame, job.scene);
      test::for_each_as_surveyed(
          survey, plan, frame, job.scene, test::by_reference,
          [&](const CellNeeds& needs, int x, int y, const Picture& picture) {
            if (testing::Test::HasFatalFailure()) return;
            ASSERT_LE(needs.bound, error * (1 + 1e-5));
            for (int c = 0; c < 3; ++c) {
              const double want = exact.target.color[c].at(x, y);
              const double got = picture.target.color[c].at(x, y);
              ASSERT_LE(std::abs(got - want), needs.bound + 1e-6 * (1 + std::abs(want)))
                  << "seed " << seed << ", error " << error << " at " << x << ", " << y << ": "
                  << got << " for " << want << ", skips " << needs.skips
                  << (needs.opaque ? " opaque" : "");
              if (needs.bound > 0) closest = std::max(closest, std::abs(got - want) / needs.bound);
            }
          });
      found.count(survey);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(found.opaque, 0);
  expect_skipped<PrismSplit, Refraction, DepthFog, WaterShadow, SunHighlight, Penetration>(found);
  EXPECT_GT(closest, 0.9) << "bounds could be tighter";
}

}  // namespace
}  // namespace limpid
