// Times the rasteriser beside Mesa's llvmpipe, which draws in processes of its own.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "arguments.h"
#include "gl_process.h"
#include "raster_llvmpipe.h"
#include "raster_scene.h"
#include "rows.h"

namespace limpid::bench {
namespace {

struct Difference {
  double mean_color = 0, mean_depth = 0, other_percent = 0;
};

/// Pixels whose colors differ by more than 0.02 count as different.
Difference difference(const RasterScene& scene, const RasterImage& ours,
                      const std::vector<float>& theirs) {
  const Size size = scene.view.display.size();
  const std::size_t area =
      static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
  const glm::dmat4& p = scene.view.camera.projection;
  Difference d;
  std::size_t i = 0;
  double other = 0, deep = 0;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x, ++i) {
      double worst = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const double error = std::abs(ours.color[c].view().at(x, y) - theirs[c * area + i]);
        d.mean_color += error / (3.0 * static_cast<double>(area));
        worst = std::max(worst, error);
      }
      other += worst > 0.02;
      const double device = 2 * theirs[3 * area + i] - 1;
      const double depth = p[3][2] / (device + p[2][2]);
      if (!std::isfinite(ours.depth.view().at(x, y)) || device >= 1) continue;
      d.mean_depth += std::abs(ours.depth.view().at(x, y) - depth);
      deep += 1;
    }
  }
  d.mean_depth /= std::max(deep, 1.0);
  d.other_percent = 100 * other / static_cast<double>(area);
  return d;
}

/// False if this row is not selected.
bool bench_scene(int index, const Arguments& arguments) {
  const RasterScene scene = raster_scene(index);
  if (!arguments.wants_row(scene.label)) return false;
  Rasteriser rasteriser(scene.model);
  RasterImage image;
  GlProcess rival_one(std::to_string(index), 1), rival_two(std::to_string(index), 2);
  const auto one = make_executor(1), two = make_executor(2);
  const auto draw = [&](Executor& executor) {
    return seconds_of([&] {
      rasteriser.draw(scene.view, scene.lighting, {.color = true, .depth = true}, executor, image,
                      arguments.simd);
    });
  };
  std::vector<Row> rows = {{"rival, 1 thread", [&] { return rival_one.draw(); }},
                           {"ours, 1 thread", [&] { return draw(*one); }},
                           {"rival, 2 threads", [&] { return rival_two.draw(); }},
                           {"ours, 2 threads", [&] { return draw(*two); }}};
  for (Row& row : rows) row.run();  // warms up
  time_rows(rows, arguments.rounds);
  const auto best = [&](std::size_t i) { return 1e3 * rows[i].best_seconds; };
  const Size size = scene.view.display.size();
  const Difference d = difference(scene, image,
                                  rival_one.picture(4 * static_cast<std::size_t>(size.width) *
                                                    static_cast<std::size_t>(size.height)));
  std::printf("%-20s %8.1f %8.1f %6.2fx   %8.1f %8.1f %6.2fx   %9.1e %9.1e %7.3f %%\n", scene.label,
              best(0), best(1), best(0) / best(1), best(2), best(3), best(2) / best(3),
              d.mean_color, d.mean_depth, d.other_percent);
  std::fflush(stdout);
  return true;
}

void bench(const Arguments& arguments) {
  std::printf(
      "rival: %s; ours: %s; 1080p, Phong and a texture, float color and depth; ms, best of "
      "%d rounds\n",
      GlProcess("2", 1).renderer().c_str(), arguments.best_simd().c_str(), arguments.rounds);
  std::printf("%-20s %26s   %26s   %s\n", "", "1 thread: rival, ours", "2 threads: rival, ours",
              "mean difference: color, depth, pixels off by > 0.02");
  bool any = false;
  for (int i = 0; i < kRasterScenes; ++i) any |= bench_scene(i, arguments);
  arguments.expect_rows(any);
}

std::unique_ptr<GlDrawing> drawing_of(const std::string& index) {
  return std::make_unique<GlRasteriser>(raster_scene(std::stoi(index)));
}

}  // namespace
}  // namespace limpid::bench

int main(int argc, char** argv) {
  using namespace limpid::bench;
  return run_program("limpid_raster_bench", [&] {
    if (!serve_drawing(argc, argv, drawing_of)) bench(arguments_of(argc, argv));
  });
}
