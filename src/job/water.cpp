#include "limpid/job/water.h"

#include <algorithm>

#include "limpid/core/error.h"
#include "limpid/files/exr/exr_camera.h"

#include "job/canvas.h"
#include "job/held_gpu.h"
#include "job/picture_warnings.h"
#include "job/run_jobs.h"
#include "job/scene_job.h"
#include "job/shared_textures.h"
#include "job/sheet.h"
#include "job/stopwatch.h"

namespace limpid {
namespace {

Plan plan_of(const Model& model, const Scene& scene, const WaterJob& job) {
  return make_plan(job.look,
                   {.planes = renderable(model, scene),
                    .wave_map = !job.look.of<WaveNormals>().map.empty(),
                    .sun = scene.sun.has_value(),
                    .environment = has_environment(job.scene),
                    .waves = scene.has_waves(),
                    .primaries = scene.primaries},
                   state_shown_by(computed_aovs(job.output)), job.output.max_error);
}

void check(const WaterJob& job) {
  if (job.samples < 1 || job.samples > kMaxSamples) {
    throw Error("samples = " + std::to_string(job.samples) + ": expected 1 ... " +
                    std::to_string(kMaxSamples),
                Fault::kUsage);
  }
  if (job.samples > 1 && !job.output.deep.empty()) {
    throw Error("samples = " + std::to_string(job.samples) + " and a deep file: expected 1, " +
                    "since depths of several samples have no mean",
                Fault::kUsage);
  }
  const Size size = job.render.size;
  const int most = kMaxRenderedSide / job.samples;
  if (std::max({size.width, size.height, job.render.overscan}) > most) {
    throw Error("size " + std::to_string(size.width) + "x" + std::to_string(size.height) +
                    ", overscan " + std::to_string(job.render.overscan) + ", samples " +
                    std::to_string(job.samples) + ": expected at most " + std::to_string(most) +
                    " pixels a side",
                Fault::kUsage);
  }
}

/// The jobs of water().
class WaterKind {
 public:
  using Job = WaterJob;
  using Report = CompositeReport;
  struct Prepared {
    Scene scene;
    Plan plan;
    TextureFiles textures;
  };

  explicit WaterKind(const Model& model) : model_(model) {}

  JobFiles files(const WaterJob& job) const { return files_of(*model_.model, job); }
  Prepared prepare(const WaterJob& job) const {
    check(job);
    Scene scene = scene_of(*model_.model, job, job.render.size);
    Plan plan = plan_of(*model_.model, scene, job);
    TextureFiles textures = textures_read(plan, job.scene);
    return {std::move(scene), std::move(plan), std::move(textures)};
  }
  Record record(const WaterJob& job, const Prepared& prepared) {
    const std::string inputs = model_inputs(model_, job.render) +
                               "samples = " + std::to_string(job.samples) + "\n" +
                               texture_inputs(prepared.textures, textures_);
    const std::string options =
        raster_options(job.render.simd) + picture_options(job.output, gpu_.name(job.output));
    Record record = record_of(prepared.scene, inputs, options);
    add_look(record, job.look, prepared.plan);
    return record;
  }
  static void expect_writable(const WaterJob& job) { limpid::expect_writable(job.output); }

  class Frame {
   public:
    explicit Frame(WaterKind& kind) : kind_(kind) {}

    void read(const WaterJob& job, Prepared prepared) {
      scene_ = std::move(prepared.scene);
      report_.plan = std::move(prepared.plan);
      report_.size = job.render.size;
      textures_ = kind_.textures_.load(prepared.textures, job.limits);
    }
    void run(const WaterJob& job, Executor& executor) {
      Stopwatch watch;
      RenderOptions options = job.render;
      options.size = {options.size.width * job.samples, options.size.height * job.samples};
      options.overscan *= job.samples;
      plate_ = {};  // freed before a new one is made
      plate_ = render_plate(*kind_.model_.model, scene_, options, report_.plan.planes, executor);
      report_.replaced = sanitise_planes(plate_.planes, scene_.water->up);
      textures_.show_in(plate_.frame);
      report_.warnings = report_.plan.warnings;
      warn_of_picture(report_.plan, plate_.frame, scene_, report_.warnings);
      refuse_warnings(job.output.strict, report_.warnings);
      const double drawn = watch.lap();  // drawing replaces reading
      report_.read_seconds += drawn;
      report_.run_seconds -= drawn;
      canvas_for(canvas_, plate_.frame.work(), job.output)
          .paint(report_.plan, plate_.frame, scene_, job.output, executor);
    }
    void write(const WaterJob& job, Record record) {
      ExrOutput file;
      file.display = rect_of(report_.size);
      file.matrices = camera_attributes(*scene_.camera);
      file.text = std::move(record);
      std::optional<Canvas> filtered;
      if (job.samples > 1) filtered = canvas_->filtered(job.samples, job.output);
      const Canvas& canvas = filtered ? *filtered : *canvas_;
      report_.preview = preview_pixels(canvas, file.display, job.output);
      canvas.write(file, job.output);
    }
    CompositeReport& report() { return report_; }

   private:
    WaterKind& kind_;
    CompositeReport report_;
    Scene scene_;
    RenderedPlate plate_;
    HeldTextures textures_;
    std::optional<Canvas> canvas_;
  };

 private:
  HashedModel model_;
  SharedTextures textures_;
  HeldGpu gpu_;
};

}  // namespace

Plan plan_water(const Model& model, const WaterJob& job) {
  return plan_of(model, scene_of(model, job, job.render.size), job);
}

CompositeReport water(const Model& model, const WaterJob& job, Executor& executor) {
  return run_job(WaterKind(model), job, executor);
}

void water_sequence(const Model& model, const Sequence& sequence,
                    const JobOfFrame<WaterJob>& job_of, const OnFrame& on_frame,
                    Executor& executor) {
  run_jobs(WaterKind(model), sequence, job_of, on_frame, executor);
}

Rest rest_of_water(const Model& model, const Sequence& sequence, const JobOfFrame<WaterJob>& job_of,
                   Executor& executor, VerifyLevel level) {
  return rest_of_jobs(WaterKind(model), sequence, job_of, executor, level);
}

std::vector<FrameFault> faults_of_water(const Model& model, const Sequence& sequence,
                                        const JobOfFrame<WaterJob>& job_of, Executor& executor) {
  return faults_of_jobs(WaterKind(model), sequence, job_of, executor);
}

}  // namespace limpid
