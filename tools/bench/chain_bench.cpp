#include "chain_bench.h"

#include <algorithm>
#include <cstdio>
#include <limits>

#include <opencv2/core/utility.hpp>

#include "limpid/files/text/look_file.h"
#include "limpid/run/fused.h"
#include "limpid/run/reference.h"

#include "interleaved.h"
#include "llvmpipe_chain.h"
#include "memory_floor.h"
#include "opencv_chain.h"

namespace limpid::bench {
namespace {

constexpr double kLargestMeanError = 2e-3;

/// Clears the canvas, so that no row passes with the picture of the row before.
void spoil(const Target& target) {
  for (const View<float>& view : target.color) {
    for (int y = view.window.y0; y < view.window.y1; ++y) {
      std::fill_n(view.row(y), view.window.width(), std::numeric_limits<float>::quiet_NaN());
    }
  }
}

Look look_named(const char* name) {
  return load_look(LIMPID_DATA "/looks/" + std::string(name) + ".toml");
}

/// The look with the work of the rivals, which look up the unfiltered map at every distance.
Look unfiltered(Look look) {
  look.of<WaveNormals>().filter = WaveNormals::Filter::kNone;
  return look;
}

}  // namespace

JudgedLook::JudgedLook(const Look& a_look, const MadePlate& plate)
    : look(a_look),
      plan(make_plan(look, {.planes = plate.frame.present(), .wave_map = true, .sun = true})),
      judge(plate.frame.display) {}

ChainBench::ChainBench(const std::string& label, const Arguments& arguments)
    : arguments_(arguments),
      plate_(size_of(label)),
      realistic_(unfiltered(look_named("realistic")), plate_),
      physical_(look_named("physical"), plate_),
      fast_(look_named("fast"), plate_),
      numbers_(realistic_.look, plate_.frame, plate_.scene),
      scalar_{numbers_, plate_.frame, plate_.frame.wave_map.channels[0].window.size(),
              interleaved(plate_.frame.wave_map.channels)},
      executors_{make_executor(1), make_executor(2)},
      canvas_(plate_.frame.display) {
  canvas_.target.alpha = {};  // rivals write no alpha
  add_rows(label);
  arguments.expect_rows(!rows_.empty());
  for (ChainRow& row : rows_) check(row);
}

void ChainBench::add_rows(const std::string& label) {
  const Frame& frame = plate_.frame;
  for (int threads : {1, 2}) {
    add("memory floor", nullptr, threads, [&](const Target& target, Executor& executor) {
      run_memory_floor(frame, target, executor);
    });
  }
  add_reference();
  for (int threads : {1, 2}) {
    add("OpenCV chain", &realistic_, threads, [this, threads](const Target& target, Executor&) {
      cv::setNumThreads(threads);
      run_opencv_chain(numbers_, plate_.frame, target);
    });
  }
  for (int threads : {1, 2}) {
    add("scalar loop, -O3", &realistic_, threads, [&](const Target& target, Executor& executor) {
      run_scalar_loop(scalar_, target, executor);
    });
  }
  for (int threads : {1, 2}) {
    add("scalar loop, -march=native", &realistic_, threads,
        [&](const Target& target, Executor& executor) {
          run_scalar_loop_native(scalar_, target, executor);
        });
  }
  for (int threads : {1, 2}) add_llvmpipe(label, threads);
  const std::string best = arguments_.best_simd();
  const std::vector<std::string> targets =
      arguments_.simd.empty() ? simd_targets() : std::vector<std::string>{best};
  for (const std::string& simd : targets) add_fused("fused " + simd, simd, realistic_, 1);
  add_fused("fused " + best, best, realistic_, 2);
  add_fused("fused " + best + ", look physical", best, physical_, 1);
  add_fused("fused " + best + ", look fast", best, fast_, 1);
}

void ChainBench::add(const std::string& name, JudgedLook* judged, int threads, Paint paint) {
  const std::string full = name + (threads == 1 ? ", 1 thread" : ", 2 threads");
  if (!arguments_.wants_row(full)) return;
  Executor& executor = *executors_[threads - 1];
  const auto run = [this, paint, &executor] {
    return seconds_of([&] { paint(canvas_.target, executor); });
  };
  rows_.push_back({{full, run}, judged});
}

/// The first round of the reference gives the picture that judges the other rows.
void ChainBench::add_reference() {
  add("reference, double", nullptr, 1, [this](const Target& target, Executor&) {
    run_reference(realistic_.plan, plate_.frame, plate_.scene, target);
  });
  if (rows_.empty() || rows_.back().name != "reference, double, 1 thread") return;
  judge(realistic_);
  rows_.back().best_seconds = realistic_.reference_seconds;
  rows_.back().most_rounds = numbers_.size.height > 1080 ? 0 : 1;
}

void ChainBench::add_llvmpipe(const std::string& label, int threads) {
  const std::string name = threads == 1 ? "llvmpipe, 1 thread" : "llvmpipe, 2 threads";
  if (!arguments_.wants_row(name)) return;
  GlProcess& process = *processes_.emplace_back(std::make_unique<GlProcess>(label, threads));
  const auto fetch = [this, &process] {
    const Size size = numbers_.size;
    const std::size_t width = static_cast<std::size_t>(size.width);
    const std::vector<float> picture =
        process.picture(3 * width * static_cast<std::size_t>(size.height));
    const float* from = picture.data();
    for (const View<float>& to : canvas_.target.color) {
      for (int y = 0; y < size.height; ++y, from += width) std::copy_n(from, width, to.row(y));
    }
  };
  rows_.push_back({{name, [&process] { return process.draw(); }}, &realistic_, fetch});
}

void ChainBench::add_fused(const std::string& name, const std::string& simd, JudgedLook& look,
                           int threads) {
  add(name, &look, threads, [this, simd, &look](const Target& target, Executor& executor) {
    run_fused(look.plan, plate_.frame, plate_.scene, target, executor, {.simd = simd});
  });
}

void ChainBench::judge(JudgedLook& look) {
  if (look.reference_seconds > 0) return;
  look.reference_seconds =
      seconds_of([&] { run_reference(look.plan, plate_.frame, plate_.scene, look.judge.target); });
}

void ChainBench::check(ChainRow& row) {
  if (!row.judged) return;
  judge(*row.judged);
  spoil(canvas_.target);
  row.run();
  row.fetch();
  row.error = error_of(row.judged->judge.target, canvas_.target);
  if (row.error.mean <= kLargestMeanError) return;
  char means[64];
  std::snprintf(means, sizeof means, "%.2g, expected at most %.2g", row.error.mean,
                kLargestMeanError);
  throw Error(row.name + ": mean error against the reference is " + means);
}

std::string ChainBench::renderer() const {
  return processes_.empty() ? "" : processes_[0]->renderer();
}

std::optional<PictureError> ChainBench::fast_error() const {
  if (fast_.reference_seconds == 0 || physical_.reference_seconds == 0) return {};
  return error_of(physical_.judge.target, fast_.judge.target);
}

Size size_of(const std::string& label) {
  return label == "4K" ? Size{3840, 2160} : Size{1920, 1080};
}

std::unique_ptr<GlDrawing> llvmpipe_chain(const std::string& label) {
  const MadePlate plate(size_of(label));
  const Look look = unfiltered(look_named("realistic"));
  return std::make_unique<LlvmpipeChain>(RealisticNumbers(look, plate.frame, plate.scene),
                                         plate.frame);
}

}  // namespace limpid::bench
