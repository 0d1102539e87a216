#include <cmath>
#include <cstdio>

#include "limpid/core/error.h"
#include "limpid/files/text/frame_range.h"

#include "frame_options.h"
#include "job/truth.h"
#include "memory_limit.h"
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

TruthJob job_of(const TruthArguments& a, const CommonArguments& common) {
  // Checked as those of water are.
  WaterOptions files = a.water;
  files.aovs.clear();
  const OutputChoice choice = output_of(files);
  TruthJob job;
  job.scene = scene_to_render(a.scene);
  job.size = size_named(a.size);
  job.time.asked = a.water.time;
  job.limits = limits_of(common);
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
  std::snprintf(times, sizeof times, "trace %.1f s, write %.0f ms",
                report.read_seconds + report.run_seconds, 1e3 * report.write_seconds);
  std::string text = job.output.picture.string() + ": " + numbers + ", look " + job.look.name +
                     ", " + times + "\n";
  if (!job.output.preview.empty()) text += job.output.preview.string() + "\n";
  return text;
}

}  // namespace

int truth_verb(const TruthArguments& a, const CommonArguments& common) {
  expect_output(a.water.output);
  Sequence sequence = sequence_of(a.frames, a.water);
  const TruthJob job = job_of(a, common);
  const auto executor = executor_of(common);
  tell_warnings(unread_settings(job.look), common.quiet);
  const Model model = model_to_render(job.scene, a.draw_what_you_can, common);
  if (sequence.frames.empty()) {
    const TruthReport report = truth(model, job, *executor);
    if (!common.quiet) std::printf("%s", text_of(report, job).c_str());
    return 0;
  }
  const auto job_of_frame = [&](int frame) {
    TruthJob one = job;
    one.output.picture = name_of_frame(job.output.picture.string(), frame);
    one.output.preview = name_of_frame(job.output.preview.string(), frame);
    one.time = time_of_frame(a.frames, a.water, job.scene, false, frame);
    return one;
  };
  sequence.in_flight = 1;  // tracing keeps all threads busy
  sequence = rest_of(sequence, a.frames, common, [&](const Sequence& all, Scrutiny scrutiny) {
    return rest_of_truth(model, all, job_of_frame, *executor, scrutiny);
  });
  Progress progress(common);
  const auto tell = [&](const SequenceProgress& at, const TruthReport& report) {
    progress.frame_done(at, text_of(report, job_of_frame(at.frame)));
  };
  truth_sequence(model, sequence, job_of_frame, tell, *executor);
  return 0;
}

}  // namespace limpid::tool
