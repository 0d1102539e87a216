#include <cstdio>

#include "limpid/composite.h"
#include "limpid/core/error.h"
#include "limpid/load/exr_file.h"

#include "verbs.h"
#include "water_options.h"

namespace limpid::tool {
namespace {

LayerOverrides layer_overrides(const std::vector<std::string>& texts) {
  LayerOverrides overrides;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw Error("--layer " + text + ": expected ROLE=LAYER, as in depth=ViewLayer.Depth.Z",
                  Fault::kUsage);
    }
    as_usage([&] { role_named(text.substr(0, equals)); });
    overrides[text.substr(0, equals)] = text.substr(equals + 1);
  }
  return overrides;
}

CompositeJob job_of(const CompositeArguments& a) {
  CompositeJob job;
  if (!a.scene.empty()) job.scene = load_scene(a.scene);
  job.plate.files.assign(a.plates.begin(), a.plates.end());
  job.plate.named = job.scene.plates;
  job.plate.layers = layer_overrides(a.layers);
  if (a.plates.empty() && job.plate.named.empty() && job.plate.layers.empty()) {
    throw Error("nothing to put water into: give plates, or a scene that names some",
                Fault::kUsage);
  }
  if (!a.depth_kind.empty()) job.depth_kind = depth_kind_named(a.depth_kind);
  job.look = look_of(a.water);
  job.time = a.water.time;
  job.output = output_of(a.water);
  return job;
}

}  // namespace

int composite_verb(const CompositeArguments& a, const CommonArguments& common) {
  expect_output(a.water.output);
  const CompositeJob job = job_of(a);
  set_file_threads(common.threads);
  const auto executor = make_executor(common.threads);
  if (common.verbose) std::printf("%s", Plate::inspect(job.plate).c_str());
  const CompositeReport report = composite(job, *executor);
  print_report(report, job.look, job.output, common);
  return 0;
}

int plan_verb(const CompositeArguments& a, const CommonArguments& common) {
  const CompositeJob job = job_of(a);
  set_file_threads(common.threads);
  const auto executor = make_executor(common.threads);
  const SurveyedPlan surveyed = survey_composite(job, *executor);
  std::printf("%sreads %s\n", to_text(surveyed.plan, surveyed.survey).c_str(),
              roles_text(surveyed.plan.planes).c_str());
  return 0;
}

int inspect_verb(const InspectArguments& a) {
  PlateRequest request;
  request.files.assign(a.plates.begin(), a.plates.end());
  request.layers = layer_overrides(a.layers);
  if (!a.scene.empty()) request.named = load_scene(a.scene).plates;
  if (request.files.empty() && request.named.empty() && request.layers.empty()) {
    throw Error("nothing to inspect: give plates, or a scene that names some", Fault::kUsage);
  }
  std::printf("%s", Plate::inspect(request).c_str());
  return 0;
}

}  // namespace limpid::tool
