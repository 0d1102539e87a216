#include <charconv>
#include <cmath>
#include <cstdio>

#include "limpid/core/error.h"
#include "limpid/load/exr_file.h"
#include "limpid/load/frame_range.h"
#include "limpid/load/gltf.h"
#include "limpid/water.h"

#include "verbs.h"
#include "water_options.h"

namespace limpid::tool {
namespace {

Size size_named(const std::string& text) {
  Size size;
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  const bool cross = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
  const auto height = cross ? std::from_chars(width.ptr + 1, end, size.height) : width;
  if (!cross || height.ec != std::errc() || height.ptr != end) {
    throw Error("--size " + text + ": expected WxH, as in 1920x1080", Fault::kUsage);
  }
  return size;
}

RenderJob job_of(const RenderArguments& a) {
  RenderJob job;
  job.scene = load_scene(a.scene);
  if (job.scene.geometry.empty()) {
    throw Error(a.scene + ": expected a [geometry] with a glTF file to render");
  }
  job.render = {size_named(a.size), a.overscan, a.shadow_map, a.water.simd};
  job.time = a.water.time.value_or(0);
  return job;
}

/// A frame of a sequence and its place in time; one frame without a number where no range was
/// given.
struct Shot {
  std::string output, preview, deep;
  double time;
};

std::vector<Shot> shots_of(const RenderArguments& a) {
  expect_output(a.water.output);
  const WaterOptions& w = a.water;
  if (a.frames.empty()) return {{w.output, w.preview, w.deep, w.time.value_or(0)}};
  if (!(a.fps > 0) || std::isinf(a.fps)) {
    throw Error("--fps " + std::to_string(a.fps) + ": expected a number above 0", Fault::kUsage);
  }
  const std::vector<int> frames = frames_of(a.frames);
  for (const std::string& name : {w.output, w.preview, w.deep}) {
    if (frames.size() > 1 && !name.empty() && !has_frame_number(name)) {
      throw Error(name + ": expected %04d or # for the numbers of " +
                      std::to_string(frames.size()) + " frames",
                  Fault::kUsage);
    }
  }
  std::vector<Shot> shots;
  for (int frame : frames) {
    shots.push_back({name_of_frame(w.output, frame), name_of_frame(w.preview, frame),
                     name_of_frame(w.deep, frame), w.time.value_or(0) + frame / a.fps});
  }
  return shots;
}

Model model_of(const RenderJob& job, const CommonArguments& common) {
  Model model = load_gltf(job.scene.geometry);
  if (model.skipped_triangles > 0 && !common.quiet) {
    std::printf("%s: %lld triangles of no area left out\n", job.scene.geometry.c_str(),
                static_cast<long long>(model.skipped_triangles));
  }
  return model;
}

}  // namespace

int render_verb(const RenderArguments& a, const CommonArguments& common) {
  const std::vector<Shot> shots = shots_of(a);
  RenderJob job = job_of(a);
  const OutputChoice choice = output_of(a.water);
  set_file_threads(common.threads);
  const auto executor = make_executor(common.threads);
  const Model model = model_of(job, common);
  for (const Shot& shot : shots) {
    job.time = shot.time;
    render(model, job, {shot.output, choice.compression, choice.store_float}, *executor);
    if (!common.quiet) std::printf("%s\n", shot.output.c_str());
  }
  return 0;
}

int water_verb(const RenderArguments& a, const CommonArguments& common) {
  if (a.water.dry_run && !a.frames.empty()) frames_of(a.frames);
  const std::vector<Shot> shots = a.water.dry_run ? std::vector<Shot>{} : shots_of(a);
  WaterJob job{job_of(a), look_of(a.water), a.samples, output_of(a.water)};
  set_file_threads(common.threads);
  const auto executor = make_executor(common.threads);
  const Model model = model_of(job.render, common);
  if (a.water.dry_run) {
    const Plan plan = plan_water(model, job);
    std::printf("%srenders %s\n", to_text(plan).c_str(), roles_text(plan.planes).c_str());
    return 0;
  }
  for (const Shot& shot : shots) {
    job.render.time = shot.time;
    job.output.picture = shot.output;
    job.output.preview = shot.preview;
    job.output.deep = shot.deep;
    print_report(water(model, job, *executor), job.look, job.output, common);
  }
  return 0;
}

}  // namespace limpid::tool
