#include <algorithm>
#include <optional>
#include <string>
#include <thread>

#include "limpid/core/error.h"
#include "limpid/core/simd.h"
#include "limpid/files/text/look_file.h"

#include "judge/report/measure.h"
#include "judge/report/now.h"

namespace limpid {
namespace {

namespace fs = std::filesystem;

/// Has waves, a shore, and objects that stand in the water.
constexpr const char* kChoicesScene = "lagoon_shore";

std::vector<fs::path> files_in(const fs::path& folder, bool below) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const fs::path inner = entry.path() / (entry.path().filename().string() + ".toml");
    const fs::path path = below ? inner : entry.path();
    if (path.extension() == ".toml" && fs::is_regular_file(path, error)) files.push_back(path);
  }
  std::sort(files.begin(), files.end());
  if (files.empty()) {
    throw Error(folder.string() + ": expected " +
                (below ? "folders NAME with a file NAME.toml" : "files NAME.toml"));
  }
  return files;
}

/// The standard first, then by name.
std::vector<Look> looks_of(const fs::path& data, const Look& judge) {
  std::vector<Look> looks{judge};
  for (const fs::path& file : files_in(data / "looks", false)) {
    Look look = load_look(file);
    if (look.name != judge.name) looks.push_back(std::move(look));
  }
  return looks;
}

/// The named GPU; else any GPU, if there is one.
std::optional<GpuOptions> gpu_of(const ReportOptions& options) {
  const GpuOptions chosen{.device = options.gpu};
  if (!options.gpu.empty()) return chosen;
  try {
    const std::vector<GpuInfo> known = gpu_devices();
    if (!known.empty() && !known[0].software) return chosen;
  } catch (const Error&) {
    // A machine without Vulkan.
  }
  return {};
}

void measure(const Measuring& m) {
  const ReportOptions& options = m.options;
  measure_truth(m);
  bool first = true;
  for (const fs::path& file : files_in(options.data / "plates", true)) {
    Subject subject = Subject::of_plate(file, options.size);
    measure_looks(m, subject, first);
    measure_budgets(m, subject);
    if (first) measure_choices(m, subject);
    first = false;
  }
  for (const fs::path& file : files_in(options.data / "scenes", false)) {
    Subject subject =
        Subject::of_scene(file, options.size, options.data / "maps" / "sky.exr", m.many);
    measure_looks(m, subject, false);
    measure_budgets(m, subject);
  }
  for (const fs::path& file : files_in(options.data / "scenes", false)) {
    measure_models(m, file, file.stem() == kChoicesScene);
  }
  measure_brought_lagoon(m);
  for (const fs::path& file : files_in(options.data / "scenes", false)) {
    measure_brought_scene(m, file);
  }
}

}  // namespace

void ReportOptions::validate() const {
  const auto expect = [](bool holds, const std::string& what) {
    if (!holds) throw Error("report." + what, Fault::kUsage);
  };
  const auto within = [](int side) { return side >= kLeastReportSide && side <= kMaxReportSide; };
  expect(within(size.width) && within(size.height),
         "size = " + std::to_string(size.width) + "x" + std::to_string(size.height) +
             ": expected " + std::to_string(kLeastReportSide) + " ... " +
             std::to_string(kMaxReportSide) + " pixels a side");
  expect(rounds >= 1 && rounds <= kMaxRounds,
         "rounds = " + std::to_string(rounds) + ": expected 1 ... " + std::to_string(kMaxRounds));
}

Report measure_report(const ReportOptions& options) {
  options.validate();
  const auto one = make_executor(1), many = make_executor(options.threads);
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const int threads = options.threads == 0 ? cores : std::min(options.threads, cores);
  const std::optional<GpuOptions> gpu = gpu_of(options);
  std::optional<GpuRunner> holder;  // keeps the device open between subjects
  if (gpu) holder.emplace(*gpu);
  Report report;
  const Look physical = load_look(options.data / "looks" / "physical.toml");
  const Measuring m{options,
                    looks_of(options.data, physical),
                    physical,
                    *one,
                    *many,
                    threads,
                    simd_targets().front(),
                    report,
                    gpu ? &*gpu : nullptr};
  report.made = now_text();
  report.simd = m.simd;
  for (const Look& look : m.looks) report.looks.push_back(look.name);
  report.machine = this_machine();
  report.build = this_build();
  report.size = options.size;
  report.rounds = options.rounds;
  report.threads = threads;
  measure(m);
  return report;
}

}  // namespace limpid
