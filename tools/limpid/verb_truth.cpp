#include <cmath>
#include <cstdio>

#include "frame_options.h"
#include "job/truth.h"
#include "notes.h"
#include "scene_jobs.h"
#include "verbs.h"
#include "water_options.h"

namespace limpid::tool {
namespace {

std::string text_of(const TruthReport& report, const TruthJob& job) {
  char numbers[160];
  int end =
      std::snprintf(numbers, sizeof numbers, "%dx%d, %d sample%s per pixel", report.size.width,
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
  const TruthJob job = truth_job(a, common);
  const auto executor = executor_of(common);
  tell_warnings(unread_settings(job.look), common.quiet);
  const Model model = model_to_render(job.scene, a.skip_unsupported, common);
  if (sequence.frames.empty()) {
    const TruthReport report = truth(model, job, *executor);
    if (!common.quiet) std::printf("%s", text_of(report, job).c_str());
    return 0;
  }
  const auto job_of_frame = [&](int frame) { return truth_job_of_frame(job, a, frame); };
  sequence.in_flight = 1;  // tracing keeps all threads busy
  sequence = rest_of(sequence, a.frames, common, [&](const Sequence& all, VerifyLevel level) {
    return rest_of_truth(model, all, job_of_frame, *executor, level);
  });
  Progress progress(common);
  const auto tell = [&](const SequenceProgress& at, const TruthReport& report) {
    progress.frame_done(at, text_of(report, job_of_frame(at.frame)));
  };
  truth_sequence(model, sequence, job_of_frame, tell, *executor);
  return 0;
}

}  // namespace limpid::tool
