#include <cmath>
#include <cstdio>

#include "limpid/core/error.h"

#include "frame_options.h"
#include "job/truth.h"
#include "notes.h"
#include "verbs.h"
#include "water_options.h"

namespace limpid::tool {
namespace {

/// Those of water, but the truth guesses nothing and has no buffers, and `visible`.
void choose_aovs(const std::vector<std::string>& names, TruthOutput& output) {
  std::vector<std::string> known;
  for (const AovInfo& info : aovs()) {
    if (!info.of_buffers) known.emplace_back(info.name);
  }
  known.emplace_back("visible");
  for (const std::string& name : aov_names(names, known)) {
    if (name == "visible") {
      output.visible = true;
    } else {
      output.aovs.push_back(aov_named(name));
    }
  }
}

TruthOptions::Light light_named(const TruthArguments& a) {
  if (a.light == "paths") return TruthOptions::Light::kPaths;
  if (a.light != "once")
    throw Error("--light " + a.light + ": expected paths or once", Fault::kUsage);
  if (!a.paths) return TruthOptions::Light::kOnce;
  throw Error("--paths " + std::to_string(*a.paths) + ": light that is scattered once has no paths",
              Fault::kUsage);
}

TruthJob job_of(const TruthArguments& a) {
  // Checked as those of water are.
  WaterOptions files = a.water;
  files.aovs.clear();
  const OutputChoice choice = output_of(files);
  TruthJob job;
  job.scene = scene_to_render(a.scene);
  job.size = size_named(a.size);
  job.time = begin_of(a.water, job.scene);
  job.look = look_of(a.water);
  job.samples = a.samples;
  job.light = light_named(a);
  job.paths = a.paths.value_or(job.paths);
  job.photons = a.photons;
  job.seed = a.seed;
  job.output.picture = choice.picture;
  job.output.preview = choice.preview;
  job.output.compression = choice.compression;
  job.output.store_float = choice.store_float;
  choose_aovs(a.water.aovs, job.output);
  return job;
}

std::string text_of(const TruthReport& report, const TruthJob& job) {
  char numbers[160];
  int end =
      std::snprintf(numbers, sizeof numbers, "%dx%d, %d sample%s a pixel", report.size.width,
                    report.size.height, job.samples * job.samples, job.samples == 1 ? "" : "s");
  const auto add = [&](const char* format, auto value) {
    const std::size_t at = static_cast<std::size_t>(end);
    end += std::snprintf(numbers + at, sizeof numbers - at, format, value);
  };
  if (job.light == TruthOptions::Light::kPaths) add(" of %d paths", job.paths);
  if (!std::isnan(report.relative_error)) add(", noise %.2g %%", 100 * report.relative_error);
  char times[64];
  std::snprintf(times, sizeof times, "trace %.1f s, write %.0f ms", report.trace_seconds,
                1e3 * report.write_seconds);
  std::string text = job.output.picture.string() + ": " + numbers + ", look " + job.look.name +
                     ", " + times + "\n";
  if (!job.output.preview.empty()) text += job.output.preview.string() + "\n";
  return text;
}

/// A frame at a time: tracing keeps all threads busy.
class TruthSlot : public FrameSlot {
 public:
  TruthSlot(const Model& model, const JobOfFrame<TruthJob>& job_of, Progress& progress)
      : model_(model), job_of_(job_of), progress_(progress) {}

  void begin(int frame) override { job_ = job_of_(frame); }
  void read(Executor&) override {}
  void run(Executor& executor) override { report_ = truth(model_, job_, executor); }
  void write() override {}
  void done(const SequenceProgress& at) override {
    progress_.frame_done(at, text_of(report_, job_));
  }

 private:
  const Model& model_;
  const JobOfFrame<TruthJob>& job_of_;
  Progress& progress_;
  TruthJob job_;
  TruthReport report_;
};

}  // namespace

int truth_verb(const TruthArguments& a, const CommonArguments& common) {
  expect_output(a.water.output);
  Sequence sequence = sequence_of(a.frames, a.water);
  const TruthJob job = job_of(a);
  const auto executor = executor_of(common);
  tell_warnings(unread_settings(job.look), common.quiet);
  const Model model = model_to_render(job.scene, a.draw_what_you_can, common);
  if (sequence.frames.empty()) {
    const TruthReport report = truth(model, job, *executor);
    if (!common.quiet) std::printf("%s", text_of(report, job).c_str());
    return 0;
  }
  const JobOfFrame<TruthJob> job_of_frame = [&](int frame) {
    TruthJob one = job;
    OutputChoice names;
    names.picture = job.output.picture;
    names.preview = job.output.preview;
    names = output_of_frame(names, frame);
    one.output.picture = names.picture;
    one.output.preview = names.preview;
    one.time = time_of_frame(a.frames, job.time, frame);
    return one;
  };
  expect_apart(sequence.frames, [&](int frame) { return files_of(model, job_of_frame(frame)); });
  sequence.in_flight = 1;
  Progress progress(common);
  run_sequence(
      sequence,
      [&]() -> std::unique_ptr<FrameSlot> {
        return std::make_unique<TruthSlot>(model, job_of_frame, progress);
      },
      *executor);
  return 0;
}

}  // namespace limpid::tool
