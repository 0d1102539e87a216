// Times the Compositor on 1080p frames of a host beside the fused runner on the same frame: the
// overhead of reading a host's buffers in place. Rounds go over all rows in turn; the overhead is
// the median over the rounds of a row's time divided by the runner's time in the same round, so
// that a slow moment of the machine affects both.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#define IMATH_HALF_NO_LOOKUP_TABLE
#include <Imath/half.h>

#include "limpid/compositor.h"
#include "limpid/files/text/look_file.h"
#include "limpid/run/fused.h"

#include "arguments.h"
#include "made_plate.h"
#include "rows.h"

namespace limpid::bench {
namespace {

constexpr Size kSize{1920, 1080};

void fill(const HostOutput& to, const View<const float>& from) {
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      std::byte* at = static_cast<std::byte*>(to.data) + x * to.x_stride + y * to.y_stride;
      const float value = from.at(x, y);
      const std::uint16_t half = imath_float_to_half(value);
      if (to.sample == Sample::kHalf) {
        std::memcpy(at, &half, sizeof half);
      } else {
        std::memcpy(at, &value, sizeof value);
      }
    }
  }
}

struct TimedRow {
  std::string name;
  std::function<void()> run;
  std::size_t beside = 0;  ///< the row for comparison: a runner on the same pixels
  std::vector<double> seconds = {};
};

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

/// A synthetic plate in the layouts of hosts, and the rows that read these layouts.
class Host {
 public:
  Host(const Look& look, int threads, const std::string& simd)
      : plate_(kSize),
        executor_(make_executor(threads)),
        plan_(make_plan(look, {.planes = plate_.frame.present(), .wave_map = true, .sun = true})) {
    for (Plane& plane : wet_) plane = Plane(rect_of(kSize));
    for (std::size_t c = 0; c < 3; ++c) target_.color[c] = wet_[c].view();
    target_.alpha = wet_[3].view();
    rows_.push_back({"fused runner", [this, simd] {
                       runner_.run(plan_, plate_.frame, plate_.scene, target_, *executor_,
                                   {.simd = simd});
                     }});

    HostFrame planar{.display = rect_of(kSize), .planes = {}, .scene = plate_.scene};
    for (int i = 0; i < kPlaneCount; ++i) {
      if (plate_.frame.planes[i]) planar.planes[i] = host_view(plate_.frame.planes[i]);
    }
    HostPicture picture;
    for (std::size_t c = 0; c < 3; ++c) picture.color[c] = host_view(target_.color[c]);
    picture.alpha = host_view(target_.alpha);
    const CompositorOptions options{.executor = executor_.get(), .simd = simd};
    add("planes of float, vouched for", {.trusted = true}, look, options, planar, picture);
    add("planes of float, looked through", {}, look, options, planar, picture);

    HostFrame device = planar;
    for (const Role& role : roles()) {
      const View<const float>& depth = plate_.frame.plane(role.first);
      if (role.sanitise != Sanitise::kDepth || !depth) continue;
      device.plane(role.first) = host_view(as_device_depth(depth));
    }
    add("planes of float, device depth",
        {.depth = DepthKind::kDevice, .clip = plate_.scene.camera->clip, .trusted = true}, look,
        options, device, picture);

    add_interleaved(Sample::kFloat, "RGBA of float", look, options, planar);
    add_interleaved(Sample::kHalf, "RGBA of half", look, options, planar);
  }

  std::vector<TimedRow>& rows() { return rows_; }

 private:
  View<const float> as_device_depth(const View<const float>& depth) {
    const Camera& camera = *plate_.scene.camera;
    const View<float> device = device_.emplace_back(rect_of(kSize)).view();
    for (int y = 0; y < kSize.height; ++y) {
      for (int x = 0; x < kSize.width; ++x) {
        const float z = depth.at(x, y);
        device.at(x, y) = static_cast<float>(std::isinf(z) ? camera.far_device_depth()
                                                           : camera.device_from_eye_depth(z));
      }
    }
    return device;
  }

  void add(const std::string& name, const Conventions& conventions, const Look& look,
           const CompositorOptions& options, const HostFrame& frame, const HostPicture& picture) {
    auto compositor = std::make_shared<Compositor>(conventions, look, options);
    compositor->set_wave_map(plate_.frame.wave_map);
    rows_.push_back({name, [=] { compositor->run(frame, picture); }, beside_});
  }

