#include <cstdio>
#include <span>
#include <vector>

#include "limpid/core/error.h"
#include "limpid/files/text/frame_range.h"
#include "limpid/job/composite.h"
#include "limpid/job/sequence.h"

#include "composite_job.h"
#include "frame_options.h"
#include "memory_limit.h"
#include "notes.h"
#include "show.h"
#include "verbs.h"
#include "water_options.h"

namespace limpid::tool {
namespace {

/// The only job, or the first frame's.
CompositeJob first_job(const CompositeArguments& a, const Sequence& sequence,
                       const CommonArguments& common) {
  CompositeJob job = common_job(a, sequence, common);
  if (sequence.frames.empty()) return job;
  return job_of_frame(std::move(job), a, sequence.frames.front());
}

/// Throws Error with advice about a missing file.
CompositeJob expect_plate(CompositeJob job) {
  if (const auto missing = missing_file(job)) {
    throw Error(missing->string() +
                ": cannot be opened (no such file or directory); provide it, or " +
                "use --missing skip or hold");
  }
  return job;
}

void print_plan(const SurveyedPlan& surveyed, std::span<const double> seconds,
                const CommonArguments& common) {
  tell_warnings(surveyed.warnings, common.quiet);
  std::printf("%sreads %s\n%s\n%s", to_text(surveyed.plan, surveyed.survey, seconds).c_str(),
              roles_text(surveyed.plan.planes).c_str(), to_text(surveyed.off_frame).c_str(),
              surveyed.gpu.c_str());
}

}  // namespace

int composite_verb(const CompositeArguments& a, const CommonArguments& common) {
  expect_output(a.water.output);
  Sequence sequence = sequence_of(a.frames, a.water);
  const auto shown_by = chosen_protocol(a.water);
  const CompositeJob job = common_job(a, sequence, common);
  const auto executor = executor_of(common);
  if (sequence.frames.empty()) {
    if (common.verbose) std::printf("%s", Plate::inspect(job.plate).c_str());
    const CompositeReport report = composite(job, *executor);
    print_report(report, job.look, job.output, common);
    if (shown_by) show(report.preview, *shown_by);
    return 0;
  }
  const FilledSequence filled = fill_missing(
      sequence.frames, [&](int frame) { return job_of_frame(job, a, frame); },
      missing_named(a.frames.missing));
  tell_missing(filled, sequence.frames.size(), common);
  sequence.frames = filled.frames;
  sequence = rest_of(sequence, a.frames, common, [&](const Sequence& all, VerifyLevel level) {
    return rest_of_composite(all, filled.job_of, *executor, level);
  });
  if (sequence.frames.empty()) return 0;
  expect_second_frames(a, sequence, filled.job_of);
  if (common.verbose) {
    std::printf("%s", Plate::inspect(filled.job_of(sequence.frames.front()).plate).c_str());
  }
  Progress progress(common);
  composite_sequence(
      sequence, [&](int frame) { return expect_plate(filled.job_of(frame)); },
      report_frames(progress, job.look, job.output, common), *executor);
  return 0;
}

int plan_verb(const CompositeArguments& a, const CommonArguments& common) {
  const CompositeJob job = first_job(a, sequence_of(a.frames, a.water), common);
  expect_one_view(job, "plan");
  const auto executor = executor_of(common);
  if (!a.measure) {
    print_plan(survey_composite(job, *executor), {}, common);
    return 0;
  }
  const MeasuredPlan measured = measure_composite(job, *executor);
  std::vector<double> seconds(measured.times.operators.begin(), measured.times.operators.end());
  seconds.push_back(measured.times.rest);
  print_plan(measured.surveyed, seconds, common);
  return 0;
}

int inspect_verb(const InspectArguments& a, const CommonArguments& common) {
  PlateRequest request;
  request.limits = limits_of(common);
  request.files.assign(a.plates.begin(), a.plates.end());
  request.layers = layer_overrides(a.layers);
  request.view = a.view;
  if (!a.scene.empty()) request.named = load_scene(a.scene).plates;
  if (request.files.empty() && request.named.empty() && request.layers.empty()) {
    throw Error("nothing to inspect: expected plates, or a scene with [plates]", Fault::kUsage);
  }
  std::printf("%s", Plate::inspect(request).c_str());
  return 0;
}

}  // namespace limpid::tool
