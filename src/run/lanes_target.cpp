// Compiled once for each instruction set, with that set's flags, and LIMPID_LANES_TARGET as its
// name. Every function instantiated here depends on the Lane type of the set, so that the linker
// cannot put a function compiled for one CPU into the code for another.
#include "core/target_name.h"
#include "ops/kernels.h"
#include "run/flush_denormals.h"
#include "run/fused_strip.h"

namespace limpid::HWY_NAMESPACE {
namespace {

/// Charges the time since the last call to an operator, if the run is timed.
struct LapTimer {
  StopClock* clock;
  StopClock::Laps taken{};
  std::int64_t last = 0;

  LIMPID_LANES_INLINE explicit LapTimer(StopClock* c) : clock(c) {
    if (clock) last = clock->now();
  }
  LIMPID_LANES_INLINE void charge(int whom) {
    if (!clock) return;
    const std::int64_t now = clock->now();
    taken[whom] += now - last;
    last = now;
  }
};

/// A run of pixels of a row with the same needs.
struct Segment {
  int end;  ///< column after the last
  CellNeeds needs;
};

LIMPID_LANES_INLINE bool same(const CellNeeds& a, const CellNeeds& b) {
  return a.skips == b.skips && a.dry == b.dry && a.open == b.open && a.opaque == b.opaque &&
         a.grounded == b.grounded;
}

LIMPID_LANES_INLINE const Pass& pass_for(const FusedJob& job, const CellNeeds& needs) {
  return job.passes[(needs.open ? 1 : 0) + (needs.grounded ? 2 : 0)];
}

LIMPID_LANES_INLINE Segment segment_from(const FusedJob& job, const Rect& tile, int x, int y) {
  const Rect work = job.frame.work();
  const CellNeeds* row = job.cells + (y - work.y0) / Survey::kCell.height * job.cells_across;
  const int most = x + kStripPixels < tile.x1 ? x + kStripPixels : tile.x1;
  int cell = (x - work.x0) / Survey::kCell.width;
  const CellNeeds& needs = row[cell];
  int end;
  do {
    ++cell;
    end = work.x0 + cell * Survey::kCell.width;
  } while (end < most && same(row[cell], needs));
  return {end < most ? end : most, needs};
}

void run_segment(const FusedJob& job, const RowRays<Lane>& rays, int y, int x,
                 const Segment& segment, LapTimer& laps) {
  const CellNeeds& needs = segment.needs;
  FusedStrip strip(job, y, x, segment.end);
  StateSet begins = job.begins;
  for (int i = 0; i < Chain::kCount; ++i) {
    if (job.keeps[i] && !needs.needs(i)) begins = begins | job.makes[i];
  }
  const bool wet = !needs.dry && strip.begin(rays, begins);
  laps.charge(StopClock::kRest);
  // Refraction is skipped: these are its results.
  if (needs.opaque) strip.each([](Pixel<Lane>& p) { p.hit_depth = p.path = Lane(HUGE_VAL); });
  if (wet) {
    const Pass& pass = pass_for(job, needs);
    Kernels::for_each([&]<class Op, int I>() {
      if (!job.keeps[I] || !needs.needs(I)) return;
      Op::apply(std::get<typename Op::Params>(job.plan.look.operators), pass, strip);
      laps.charge(I);
    });
  }
  strip.end();
  laps.charge(StopClock::kRest);
}

__attribute__((noinline)) void run_rows(const FusedJob& job, const Rect& tile) {
  LapTimer laps(job.clock);
  for (int y = tile.y0; y < tile.y1; ++y) {
    const RowRays<Lane> rays(job.pass, y - job.pass.corner.y + 0.5);
    for (int x = tile.x0; x < tile.x1;) {
      const Segment segment = segment_from(job, tile, x, y);
      run_segment(job, rays, y, x, segment, laps);
      x = segment.end;
    }
  }
  if (job.clock) job.clock->add(laps.taken);
}

void run_tile(const FusedJob& job, const Rect& tile) {
  const FlushDenormals flush;
  run_rows(job, tile);
}

}  // namespace
}  // namespace limpid::HWY_NAMESPACE

namespace limpid {

#define LIMPID_TEXT_(a) #a
#define LIMPID_TEXT(a) LIMPID_TEXT_(a)

extern const FusedTarget LIMPID_OF_TARGET(kFused_);
const FusedTarget LIMPID_OF_TARGET(kFused_) = {LIMPID_TEXT(LIMPID_LANES_TARGET),
                                               HWY_NAMESPACE::kLanes, HWY_NAMESPACE::run_tile};

}  // namespace limpid
