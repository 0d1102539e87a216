#include "limpid/run/fused.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <limits>

#include "limpid/core/error.h"

#include "complete/completer.h"
#include "complete/heights.h"
#include "plan/pass_of.h"
#include "run/checks.h"
#include "run/fused_tile.h"
#include "run/put_edges.h"
#include "run/show_planes.h"

namespace limpid {

// One for each instruction set that the build names, defined in lanes_target.cpp.
#define LIMPID_TARGET(name, highway) extern const FusedTarget kFused_##name;
#include "core/targets.inc"
#undef LIMPID_TARGET

namespace {

constexpr const FusedTarget* kTargets[] = {
#define LIMPID_TARGET(name, highway) &kFused_##name,
#include "core/targets.inc"
#undef LIMPID_TARGET
};

/// State that is read before an operator makes it.
StateSet begins_of(const Plan& plan, const Target& target) {
  StateSet begins, made, shown = kOutputTerms;
  for (int i = 0; i < Chain::kCount; ++i) {
    if (!plan.keeps(i)) continue;
    begins = begins | (operators()[i].uses - made);
    made = made | operators()[i].makes;
  }
  for (int a = 0; a < kAovCount; ++a) {
    if (target.aovs[a][0]) shown = shown | aovs()[a].parts;
  }
  return begins | (shown - made);
}

void check_extent(const View<const float>& view) {
  const std::int64_t last = std::abs(std::int64_t{view.y_stride}) * view.window.height() +
                            std::abs(std::int64_t{view.x_stride}) * view.window.width();
  if (last > std::numeric_limits<std::int32_t>::max()) {
    throw Error("frame: a plane spans " + std::to_string(last) + " floats, expected at most 2^31");
  }
}

class SteadyClock : public StopClock {
 public:
  std::int64_t now() override {
    return std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1);
  }
  void add(const Laps& laps) override {
    for (std::size_t i = 0; i < laps.size(); ++i) sums_[i] += laps[i];
  }
  RunTimes times() const {
    RunTimes times;
    for (std::size_t i = 0; i < times.operators.size(); ++i) {
      times.operators[i] = 1e-9 * static_cast<double>(sums_[i]);
    }
    times.rest = 1e-9 * static_cast<double>(sums_[kRest]);
    return times;
  }

 private:
  std::array<std::atomic<std::int64_t>, Chain::kCount + 1> sums_{};
};

/// The survey's cells, as they run. Long runs of pixels are faster than short ones: two adjacent
/// cells both run the operators that either needs, unless one is dry. The pairs do not depend on
/// tiles.
void pair_cells(const Survey& survey, std::vector<CellNeeds>& cells) {
  cells.clear();
  for (int i = 0; i < survey.count(); ++i) cells.push_back(survey.cell(i));
  const int across = survey.across();
  for (int left = 0; left + 1 < survey.count(); ++left) {
    CellNeeds &a = cells[static_cast<std::size_t>(left)],
              &b = cells[static_cast<std::size_t>(left) + 1];
    const int column = left % across;
    if (column % 2 == 1 || column + 1 == across || a.dry || b.dry) continue;
    a.skips = b.skips = a.skips & b.skips;
    a.open = b.open = a.open && b.open;
    a.opaque = b.opaque = a.opaque && b.opaque;
    a.grounded = b.grounded = a.grounded && b.grounded;
  }
}

struct Tiles {
  const FusedJob& job;
  const FusedTarget& target;
  Rect work;
  Size tile;
  int across;
  std::stop_token stop;

  static void run(void* context, int index) {
    const Tiles& t = *static_cast<const Tiles*>(context);
    if (t.stop.stop_requested()) return;
    const int x0 = t.work.x0 + index % t.across * t.tile.width;
    const int y0 = t.work.y0 + index / t.across * t.tile.height;
    t.target.run_tile(t.job, intersection({x0, y0, x0 + t.tile.width, y0 + t.tile.height}, t.work));
  }
};

}  // namespace

struct __attribute__((visibility("hidden"))) FusedRunner::Kept {
  Completer completer;
  Survey survey;
  Heights heights;
  std::vector<CellNeeds> cells;
};

