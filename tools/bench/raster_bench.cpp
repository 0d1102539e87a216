// Times the rasteriser beside Mesa's llvmpipe. The rival reads how many threads it has from its
// environment when it starts, so it runs in processes of its own (this program again, with
// --rival), one for each number of threads; rounds go over all rows in turn, the best round counts.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

#include "arguments.h"
#include "raster_llvmpipe.h"
#include "raster_scene.h"

namespace limpid::bench {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

void write_all(int file, const void* data, std::size_t bytes) {
  const char* from = static_cast<const char*>(data);
  while (bytes > 0) {
    const ssize_t done = ::write(file, from, bytes);
    if (done <= 0) throw std::runtime_error("the pipe to the rival broke");
    from += done;
    bytes -= static_cast<std::size_t>(done);
  }
}

void read_all(int file, void* data, std::size_t bytes) {
  char* to = static_cast<char*>(data);
  while (bytes > 0) {
    const ssize_t done = ::read(file, to, bytes);
    if (done <= 0) throw std::runtime_error("the pipe to the rival broke");
    to += done;
    bytes -= static_cast<std::size_t>(done);
  }
}

/// What the rival's process does: 'd' draws and tells the milliseconds, 'p' sends the picture, 'n'
/// the renderer's name, the end of the pipe ends it.
void serve(int scene_index, int from, int to) {
  GlRasteriser rival;
  rival.load(raster_scene(scene_index));
  char order = 0;
  while (::read(from, &order, 1) == 1) {
    if (order == 'd') {
      const Clock::time_point start = Clock::now();
      rival.draw();
      const double took = milliseconds_since(start);
      write_all(to, &took, sizeof took);
    } else if (order == 'p') {
      const std::vector<float> planes = rival.picture();
      write_all(to, planes.data(), planes.size() * sizeof(float));
    } else {
      std::array<char, 128> name{};
      std::snprintf(name.data(), name.size(), "%s", rival.renderer());
      write_all(to, name.data(), name.size());
    }
  }
}

class Rival {
 public:
  Rival(int scene_index, const char* threads) {
    int down[2], up[2];
    if (::pipe(down) != 0 || ::pipe(up) != 0) throw std::runtime_error("no pipe");
    child_ = ::fork();
    if (child_ == 0) {
      ::close(down[1]);
      ::close(up[0]);
      ::setenv("LP_NUM_THREADS", threads, 1);
      ::setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
      const std::string scene = std::to_string(scene_index), in = std::to_string(down[0]),
                        out = std::to_string(up[1]);
      ::execl("/proc/self/exe", "limpid_raster_bench", "--rival", scene.c_str(), in.c_str(),
              out.c_str(), static_cast<char*>(nullptr));
      ::_exit(127);
    }
    ::close(down[0]);
    ::close(up[1]);
    to_ = down[1];
    from_ = up[0];
  }
  ~Rival() {
    ::close(to_);
    ::close(from_);
    ::waitpid(child_, nullptr, 0);
  }
  Rival(const Rival&) = delete;
  Rival& operator=(const Rival&) = delete;

  double draw() { return ask<double>('d'); }
  std::string renderer() { return ask<std::array<char, 128>>('n').data(); }
  std::vector<float> picture(std::size_t floats) {
    std::vector<float> planes(floats);
    write_all(to_, "p", 1);
    read_all(from_, planes.data(), floats * sizeof(float));
    return planes;
  }

 private:
  template <class T>
  T ask(char order) {
    T answer{};
    write_all(to_, &order, 1);
    read_all(from_, &answer, sizeof answer);
    return answer;
  }
  int child_ = 0, to_ = 0, from_ = 0;
};

struct Difference {
  double mean_color = 0, mean_depth = 0, other_percent = 0;
};

/// Pixels whose color is off by more than 0.02 count as other.
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

void bench_scene(int index, const Arguments& arguments) {
  const RasterScene scene = raster_scene(index);
  if (!arguments.wants_row(scene.label)) return;
  Rasteriser rasteriser(scene.model);
  RasterImage image;
  Rival rival_one(index, "0"), rival_two(index, "2");
  const auto one = make_executor(1), two = make_executor(2);
  const auto draw = [&](Executor& executor) {
    const Clock::time_point start = Clock::now();
    rasteriser.draw(scene.view, scene.lighting, {.color = true, .depth = true}, executor, image,
                    arguments.simd);
    return milliseconds_since(start);
  };
  std::array<double, 4> best{1e30, 1e30, 1e30, 1e30};
  for (int round = -1; round < arguments.rounds; ++round) {  // the first round warms up
    const std::array<double, 4> took{rival_one.draw(), draw(*one), rival_two.draw(), draw(*two)};
    for (std::size_t i = 0; i < 4 && round >= 0; ++i) best[i] = std::min(best[i], took[i]);
  }
  const Size size = scene.view.display.size();
  const Difference d = difference(scene, image,
                                  rival_one.picture(4 * static_cast<std::size_t>(size.width) *
                                                    static_cast<std::size_t>(size.height)));
  std::printf("%-20s %8.1f %8.1f %6.2fx   %8.1f %8.1f %6.2fx   %9.1e %9.1e %7.3f %%\n", scene.label,
              best[0], best[1], best[0] / best[1], best[2], best[3], best[2] / best[3],
              d.mean_color, d.mean_depth, d.other_percent);
  std::fflush(stdout);
}

void bench(const Arguments& arguments) {
  std::printf(
      "rival: %s; ours: %s; 1080p, Phong and a texture, float color and depth; ms, best of "
      "%d rounds\n",
      Rival(2, "0").renderer().c_str(), arguments.best_simd().c_str(), arguments.rounds);
  std::printf("%-20s %26s   %26s   %s\n", "", "1 thread: rival, ours", "2 threads: rival, ours",
              "mean difference: color, depth, pixels off by > 0.02");
  for (int i = 0; i < kRasterScenes; ++i) bench_scene(i, arguments);
}

}  // namespace
}  // namespace limpid::bench

int main(int argc, char** argv) {
  using namespace limpid::bench;
  return run_program("limpid_raster_bench", [&] {
    if (argc == 5 && std::strcmp(argv[1], "--rival") == 0) {
      return serve(std::atoi(argv[2]), std::atoi(argv[3]), std::atoi(argv[4]));
    }
    bench(arguments_of(argc, argv));
  });
}
