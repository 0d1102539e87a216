// Times the runner on a GPU over a made-up plate: the shader with its data on the device, beside a
// shader of the look `realistic` that is written by hand; frames a second from memory to memory, by
// one runner and by several at once, and with complete frames in memory that the device reads and
// writes by itself, beside the bus alone with the same bytes; and a first start beside a second
// one. The best of all rounds counts.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <list>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <unistd.h>

#include "limpid/files/text/look_file.h"
#include "limpid/gpu/gpu_runner.h"

#include "arguments.h"
#include "complete/completer.h"
#include "judge/report/picture.h"
#include "made_plate.h"
#include "on_device.h"
#include "plan/pass_of.h"
#include "realistic_program.h"
#include "rows.h"

namespace limpid::bench {
namespace {

constexpr int kInFlight = 4, kFrames = 12;

Look shipped(const std::string& name) {
  return load_look(std::string(LIMPID_DATA) + "/looks/" + name + ".toml");
}

double best_of(int rounds, const std::function<double()>& seconds) {
  double best = HUGE_VAL;
  for (int i = 0; i < rounds; ++i) best = std::min(best, seconds());
  return best;
}

class Bench {
 public:
  Bench(const Arguments& arguments, Size size, std::string label)
      : arguments_(arguments),
        label_(std::move(label)),
        plate_(size),
        executor_(make_executor(0)),
        device_(GpuDevice::open("")) {}

  void run() {
    std::printf("%s, %s, %d rounds\n", device_->name().c_str(), label_.c_str(), arguments_.rounds);
    for (const char* name : {"realistic", "fast", "physical"}) {
      if (!arguments_.wants_row(name)) continue;
      any_ = true;
      on_device(name);
      from_memory(name);
      starts(name);
    }
    arguments_.expect_rows(any_);
  }

 private:
  Plan plan_of(const Look& look) const {
    return make_plan(look, {.planes = plate_.frame.present(), .wave_map = true, .sun = true});
  }

  void on_device(const std::string& name) {
    const Look look = shipped(name);
    const Plan plan = plan_of(look);
    Completer completer;
    const Frame frame = completer.complete(plan, plate_.frame,
                                           pass_of(plan, plate_.scene, plate_.frame), *executor_);
    Pass pass = pass_of(plan, plate_.scene, frame);
    pass.plate_waves = completer.plate_waves();
    if (!plan.reads_environment) pass.environment = {};
    ShaderOptions options;
    options.stage = ShaderOptions::Stage::kCompute;
    options.max_threads = device_->max_threads();
    const ShaderProgram program =
        program_of(plan, plate_.frame, frame, pass, options, Gathered::kAll);
    OnDevice ours(device_, program, *executor_);
    std::optional<OnDevice> rival;
    if (name == "realistic") {
      rival.emplace(device_, realistic_program(look, plate_.frame, plate_.scene), *executor_, true,
                    kRealisticMap);
    }
    for (int i = 0; i < arguments_.rounds; ++i) {
      ours.time_shader();
      if (rival) rival->time_shader();
    }
    const double best = ours.shader_seconds();
    std::printf("%-10s shader %8.3f ms, data on the device: %.0f GB/s of its %.0f MB\n",
                name.c_str(), 1e3 * best, 1e-9 * static_cast<double>(ours.bytes()) / best,
                1e-6 * static_cast<double>(ours.bytes()));
    if (rival) {
      const std::vector<float> a = ours.picture(), b = rival->picture();
      double sum = 0;
      for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(double(a[i]) - double(b[i]));
      std::printf("%-10s by hand %7.3f ms: ours takes %.2f of its time; pictures differ by %.1e\n",
                  "", 1e3 * rival->shader_seconds(), best / rival->shader_seconds(),
                  sum / static_cast<double>(a.size()));
    }
    bus_ = best_of(arguments_.rounds, [&] { return ours.bus_seconds(); });
    std::printf("%-10s bus    %8.3f ms there and back, %.1f GB/s\n", "", 1e3 * bus_,
                1e-9 * static_cast<double>(ours.bytes()) / bus_);
    std::list<OnDevice> slots;
    for (int i = 0; i < kInFlight; ++i) slots.emplace_back(device_, program, *executor_);
    const double pinned = seconds_of_each(slots, [](OnDevice& slot) { slot.run_frame(); });
    std::printf(
        "%-10s frames in pinned memory, complete: %.1f a second, %d at once: %.2f of the "
        "bus's time\n",
        "", 1 / pinned, kInFlight, pinned / bus_);
  }

