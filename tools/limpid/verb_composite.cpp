#include <cmath>
#include <cstdio>
#include <span>
#include <vector>

#include "limpid/core/error.h"
#include "limpid/files/text/frame_range.h"
#include "limpid/job/composite.h"
#include "limpid/job/sequence.h"

#include "frame_options.h"
#include "memory_limit.h"
#include "notes.h"
#include "verbs.h"
#include "water_options.h"

namespace limpid::tool {
namespace {

LayerOverrides layer_overrides(const std::vector<std::string>& texts) {
  LayerOverrides overrides;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    const bool whole = equals != std::string::npos && equals > 0 && equals + 1 < text.size();
    if (!whole || text.ends_with(':') || text[equals + 1] == ':') {
      throw Error("--layer " + text +
                      ": expected ROLE=LAYER, as in depth=ViewLayer.Depth.Z, depth=plate.exr:Z or "
                      "depth=none",
                  Fault::kUsage);
    }
    as_usage([&] { role_named(text.substr(0, equals)); });
    overrides[text.substr(0, equals)] = text.substr(equals + 1);
  }
  return overrides;
}

double finite_nothing(double depth) {
  if (std::isfinite(depth)) return depth;
  throw Error("--depth-nothing " + std::to_string(depth) +
                  ": expected a finite number, for inf is nothing always",
              Fault::kUsage);
}

/// What the jobs of all frames have in common.
CompositeJob common_job(const CompositeArguments& a, const Sequence& sequence,
                        const CommonArguments& common) {
  CompositeJob job;
  job.plate.limits = limits_of(common);
  const bool alone = sequence.frames.empty();
  if (!a.scene.empty()) {
    job.scene = load_scene(alone ? a.scene : name_of_frame(a.scene, sequence.frames.front()));
  }
  job.plate.files.assign(a.plates.begin(), a.plates.end());
  job.plate.named = job.scene.plates;
  job.plate.layers = layer_overrides(a.layers);
  job.plate.view = a.view;
  if (a.plates.empty() && job.plate.named.empty() && job.plate.layers.empty()) {
    throw Error("nothing to put water into: give plates, or a scene that names some",
                Fault::kUsage);
  }
  if (!a.depth_kind.empty()) job.depth_kind = depth_kind_named(a.depth_kind);
  if (a.depth_nothing) job.depth_nothing = finite_nothing(*a.depth_nothing);
  job.look = look_of(a.water);
  job.time.asked = a.water.time;
  job.output = output_of(a.water);
  job.output.wave_samples = a.samples;
  job.output.overscan = a.overscan;
  return job;
}

CompositeJob job_of_frame(CompositeJob job, const CompositeArguments& a, int frame) {
  if (has_frame_number(a.scene)) {
    job.scene = load_scene(name_of_frame(a.scene, frame));
    job.plate.named = job.scene.plates;
  }
  for (auto& file : job.plate.files) file = name_of_frame(file.string(), frame);
  for (auto& [role, name] : job.plate.named) name = name_of_frame(name, frame);
  for (auto& [role, name] : job.plate.layers) name = name_of_frame(name, frame);
  job.time = time_of_frame(a.frames, a.water, job.scene, has_frame_number(a.scene), frame);
  job.output = output_of_frame(job.output, frame);
  return job;
}

/// The only job, or the first frame's.
CompositeJob first_job(const CompositeArguments& a, const Sequence& sequence,
                       const CommonArguments& common) {
  CompositeJob job = common_job(a, sequence, common);
  if (sequence.frames.empty()) return job;
  return job_of_frame(std::move(job), a, sequence.frames.front());
}

/// Throws Error that says what there is to do about a file that is not there.
CompositeJob expect_plate(CompositeJob job) {
  if (const auto missing = missing_file(job)) {
    throw Error(missing->string() +
                ": cannot be opened (no such file or directory); bring it, or " +
                "say --missing skip or hold to go on without it");
  }
  return job;
}

void print_plan(const SurveyedPlan& surveyed, std::span<const double> seconds,
                const CommonArguments& common) {
  tell_warnings(surveyed.warnings, common.quiet);
  std::printf("%sreads %s\n%s\n%s", to_text(surveyed.plan, surveyed.survey, seconds).c_str(),
              roles_text(surveyed.plan.planes).c_str(), to_text(surveyed.beyond).c_str(),
              surveyed.gpu.c_str());
}

}  // namespace

int composite_verb(const CompositeArguments& a, const CommonArguments& common) {
  expect_output(a.water.output);
  Sequence sequence = sequence_of(a.frames, a.water);
  const CompositeJob job = common_job(a, sequence, common);
  const auto executor = executor_of(common);
  if (sequence.frames.empty()) {
    if (common.verbose) std::printf("%s", Plate::inspect(job.plate).c_str());
    const CompositeReport report = composite(job, *executor);
    print_report(report, job.look, job.output, common);
    return 0;
  }
  const FilledSequence filled = fill_missing(
      sequence.frames, [&](int frame) { return job_of_frame(job, a, frame); },
      missing_named(a.frames.missing));
  tell_missing(filled, sequence.frames.size(), common);
  sequence.frames = filled.frames;
  sequence = rest_of(sequence, a.frames, common, [&](const Sequence& all, Scrutiny scrutiny) {
    return rest_of_composite(all, filled.job_of, *executor, scrutiny);
  });
  if (sequence.frames.empty()) return 0;
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
    throw Error("nothing to inspect: give plates, or a scene that names some", Fault::kUsage);
  }
  std::printf("%s", Plate::inspect(request).c_str());
  return 0;
}

}  // namespace limpid::tool
