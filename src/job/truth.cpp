#include "job/truth.h"

#include <cmath>
#include <cstdio>
#include <utility>

#include "limpid/files/exr/exr_camera.h"
#include "limpid/plate/texture.h"
#include "limpid/raster/render_plate.h"

#include "core/toml_text.h"
#include "files/exr/exr_whole.h"
#include "files/picture/whole_image.h"
#include "job/canvas.h"
#include "job/run_jobs.h"
#include "job/scene_job.h"
#include "job/shared_textures.h"
#include "ops/wave_normals_kernel.h"

namespace limpid {
namespace {

/// The textures that the look reads besides the model: meshes of waves have normals of their own.
TextureFiles textures_of(const Model& model, const Scene& scene, const TruthJob& job) {
  TextureFiles files;
  const WaveNormals::Params& waves = job.look.of<WaveNormals>();
  const bool raised = renderable(model, scene).covers(kSurfaceNormalPlanes);
  if (!raised && Kernel<WaveNormals>::needs(waves).wave_map) files.wave_map = waves.map;
  const bool surroundings =
      job.light == TruthOptions::Light::kPaths ||
      job.look.of<FresnelReflection>().source == FresnelReflection::Source::kEnvironment;
  if (surroundings && has_environment(job.scene)) {
    files.environment = job.scene.environment;
    files.rotation = job.scene.environment_rotation;
    files.primaries = scene.primaries;
  }
  return files;
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
    const bool exact = info.storage == Storage::kFloat;
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

std::string options_text(const TruthJob& job) {
  return line("runner", toml_text(std::string("traced"))) +
         line("samples", std::to_string(job.samples)) +
         (job.light == TruthOptions::Light::kPaths
              ? line("light", toml_text(std::string("paths"))) +
                    line("paths", std::to_string(job.paths)) +
                    line("photons", std::to_string(job.photons))
              : line("light", toml_text(std::string("once")))) +
         line("seed", std::to_string(job.seed)) + aovs_line(job.output.aovs, job.output.visible) +
         (job.output.preview.empty() ? "" : display_options(job.output.display)) +
         file_options(job.output.compression, job.output.store_float);
}

/// More digits would be noise.
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

/// The jobs of truth().
class TruthKind {
 public:
  using Job = TruthJob;
  using Report = TruthReport;
  struct Prepared {
    Scene scene;
    TextureFiles textures;
  };

  explicit TruthKind(const Model& model) : model_(model) {}

  JobFiles files(const TruthJob& job) const {
    OutputChoice named;
    named.picture = job.output.picture;
    named.preview = job.output.preview;
    return {inputs_of(*model_.model, job.scene, job.look), outputs_of(named)};
  }
  Prepared prepare(const TruthJob& job) const {
    Scene scene = scene_of(*model_.model, job, job.size);
    TextureFiles textures = textures_of(*model_.model, scene, job);
    return {std::move(scene), std::move(textures)};
  }
  /// Without `limpid/noise`, which is known only after tracing.
  Record record(const TruthJob& job, const Prepared& prepared) {
    const std::string inputs =
        model_inputs(model_, job.size) + texture_inputs(prepared.textures, textures_);
    Record record = record_of(prepared.scene, inputs, options_text(job));
    add_look(record, job.look);
    return record;
  }
  static void expect_writable(const TruthJob& job) {
    limpid::expect_writable(job.output.picture);
    if (job.output.preview.empty()) return;
    expect_preview_writable(job.output.preview);
    expect_display(job.output.display);
  }

  class Frame {
   public:
    explicit Frame(TruthKind& kind) : kind_(kind) {}

    void read(const TruthJob& job, Prepared prepared) {
      report_.size = job.size;
      scene_ = std::move(prepared.scene);
      textures_ = kind_.textures_.load(prepared.textures, job.limits);
    }
    void run(const TruthJob& job, Executor& executor) {
      const TruthOptions options{job.size,
                                 job.samples,
                                 job.light,
                                 job.paths,
                                 job.photons,
                                 job.seed,
                                 job.output.aovs,
                                 job.output.visible,
                                 texture_of(textures_.wave_map),
                                 texture_of(textures_.environment)};
      picture_ = {};  // freed before a new one is made
      picture_ = trace_truth(*kind_.model_.model, scene_, job.look, options, executor);
      report_.relative_error = picture_.relative_error;
    }
    void write(const TruthJob& job, Record record) {
      ExrOutput file = file_of(picture_, scene_, job);
      file.text = std::move(record);
      if (!std::isnan(picture_.relative_error)) {
        file.text["limpid/noise"] = noise_text(picture_.relative_error);
      }
      AtomicFiles files;
      if (!job.output.preview.empty()) {
        const auto& c = picture_.target.color;
        write_preview(files, job.output.preview, {c[0], c[1], c[2]},
                      DisplayTransform(job.output.display), file.text);
      }
      write_exr(files, job.output.picture, file);
      files.commit();
    }
    TruthReport& report() { return report_; }

   private:
    TruthKind& kind_;
    TruthReport report_;
    Scene scene_;
    HeldTextures textures_;
    TruthPicture picture_;
  };

 private:
  HashedModel model_;
  SharedTextures textures_;
};

}  // namespace

TruthReport truth(const Model& model, const TruthJob& job, Executor& executor) {
  return run_job(TruthKind(model), job, executor);
}

void truth_sequence(const Model& model, const Sequence& sequence,
                    const JobOfFrame<TruthJob>& job_of, const OnFrameOf<TruthReport>& on_frame,
                    Executor& executor) {
  run_jobs(TruthKind(model), sequence, job_of, on_frame, executor);
}

Rest rest_of_truth(const Model& model, const Sequence& sequence, const JobOfFrame<TruthJob>& job_of,
                   Executor& executor, VerifyLevel level) {
  return rest_of_jobs(TruthKind(model), sequence, job_of, executor, level);
}

std::vector<FrameFault> faults_of_truth(const Model& model, const Sequence& sequence,
                                        const JobOfFrame<TruthJob>& job_of, Executor& executor) {
  return faults_of_jobs(TruthKind(model), sequence, job_of, executor);
}

}  // namespace limpid