  /// Seconds of a frame, of kFrames that so many slots run at once.
  template <class Slots, class Run>
  double seconds_of_each(Slots& slots, const Run& run) {
    const int each = kFrames / static_cast<int>(slots.size());
    return best_of(arguments_.rounds, [&] {
      return seconds_of([&] {
               std::vector<std::thread> threads;
               for (auto& slot : slots) {
                 threads.emplace_back([&] {
                   for (int i = 0; i < each; ++i) run(slot);
                 });
               }
               for (std::thread& thread : threads) thread.join();
             }) /
             (each * static_cast<int>(slots.size()));
    });
  }

  /// Frames of a sequence in memory, by so many runners at once; seconds of a frame.
  double seconds_of_frame(const Plan& plan, int runners) {
    struct Slot {
      explicit Slot(Rect window) : picture(window) {}
      GpuRunner runner;
      Picture picture;
    };
    std::list<Slot> slots;
    for (int i = 0; i < runners; ++i) {
      slots.emplace_back(plate_.frame.work());
      run_one(slots.back().runner, plan, slots.back().picture);
    }
    return seconds_of_each(slots, [&](Slot& slot) { run_one(slot.runner, plan, slot.picture); });
  }
  void run_one(GpuRunner& runner, const Plan& plan, Picture& picture) {
    runner.run(plan, plate_.frame, plate_.scene, picture.target, *executor_);
  }

  void from_memory(const std::string& name) {
    const Plan plan = plan_of(shipped(name));
    const double alone = seconds_of_frame(plan, 1), overlapped = seconds_of_frame(plan, kInFlight);
    std::printf(
        "%-10s frames from memory to memory: %.1f a second alone, %.1f by %d at once: %.2f "
        "of the bus's time\n",
        "", 1 / alone, 1 / overlapped, kInFlight, overlapped / bus_);
  }

  /// To the first picture, of a size that itself takes no time, without and with a kept pipeline.
  void starts(const std::string& name) {
    const MadePlate small({64, 36});
    const Plan plan =
        make_plan(shipped(name), {.planes = small.frame.present(), .wave_map = true, .sun = true});
    Picture picture(small.frame.work());
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("limpid_gpu_bench-" + std::to_string(::getpid()));
    device_.reset();
    const auto start = [&] {
      return seconds_of([&] {
        GpuRunner runner({.cache = folder});
        runner.run(plan, small.frame, small.scene, picture.target, *executor_);
      });
    };
    const double first = start();
    const double device = seconds_of([] { GpuRunner(); });
    const double second = best_of(3, start);
    std::filesystem::remove_all(folder);
    device_ = GpuDevice::open("");
    std::printf("%-10s first start %.0f ms, second %.0f ms, of which opening the device %.0f ms\n",
                "", 1e3 * first, 1e3 * second, 1e3 * device);
  }

  const Arguments& arguments_;
  std::string label_;
  MadePlate plate_;
  std::unique_ptr<Executor> executor_;
  std::shared_ptr<GpuDevice> device_;
  double bus_ = 0;
  bool any_ = false;
};

}  // namespace
}  // namespace limpid::bench

int main(int argc, char** argv) {
  using namespace limpid;
  return bench::run_program("limpid_gpu_bench", [&] {
    const bench::Arguments arguments = bench::arguments_of(argc, argv, true);
    const std::pair<std::string, Size> sizes[] = {{"1080p", {1920, 1080}}, {"4K", {3840, 2160}}};
    for (const auto& [label, size] : sizes) {
      if (arguments.wants_size(label)) bench::Bench(arguments, size, label).run();
    }
  });
}