  /// The runner itself on these pixels; the rows after it are compared with this row.
  void add_runner(const std::string& name, const std::string& simd, const HostFrame& host,
                  const HostPicture& picture) {
    Frame frame = plate_.frame;
    Target target;
    for (int c = 0; c < 4; ++c) frame.planes[c] = floats_of(host.planes[c]);
    for (std::size_t c = 0; c < 3; ++c) target.color[c] = floats_of(picture.color[c]);
    target.alpha = floats_of(picture.alpha);
    beside_ = rows_.size();
    rows_.push_back({"fused runner, " + name, [this, frame, target, simd] {
                       runner_.run(plan_, frame, plate_.scene, target, *executor_, {.simd = simd});
                     }});
  }

  /// Interleaved color: from input to output, and in place.
  void add_interleaved(Sample sample, const std::string& name, const Look& look,
                       const CompositorOptions& options, HostFrame frame) {
    const std::size_t bytes =
        static_cast<std::size_t>(4 * bytes_of(sample)) * kSize.width * kSize.height;
    std::vector<std::byte>& in = pixels_.emplace_back(bytes);
    std::vector<std::byte>& out = pixels_.emplace_back(bytes);
    HostPicture apart, here;
    for (int c = 0; c < 4; ++c) {
      const HostOutput from = interleaved(static_cast<void*>(in.data()), sample, 4, c, kSize);
      const HostOutput to = interleaved(static_cast<void*>(out.data()), sample, 4, c, kSize);
      (c < 3 ? apart.color[static_cast<std::size_t>(c)] : apart.alpha) = to;
      (c < 3 ? here.color[static_cast<std::size_t>(c)] : here.alpha) = from;
    }
    for (int c = 0; c < 4; ++c) {
      const HostOutput to = interleaved(static_cast<void*>(in.data()), sample, 4, c, kSize);
      fill(to, plate_.frame.planes[c]);
      frame.planes[c] = to;
    }
    if (sample == Sample::kFloat) add_runner(name, options.simd, frame, apart);
    add(name + ", vouched for", {.trusted = true}, look, options, frame, apart);
    add(name + ", vouched for, in place", {.trusted = true}, look, options, frame, here);
  }

  MadePlate plate_;
  std::unique_ptr<Executor> executor_;
  Plan plan_;
  FusedRunner runner_;
  std::array<Plane, 4> wet_;
  std::deque<Plane> device_;
  Target target_;
  std::deque<std::vector<std::byte>> pixels_;
  std::vector<TimedRow> rows_;
  std::size_t beside_ = 0;
};

void print(const std::string& title, Host& host, int rounds) {
  std::vector<TimedRow>& rows = host.rows();
  for (TimedRow& row : rows) row.run();  // the first frame allocates its memory
  for (int round = 0; round < rounds; ++round) {
    for (TimedRow& row : rows) row.seconds.push_back(seconds_of(row.run));
  }
  std::printf("%s, %dx%d, %d rounds\n  %-36s %9s %9s %9s %10s\n", title.c_str(), kSize.width,
              kSize.height, rounds, "", "best ms", "median", "95 %", "overhead");
  for (const TimedRow& row : rows) {
    std::vector<double> sorted = row.seconds, ratios;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      ratios.push_back(row.seconds[i] / rows[row.beside].seconds[i]);
    }
    std::printf("  %-36s %9.2f %9.2f %9.2f %9.1f%%\n", row.name.c_str(), 1e3 * sorted.front(),
                1e3 * median(sorted), 1e3 * sorted[sorted.size() * 95 / 100],
                100 * (median(ratios) - 1));
  }
  std::fflush(stdout);
}

}  // namespace
}  // namespace limpid::bench

int main(int argc, char** argv) {
  using namespace limpid::bench;
  return run_program("limpid_compositor_bench", [&] {
    const Arguments arguments = arguments_of(argc, argv, false, 41);
    for (const char* name : {"realistic", "physical"}) {
      const limpid::Look look =
          limpid::load_look(LIMPID_DATA "/looks/" + std::string(name) + ".toml");
      for (const int threads : {1, 2}) {
        Host host(look, threads, arguments.best_simd());
        print(std::string("look ") + name + (threads == 1 ? ", 1 thread" : ", 2 threads"), host,
              arguments.rounds);
      }
    }
  });
}
