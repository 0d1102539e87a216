#include "scene_jobs.h"

#include "limpid/core/error.h"
#include "limpid/files/text/frame_range.h"

#include "frame_options.h"
#include "memory_limit.h"
#include "water_options.h"

namespace limpid::tool {
namespace {

/// The AOVs of water, except those of guesses and buffers, which the truth has not, and `visible`.
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
  throw Error("--paths " + std::to_string(*a.paths) + ": single scattering has no paths",
              Fault::kUsage);
}

}  // namespace

SceneJob scene_job(const RenderArguments& a, const CommonArguments& common) {
  return {scene_to_render(a.scene), {.explicit_time = a.water.time}, limits_of(common)};
}

RenderOptions render_options(const RenderArguments& a) {
  return {size_named(a.size), a.overscan, a.shadow_map, a.water.simd};
}

WaterJob water_job(const RenderArguments& a, const CommonArguments& common) {
  return {scene_job(a, common), render_options(a), look_of(a.water), a.samples, output_of(a.water)};
}

TruthJob truth_job(const TruthArguments& a, const CommonArguments& common) {
  // Checked like those of water.
  WaterOptions files = a.water;
  files.aovs.clear();
  const OutputChoice choice = output_of(files);
  TruthJob job;
  job.scene = scene_to_render(a.scene);
  job.size = size_named(a.size);
  job.time.explicit_time = a.water.time;
  job.limits = limits_of(common);
  job.look = look_of(a.water);
  job.samples = a.samples;
  job.light = light_named(a);
  job.paths = a.paths.value_or(job.paths);
  job.photons = a.photons;
  job.seed = a.seed;
  job.output.picture = choice.picture;
  job.output.preview = choice.preview;
  job.output.display = choice.display;
  job.output.compression = choice.compression;
  job.output.store_float = choice.store_float;
  choose_aovs(a.water.aovs, job.output);
  return job;
}

WaterJob water_job_of_frame(WaterJob job, const RenderArguments& a, int frame) {
  job.time = time_of_frame(a.frames, a.water, job.scene, false, frame);
  job.output = output_of_frame(job.output, frame);
  return job;
}

TruthJob truth_job_of_frame(TruthJob job, const TruthArguments& a, int frame) {
  job.output.picture = name_of_frame(job.output.picture.string(), frame);
  job.output.preview = name_of_frame(job.output.preview.string(), frame);
  job.time = time_of_frame(a.frames, a.water, job.scene, false, frame);
  return job;
}

}  // namespace limpid::tool
