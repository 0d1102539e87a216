// Times the runners on the look `realistic`, each beside its error against the reference and beside
// the rival, in one run: rounds go over all rows in turn, so that a noisy neighbour hits them
// alike; the best round counts.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include <opencv2/core/utility.hpp>

#include "limpid/run/fused.h"
#include "limpid/run/reference.h"

#include "arguments.h"
#include "canvas.h"
#include "made_plate.h"
#include "opencv_chain.h"

namespace limpid::bench {
namespace {

/// data/looks/realistic.toml, with the plate's normals.
Look realistic() {
  Look look;
  look.of<Refraction>() = {Refraction::Model::kNormalOffset, 0.03, Refraction::Rejection::kSnap, 0,
                           Refraction::OffFrame::kClamp};
  look.of<PrismSplit>() = {PrismSplit::Model::kAxis, 0.004};
  DepthFog::Params& fog = look.of<DepthFog>();
  fog.model = DepthFog::Model::kLinear;
  fog.distance = DepthFog::Distance::kEye;
  look.of<WaterShadow>() = {WaterShadow::Model::kDarken, 0.5};
  FresnelReflection::Params& mirror = look.of<FresnelReflection>();
  mirror.reflectance = FresnelReflection::Reflectance::kRim;
  mirror.power = 3;
  mirror.lookup = FresnelReflection::Lookup::kOffset;
  mirror.strength = 0.02;
  look.of<SunHighlight>() = {SunHighlight::Model::kBlinnPhong, 200, 1};
  return look;
}

struct Row {
  std::string name;
  std::function<void(const Target&)> run;
  double best_seconds = 1e30;
  double mean_error = 0, p9999_error = 0, max_error = 0;
};

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
  const Look look = realistic();
  const Plan plan = make_plan(look, {plate.frame.present(), false, true});
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
                  [&](const Target& t) { run_reference(plan, plate.frame, plate.scene, t); }});
  rows.push_back({"OpenCV chain, 1 thread", opencv(1)});
  rows.push_back({"OpenCV chain, 2 threads", opencv(2)});
  const std::vector<std::string> targets =
      arguments.simd.empty() ? simd_targets() : std::vector<std::string>{arguments.simd};
  for (const std::string& target : targets) {
    rows.push_back({"fused " + target + ", 1 thread", fused(*one, target)});
  }
  const std::string best = arguments.best_simd();
  rows.push_back({"fused " + best + ", 2 threads", fused(*two, best)});

  Canvas judge(plate.frame.display), canvas(plate.frame.display);
  run_reference(plan, plate.frame, plate.scene, judge.target);
  for (Row& row : rows) {
    row.run(canvas.target);
    measure_error(judge.target, canvas.target, row);
  }
  for (int round = 0; round < arguments.rounds; ++round) {
    for (Row& row : rows) {
      if (&row == &rows[0] && round > 1) continue;  // the reference is slow; two rounds tell enough
      const auto start = std::chrono::steady_clock::now();
      row.run(canvas.target);
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
      row.best_seconds = std::min(row.best_seconds, took.count());
    }
  }
  int wet = 0;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      wet += plate.frame.plane(PlaneId::kSurfaceDepth).at(x, y) <
             plate.frame.plane(PlaneId::kDepth).at(x, y);
    }
  }
  const double pixels = double(size.width) * size.height, rival = rows[1].best_seconds;
  std::printf("%s, %dx%d, %.0f %% wet, best of %d rounds\n", label, size.width, size.height,
              100.0 * wet / pixels, arguments.rounds);
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
    const Arguments arguments = arguments_of(argc, argv);
    std::printf("look realistic on a plate with normals; rival = OpenCV chain, 1 thread\n");
    bench_size("1080p", {1920, 1080}, arguments);
    bench_size("4K", {3840, 2160}, arguments);
  });
}