FusedRunner::FusedRunner() : kept_(std::make_unique<Kept>()) {}
FusedRunner::FusedRunner(FusedRunner&&) noexcept = default;
FusedRunner& FusedRunner::operator=(FusedRunner&&) noexcept = default;
FusedRunner::~FusedRunner() = default;

const Survey& FusedRunner::survey() const { return kept_->survey; }

void FusedRunner::run(const Plan& plan, const Frame& plate, const Scene& scene,
                      const Target& target, Executor& executor, const FusedOptions& options) {
  const FusedTarget& simd = *kTargets[simd_index(options.simd)];
  check_run(plan, plate, scene, target);
  expect_wanted(options.stop);
  for (const View<const float>& view : plate.planes) check_extent(view);
  for (const View<const float>& view : plate.wave_map.channels) check_extent(view);
  for (const View<const float>& view : plate.environment.channels) check_extent(view);
  const Rect work = plate.work();
  const Size tile{std::min(options.tile.width, work.width()),
                  std::min(options.tile.height, work.height())};
  if (tile.width < 1 || tile.height < 1) {
    throw Error("tile of " + std::to_string(tile.width) + "x" + std::to_string(tile.height) +
                " pixels: expected at least 1x1");
  }
  auto& [completer, survey, heights, cells] = *kept_;
  const Frame frame =
      completer.complete(plan, plate, pass_of(plan, scene, plate), executor, &options.simd);
  expect_wanted(options.stop);
  Pass pass = pass_of(plan, scene, frame);
  pass.plate_waves = completer.plate_waves();
  if (!plan.reads_environment) pass.environment = {};  // not checked
  survey.make(plan, frame, pass, executor, options.simd);
  if (options.leaps) {
    heights.make(plan, frame, pass, executor, options.simd);
    pass.heights = heights.bound();
    pass.mirrored = heights.mirrored();
    pass.lit = heights.lit();
  }
  expect_wanted(options.stop);
  const auto pass_for = [&](bool open, bool grounded) {
    Pass of_cell = pass;
    of_cell.foreground = !open;
    of_cell.bottomless = !grounded;
    return of_cell;
  };
  const std::array<Pass, FusedJob::kPasses> passes{pass_for(false, false), pass_for(true, false),
                                                   pass_for(false, true), pass_for(true, true)};
  FusedJob job{plan, frame, passes[0], passes.data(), target};
  pair_cells(survey, cells);
  job.cells = cells.data();
  job.cells_across = survey.across();
  job.begins = begins_of(plan, target);
  for (int i = 0; i < Chain::kCount; ++i) {
    job.keeps[i] = plan.keeps(i);
    job.makes[i] = operators()[i].makes;
  }
  for (int i = 0; i < kPlaneCount; ++i) job.missing[i] = missing_value(static_cast<PlaneId>(i));
  for (int i = 0; i < kAovCount; ++i) job.dry_aov[i] = aovs()[i].dry;
  const View<const float>& depth = frame.plane(PlaneId::kDepth);
  for (int i = 0; i < kPlaneCount; ++i) {
    const View<const float>& plane = frame.planes[i];
    job.like_depth[i] = plane && plane.window == depth.window && plane.y_stride == depth.y_stride &&
                        plane.x_stride == 1 && depth.x_stride == 1 && depth.window.width() > 1;
  }
  for (const auto& views : target.aovs) job.writes_aovs |= bool(views[0]);
  SteadyClock clock;
  if (options.times) job.clock = &clock;
  const int across = (work.width() + tile.width - 1) / tile.width;
  const int down = (work.height() + tile.height - 1) / tile.height;
  Tiles tiles{job, simd, work, tile, across, options.stop};
  executor.run(across * down, Tiles::run, &tiles);
  expect_wanted(options.stop);
  put_edges(frame, target, executor);
  show_planes(plan, frame, target, executor);
  if (options.times) *options.times = clock.times();
}

void run_fused(const Plan& plan, const Frame& frame, const Scene& scene, const Target& target,
               Executor& executor, const FusedOptions& options) {
  FusedRunner().run(plan, frame, scene, target, executor, options);
}

}  // namespace limpid
