#include "job/truth.h"

#include <cmath>
#include <cstdio>
#include <utility>

#include "limpid/files/exr/exr_camera.h"
#include "limpid/plate/texture.h"
#include "limpid/raster/render_plate.h"

#include "files/exr/exr_whole.h"
#include "files/picture/whole_image.h"
#include "job/canvas.h"
#include "job/provenance.h"
#include "job/shared_textures.h"
#include "job/stopwatch.h"

namespace limpid {
namespace {

Scene scene_of(const Model& model, const TruthJob& job) {
  Scene scene = job.scene.scene;
  if (job.scene.camera) scene.camera = camera_for(*job.scene.camera, job.size);
  scene.time = job.time;
  return scene_of_model(scene, model, job.size);
}

/// What the look reads beside the model: raised meshes have normals of their own.
struct Textures {
  LoadedTexture wave_map, environment;
  std::string inputs;  ///< what a record says of them
};
Textures textures_of(const Model& model, const Scene& scene, const TruthJob& job) {
  Textures textures;
  SharedTextures files;
  const WaveNormals::Params& waves = job.look.of<WaveNormals>();
  const bool raised = renderable(model, scene).covers(kSurfaceNormalPlanes);
  if (!raised && WaveNormals::needs(waves).wave_map && !waves.map.empty()) {
    textures.wave_map = load_texture(waves.map);
    textures.inputs += wave_map_input(waves.map, files);
  }
  const bool surroundings =
      job.light == TruthOptions::Light::kPaths ||
      job.look.of<FresnelReflection>().source == FresnelReflection::Source::kEnvironment;
  if (surroundings && has_environment(job.scene)) {
    textures.environment = load_environment(job.scene.environment, job.scene.environment_rotation);
    textures.inputs += environment_input(job.scene, files);
  }
  return textures;
}

std::vector<ExrOutputChannel> channels_of(const TruthPicture& picture, const TruthOutput& output) {
  std::vector<ExrOutputChannel> channels;
  const auto add = [&](const std::string& name, const View<float>& from, bool exact) {
    channels.push_back({name, from, !output.store_float && !exact});
  };
  for (std::size_t c = 0; c < 3; ++c) {
    add(std::string(1, "RGB"[c]), picture.target.color[c], false);
  }
  add("A", picture.target.alpha, false);
  for (Aov aov : output.aovs) {
    const AovInfo& info = aovs()[static_cast<std::size_t>(aov)];
    const bool exact = info.suffixes == "Z" || info.suffixes == "UV";
    for (std::size_t c = 0; c < info.suffixes.size(); ++c) {
      add(std::string(info.name) + "." + info.suffixes[c], picture.target.of(aov)[c], exact);
    }
  }
  for (std::size_t c = 0; c < 3 && output.visible; ++c) {
    add(std::string("visible.") + "RGB"[c], picture.visible[c], false);
    add(std::string("visible_below.") + "RGB"[c], picture.visible_below[c], false);
  }
  return channels;
}

Record record_of(const Model& model, const TruthJob& job, const Scene& scene,
                 const Textures& textures) {
  Record record = record_of(scene, model_inputs(HashedModel(model), job.size) + textures.inputs,
                            truth_options(job));
  add_look(record, job.look);
  return record;
}

/// A hundredth of it tells nothing.
std::string noise_text(double relative_error) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", relative_error);
  return text;
}

ExrOutput file_of(const TruthPicture& picture, const Scene& scene, const TruthJob& job) {
  ExrOutput file;
  file.data = file.display = picture.window;
  file.compression = job.output.compression;
  file.channels = channels_of(picture, job.output);
  file.matrices = camera_attributes(*scene.camera);
  return file;
}

}  // namespace

JobFiles files_of(const Model& model, const TruthJob& job) {
  return {inputs_of(model, job.scene, job.look), {job.output.picture, job.output.preview}};
}

TruthReport truth(const Model& model, const TruthJob& job, Executor& executor) {
  Stopwatch watch;
  TruthReport report;
  report.size = job.size;
  expect_apart(files_of(model, job));
  // The Error that writing would end with, before the work is done.
  expect_writable(job.output.picture);
  if (!job.output.preview.empty()) expect_preview_writable(job.output.preview);
  const Scene scene = scene_of(model, job);
  const Textures textures = textures_of(model, scene, job);
  const TruthOptions options{job.size,
                             job.samples,
                             job.light,
                             job.paths,
                             job.photons,
                             job.seed,
                             job.output.aovs,
                             job.output.visible,
                             textures.wave_map.texture,
                             textures.environment.texture};
  const TruthPicture picture = trace_truth(model, scene, job.look, options, executor);
  report.trace_seconds = watch.lap();
  ExrOutput file = file_of(picture, scene, job);
  file.text = record_of(model, job, scene, textures);
  report.relative_error = picture.relative_error;
  if (!std::isnan(picture.relative_error)) {
    file.text["limpid/noise"] = noise_text(picture.relative_error);
  }
  AtomicFiles files;
  if (!job.output.preview.empty()) {
    const auto& c = picture.target.color;
    write_preview(files, job.output.preview, c[0], c[1], c[2], 0, file.text);
  }
  write_exr(files, job.output.picture, file);
  files.commit();
  report.write_seconds = watch.lap();
  return report;
}

}  // namespace limpid
