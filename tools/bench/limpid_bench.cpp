// Times the runners on the look `realistic`, each beside its error against the reference and beside
// the rival, in one run: rounds go over all rows in turn, so that a noisy neighbour hits them
// alike; the best round counts.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <opencv2/core/utility.hpp>

#include "limpid/load/look_file.h"
#include "limpid/run/fused.h"
#include "limpid/run/reference.h"

#include "arguments.h"
#include "canvas.h"
#include "made_plate.h"
#include "opencv_chain.h"

namespace limpid::bench {
namespace {

struct Row {
  std::string name;
  std::function<void(const Target&)> run;
  int most_rounds = std::numeric_limits<int>::max();
  double best_seconds = 1e30;
  double mean_error = 0, p9999_error = 0, max_error = 0;
};

/// 0 where there is no such row.
double seconds_of(const std::vector<Row>& rows, std::string_view name) {
  for (const Row& row : rows) {
    if (row.name == name) return row.best_seconds;
  }
  return 0;
}

void measure_error(const Target& judge, const Target& got, Row& row) {
  std::vector<double> errors;
  for (int c = 0; c < 3; ++c) {
    const Rect& w = judge.color[c].window;
    for (int y = w.y0; y < w.y1; ++y) {
      for (int x = w.x0; x < w.x1; ++x) {
        errors.push_back(std::abs(double(judge.color[c].at(x, y)) - got.color[c].at(x, y)));
      }
    }
  }
  double sum = 0;
  for (double e : errors) sum += e;
  row.mean_error = sum / static_cast<double>(errors.size());
  const auto at =
      errors.begin() + static_cast<std::ptrdiff_t>(0.9999 * static_cast<double>(errors.size() - 1));
  std::nth_element(errors.begin(), at, errors.end());
  row.p9999_error = *at;
  row.max_error = *std::max_element(errors.begin(), errors.end());
}

void bench_size(const char* label, Size size, const Arguments& arguments) {
  const MadePlate plate(size);
  const Look look = load_look(LIMPID_DATA "/looks/realistic.toml");
  const Plan plan =
      make_plan(look, {.planes = plate.frame.present(), .wave_map = true, .sun = true});
  const auto one = make_executor(1), two = make_executor(2);
  const auto fused = [&](Executor& executor, const std::string& target) {
    return [&, target](const Target& t) {
      run_fused(plan, plate.frame, plate.scene, t, executor, {.simd = target});
    };
  };
  const auto opencv = [&](int threads) {
    return [&, threads](const Target& t) {
      cv::setNumThreads(threads);
      run_opencv_chain(look, plate.frame, plate.scene, t);
    };
  };
  std::vector<Row> rows;
  rows.push_back({"reference, double, 1 thread",
                  [&](const Target& t) { run_reference(plan, plate.frame, plate.scene, t); },
                  size.height > 1080 ? 1 : 2});
  rows.push_back({"OpenCV chain, 1 thread", opencv(1)});
  rows.push_back({"OpenCV chain, 2 threads", opencv(2)});
  const std::vector<std::string> targets =
      arguments.simd.empty() ? simd_targets() : std::vector<std::string>{arguments.simd};
  for (const std::string& target : targets) {
    rows.push_back({"fused " + target + ", 1 thread", fused(*one, target)});
  }
  const std::string best = arguments.best_simd();
  rows.push_back({"fused " + best + ", 2 threads", fused(*two, best)});

  std::erase_if(rows, [&](const Row& row) { return !arguments.wants_row(row.name); });

  Canvas judge(plate.frame.display), canvas(plate.frame.display);
  run_reference(plan, plate.frame, plate.scene, judge.target);
  for (Row& row : rows) {
    row.run(canvas.target);
    measure_error(judge.target, canvas.target, row);
  }
  for (int round = 0; round < arguments.rounds; ++round) {
    for (Row& row : rows) {
      if (round >= row.most_rounds) continue;
      const auto start = std::chrono::steady_clock::now();
      row.run(canvas.target);
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
      row.best_seconds = std::min(row.best_seconds, took.count());
    }
  }
  const double pixels = double(size.width) * size.height,
               rival = seconds_of(rows, "OpenCV chain, 1 thread");
  std::printf("%s, %dx%d, %.0f %% wet, best of %d rounds\n", label, size.width, size.height,
              100 * plate.wet_share(), arguments.rounds);
  std::printf("  %-28s %10s %10s %9s %12s %12s %10s\n", "runner", "ns/pixel", "ms", "x rival",
              "mean error", "p99.99", "max");
  for (const Row& row : rows) {
    std::printf("  %-28s %10.2f %10.1f %9.2f %12.2e %12.2e %10.2e\n", row.name.c_str(),
                1e9 * row.best_seconds / pixels, 1e3 * row.best_seconds, rival / row.best_seconds,
                row.mean_error, row.p9999_error, row.max_error);
  }
}

}  // namespace
}  // namespace limpid::bench

int main(int argc, char** argv) {
  using namespace limpid::bench;
  return run_program("limpid_bench", [&] {
    const Arguments arguments = arguments_of(argc, argv, true);
    std::printf("look realistic, four lookups of a normal map; rival = OpenCV chain, 1 thread\n");
    if (arguments.wants_size("1080p")) bench_size("1080p", {1920, 1080}, arguments);
    if (arguments.wants_size("4K")) bench_size("4K", {3840, 2160}, arguments);
  });
}
