// Compiled once for each instruction set, with that set's flags and LIMPID_LANES_TARGET naming it.
// All that is instantiated here depends on the Lane type of the set, so that no function compiled
// for one machine can be linked into the path of another.
#include "run/fused_strip.h"

namespace limpid::HWY_NAMESPACE {
namespace {

/// Charges the time since it was asked last to somebody, when the run is timed.
struct Laps {
  StopClock* clock;
  StopClock::Laps taken{};
  std::int64_t last = 0;

  LIMPID_LANES_INLINE explicit Laps(StopClock* c) : clock(c) {
    if (clock) last = clock->now();
  }
  LIMPID_LANES_INLINE void charge(int whom) {
    if (!clock) return;
    const std::int64_t now = clock->now();
    taken[whom] += now - last;
    last = now;
  }
};

void run_tile(const FusedJob& job, const Rect& tile) {
  Laps laps(job.clock);
  for (int y = tile.y0; y < tile.y1; ++y) {
    const RowRays<Lane> rays(job.context, y - job.context.corner.y + 0.5);
    for (int x = tile.x0; x < tile.x1; x += kStripPixels) {
      const int end = x + kStripPixels < tile.x1 ? x + kStripPixels : tile.x1;
      FusedStrip strip(job, y, x, end);
      const bool wet = strip.begin(rays);
      laps.charge(StopClock::kRest);
      if (wet) {
        Chain::for_each([&]<class Op, int I>() {
          if (!job.keeps[I]) return;
          Op::apply(std::get<typename Op::Params>(job.plan.look.operators), job.context, strip);
          laps.charge(I);
        });
      }
      strip.end();
      laps.charge(StopClock::kRest);
    }
  }
  if (job.clock) job.clock->add(laps.taken);
}

}  // namespace
}  // namespace limpid::HWY_NAMESPACE

namespace limpid {

#define LIMPID_JOIN_(a, b) a##b
#define LIMPID_JOIN(a, b) LIMPID_JOIN_(a, b)
#define LIMPID_TEXT_(a) #a
#define LIMPID_TEXT(a) LIMPID_TEXT_(a)

extern const FusedTarget LIMPID_JOIN(kFused_, LIMPID_LANES_TARGET);
const FusedTarget LIMPID_JOIN(kFused_, LIMPID_LANES_TARGET) = {
    LIMPID_TEXT(LIMPID_LANES_TARGET), HWY_NAMESPACE::kLanes, HWY_NAMESPACE::run_tile};

}  // namespace limpid
