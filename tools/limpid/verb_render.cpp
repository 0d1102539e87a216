#include <cstdio>

#include "limpid/job/sequence.h"
#include "limpid/job/water.h"

#include "frame_options.h"
#include "notes.h"
#include "scene_jobs.h"
#include "show.h"
#include "verbs.h"
#include "water_options.h"

namespace limpid::tool {

int render_verb(const RenderArguments& a, const CommonArguments& common) {
  expect_output(a.water.output);
  Sequence sequence = sequence_of(a.frames, a.water);
  const OutputChoice choice = output_of(a.water);
  const RenderJob job{scene_job(a, common),
                      render_options(a),
                      {choice.picture, choice.compression, choice.store_float}};
  const auto executor = executor_of(common);
  const Model model = model_to_render(job.scene, a.skip_unsupported, common);
  if (sequence.frames.empty()) {
    render(model, job, *executor);
    if (!common.quiet) std::printf("%s\n", a.water.output.c_str());
    return 0;
  }
  const auto job_of_frame = [&](int frame) {
    RenderJob one = job;
    one.time = time_of_frame(a.frames, a.water, job.scene, false, frame);
    one.output.plate = output_of_frame(choice, frame).picture;
    return one;
  };
  sequence = rest_of(sequence, a.frames, common, [&](const Sequence& all, VerifyLevel level) {
    return rest_of_render(model, all, job_of_frame, *executor, level);
  });
  Progress progress(common);
  const auto tell = [&](const SequenceProgress& at, const CompositeReport&) {
    progress.frame_done(at, output_of_frame(choice, at.frame).picture.string() + "\n");
  };
  render_sequence(model, sequence, job_of_frame, tell, *executor);
  return 0;
}

int water_verb(const RenderArguments& a, const CommonArguments& common) {
  Sequence sequence = sequence_of(a.frames, a.water);
  if (!a.water.dry_run) expect_output(a.water.output);
  const auto shown_by = chosen_protocol(a.water);
  const WaterJob job = water_job(a, common);
  const auto executor = executor_of(common);
  const Model model = model_to_render(job.scene, a.skip_unsupported, common);
  const auto job_of_frame = [&](int frame) { return water_job_of_frame(job, a, frame); };
  if (a.water.dry_run) {
    const Plan plan =
        plan_water(model, sequence.frames.empty() ? job : job_of_frame(sequence.frames.front()));
    tell_warnings(plan.warnings, common.quiet);
    std::printf("%srenders %s\n", to_text(plan).c_str(), roles_text(plan.planes).c_str());
    return 0;
  }
  if (sequence.frames.empty()) {
    const CompositeReport report = water(model, job, *executor);
    print_report(report, job.look, job.output, common);
    if (shown_by) show(report.preview, *shown_by);
    return 0;
  }
  sequence = rest_of(sequence, a.frames, common, [&](const Sequence& all, VerifyLevel level) {
    return rest_of_water(model, all, job_of_frame, *executor, level);
  });
  Progress progress(common);
  water_sequence(model, sequence, job_of_frame,
                 report_frames(progress, job.look, job.output, common), *executor);
  return 0;
}

}  // namespace limpid::tool
