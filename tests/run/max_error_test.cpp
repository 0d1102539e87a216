#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "plan/patchy_frame.h"

// A run keeps the promise of its plan: no channel of a pixel is off by more than max_error.

namespace limpid {
namespace {

using test::Picture;

class MaxError : public testing::TestWithParam<int> {
 protected:
  Picture run(double max_error, StateSet outputs, const FusedOptions& options = {},
              int threads = 1) const {
    const Plan plan = make_plan(look_, test::inputs_of(frame(), scene_), outputs, max_error);
    Picture picture(frame().work());
    Target target = picture.target;
    target.aovs = {};
    run_fused(plan, frame(), scene_, target, *make_executor(threads), options);
    return picture;
  }
  const Frame& frame() const { return buffers_.frame; }

  /// Calls visit(value, other value, place) for each channel of each pixel.
  template <class Visit>
  void compare(const Picture& a, const Picture& b, Visit&& visit) const {
    const Rect work = frame().work();
    for (int y = work.y0; y < work.y1; ++y) {
      for (int x = work.x0; x < work.x1; ++x) {
        const std::string place = std::to_string(x) + ", " + std::to_string(y);
        for (int c = 0; c < 3; ++c) {
          visit(a.target.color[c].at(x, y), b.target.color[c].at(x, y), place);
        }
        visit(a.target.alpha.at(x, y), b.target.alpha.at(x, y), place);
      }
    }
  }
  void expect_same_bits(const Picture& a, const Picture& b, const char* what) const {
    compare(a, b, [&](float x, float y, const std::string& place) {
      EXPECT_EQ(std::memcmp(&x, &y, sizeof x), 0) << x << ", " << y << " at " << place << what;
    });
  }

  Rect display_ = test::patchy_display(GetParam());
  test::Buffers buffers_ = test::patchy_frame(display_, GetParam());
  Scene scene_ = test::patchy_scene(display_);
  Look look_ = test::patchy_look(GetParam());
};

TEST_P(MaxError, ZeroChangesNotABit) {
  const Picture exact = run(0, {});
  // If all state is to be written, no operator is hidden.
  expect_same_bits(exact, run(0, test::all_state()), " with all state");
}

TEST_P(MaxError, NoChannelIsOffByMore) {
  const Picture exact = run(0, {});
  for (const double error : {1e-4, 2e-3, 5e-2}) {
    compare(run(error, {}), exact, [&](float got, float want, const std::string& place) {
      EXPECT_LE(std::abs(got - want), error + 2e-6 * (1 + std::abs(want)))
          << place << ", max_error " << error;
    });
  }
}

TEST_P(MaxError, TilesAndThreadsDoNotMatter) {
  const Picture whole = run(2e-3, {});
  expect_same_bits(whole, run(2e-3, {}, {.tile = {5, 3}}, 2), " in tiles of 5x3");
  expect_same_bits(whole, run(2e-3, {}, {.tile = {200, 40}}, 2), " in tiles of 200x40");
}

INSTANTIATE_TEST_SUITE_P(Patches, MaxError, testing::Range(0, 60));

}  // namespace
}  // namespace limpid
