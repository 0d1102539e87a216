#include "limpid/job/composite.h"

#include <cmath>

#include "limpid/core/error.h"
#include "limpid/files/exr/exr_camera.h"

#include "complete/completer.h"
#include "core/toml_text.h"
#include "gpu/gpu_load.h"
#include "job/canvas.h"
#include "job/held_gpu.h"
#include "job/picture_warnings.h"
#include "job/run_jobs.h"
#include "job/shared_textures.h"
#include "plan/pass_of.h"

namespace limpid {
namespace {

/// The job's scene, completed by what only the plate knows: size, pixel aspect, a camera in its
/// attributes, or a whole scene, as limpid render leaves it. No chain can do without camera and
/// water plane.
Scene scene_of(const CompositeJob& job, const Plate& plate) {
  const SceneFile carried = plate.scene();
  Scene scene = job.scene.scene;
  if (!scene.water) scene.water = carried.scene.water;
  if (!scene.sun) scene.sun = carried.scene.sun;
  if (!scene.sky) scene.sky = carried.scene.sky;
  const auto& lens = job.scene.camera ? job.scene.camera : carried.camera;
  scene.camera =
      lens ? camera_for(*lens, plate.display().size(), plate.pixel_aspect()) : plate.camera();
  if (!scene.camera) {
    throw Error(
        "no camera found: expected a scene with [camera] view and projection (or fov_x, fov_y, "
        "orthographic), or a plate with the attributes worldToCamera and worldToNDC");
  }
  if (!scene.water) {
    throw Error("no water plane found: expected a scene with [water] up and height");
  }
  scene.time =
      job.time.of(job.scene, plate.has_scene() ? std::optional(carried.scene.time) : std::nullopt);
  return scene;
}

/// What the depth planes hold. A near and far that were made up, as those of a bare field of view,
/// would give wrong distances.
DepthMeaning depth_of(const CompositeJob& job) {
  const SceneFile& scene = job.scene;
  const DepthKind kind = job.depth_kind.value_or(scene.depth);
  const bool both = scene.near && scene.far;
  if (kind == DepthKind::kNormalised && !(both && std::isfinite(*scene.far))) {
    throw Error("depth of kind normalised: expected near and a finite far in the scene's [camera]");
  }
  const bool known = scene.camera && (scene.camera->lens == CameraSpec::Lens::kProjection || both);
  if (kind == DepthKind::kDevice && !known) {
    throw Error(
        "depth of kind device: expected a projection, or near and far beside the lens, in the "
        "scene's [camera]");
  }
  const auto nothing = job.depth_nothing ? job.depth_nothing : scene.depth_nothing;
  return {kind, scene.near.value_or(0), scene.far.value_or(0), nothing};
}

Plan plan_of(const CompositeJob& job, const Plate& plate, const Scene& scene) {
  if (!plate.planes().has(PlaneId::kDepth)) plate.refuse_without("depth");
  return make_plan(job.look,
                   {.planes = plate.planes(),
                    .wave_map = !job.look.of<WaveNormals>().map.empty(),
                    .sun = scene.sun.has_value(),
                    .environment = has_environment(job.scene),
                    .waves = scene.has_waves()},
                   state_shown_by(computed_aovs(job.output)), job.output.max_error);
}

/// Of the plate and the plan, and of layers that are named in vain.
std::vector<std::string> warnings_of(const CompositeJob& job, const Plate& plate,
                                     const Plan& plan) {
  std::vector<std::string> warnings = plate.warnings();
  warnings.insert(warnings.end(), plan.warnings.begin(), plan.warnings.end());
  const auto unread = [&](const std::string& what) {
    warnings.push_back(what + " is named, and nothing that runs of the look " + job.look.name +
                       " reads it");
  };
  for (const Role& role : roles()) {
    const bool named = plate.named_planes().meets(role.planes());
    if (named && !plan.planes.meets(role.planes())) unread("the layer " + std::string(role.name));
  }
  const bool own_normals = plan.look.of<WaveNormals>().model == WaveNormals::Model::kPlate;
  if (job.output.wave_samples > 1 && own_normals) {
    warnings.push_back("wave_samples = " + std::to_string(job.output.wave_samples) +
                       " sample no waves: they are the frame's own normals, one a pixel");
  }
  if (job.scene.scene.sky && !plan.lit_by_sky) unread("[sky]");
  if (job.scene.scene.sky && plan.lit_by_sky && plan.reads_environment) {
    warnings.push_back("[sky] is given, and the environment lights the water in its stead");
  }
  // It may stand by for a reflection.
  const bool mirrors = plan.reads_environment || plan.planes.meets(kReflectionPlanes);
  if (has_environment(job.scene) && !mirrors) unread("the environment");
  return warnings;
}

/// What a survey looks at: depths, colors, shadows and where the water's normals point; not what it
/// mirrors.
constexpr PlaneSet kUnsurveyed =
    kReflectionPlanes | PlaneSet{PlaneId::kReflectionValid, PlaneId::kReflectionDepth};

/// The jobs of composite().
class CompositeKind {
 public:
  using Job = CompositeJob;
  using Report = CompositeReport;
  struct Prepared {
    Plate plate;
    Scene scene;
    DepthMeaning depth;
    Plan plan;
    TextureFiles textures;
  };

  static JobFiles files(const CompositeJob& job) { return files_of(job); }
  static Prepared prepare(const CompositeJob& job) {
    Plate plate = Plate::open(job.plate);
    Scene scene = scene_of(job, plate);
    const DepthMeaning depth = depth_of(job);
    Plan plan = plan_of(job, plate, scene);
    TextureFiles textures = textures_read(plan, job.scene);
    return {std::move(plate), std::move(scene), depth, std::move(plan), std::move(textures)};
  }
  Record record(const CompositeJob& job, const Prepared& prepared) {
    const auto& [plate, scene, depth, plan, textures] = prepared;
    std::string inputs = "depth_kind = \"" + std::string(depth_kind_name(depth.kind)) + "\"\n";
    if (depth.kind == DepthKind::kNormalised) {
      inputs += "near = " + toml_text(depth.near) + "\nfar = " + toml_text(depth.far) + "\n";
    }
    if (depth.nothing) inputs += "depth_nothing = " + toml_text(*depth.nothing) + "\n";
    inputs += plate.inputs_text(plan.planes) + texture_inputs(textures, textures_);
    Record record = record_of(scene, inputs, picture_options(job.output, gpu_.name(job.output)));
    add_look(record, job.look, plan);
    return record;
  }
  static void expect_writable(const CompositeJob& job) { limpid::expect_writable(job.output); }

  class Frame {
   public:
    explicit Frame(CompositeKind& kind) : kind_(kind) {}

    void read(const CompositeJob& job, Prepared prepared) {
      const Plate& plate = prepared.plate;
      scene_ = std::move(prepared.scene);
      report_.plan = std::move(prepared.plan);
      plate.read(report_.plan.planes, scene_, prepared.depth, loaded_);
      loaded_.frame.overscan = job.output.overscan;
      textures_ = kind_.textures_.load(prepared.textures, job.plate.limits);
      textures_.show_in(loaded_.frame);
      report_.size = loaded_.frame.work().size();
      report_.replaced = loaded_.replaced;
      report_.warnings = warnings_of(job, plate, report_.plan);
      warn_of_picture(report_.plan, loaded_.frame, scene_, report_.warnings);
      warn_of_deep_glass(loaded_.transparent, report_.warnings);
      beyond_ = beyond_of(report_.plan, loaded_.frame, scene_);
      warn_of_beyond(beyond_, report_.warnings);
      refuse_warnings(job.output.strict, report_.warnings);

      file_ = {};
      file_.display = plate.display();
      file_.pixel_aspect = plate.pixel_aspect();
      file_.inherited = plate.attributes();
      file_.matrices = camera_attributes(*scene_.camera);
    }
    void run(const CompositeJob& job, Executor& executor, RunTimes* times = nullptr) {
      canvas_for(canvas_, loaded_.frame.work(), job.output)
          .paint(report_.plan, loaded_.frame, scene_, job.output, executor, times);
    }
    void write(const CompositeJob& job, Record record) {
      file_.text = std::move(record);
      canvas_->write(std::move(file_), job.output);
    }
    CompositeReport& report() { return report_; }
    const Survey& survey() const { return canvas_->survey(); }
    const Beyond& beyond() const { return beyond_; }

   private:
    CompositeKind& kind_;
    CompositeReport report_;
    Beyond beyond_;
    Scene scene_;
    LoadedPlate loaded_;
    HeldTextures textures_;
    ExrOutput file_;  ///< all but the channels and the record
    std::optional<Canvas> canvas_;
  };

 private:
  SharedTextures textures_;
  HeldGpu gpu_;
};

}  // namespace

Plan plan_composite(const CompositeJob& job) { return CompositeKind::prepare(job).plan; }

SurveyedPlan survey_composite(const CompositeJob& job, Executor& executor) {
  CompositeKind::Prepared prepared = CompositeKind::prepare(job);
  const Scene& scene = prepared.scene;
  SurveyedPlan surveyed{std::move(prepared.plan), {}, {}, {}};
  const Plan& plan = surveyed.plan;
  const bool gpu = job.output.runner == Runner::kGpu;
  LoadedPlate loaded =
      prepared.plate.read(gpu ? plan.planes : plan.planes - kUnsurveyed, scene, prepared.depth);
  loaded.frame.overscan = job.output.overscan;
  loaded.frame.validate();
  SharedTextures textures;
  HeldTextures held;
  if (gpu) held = textures.load(prepared.textures, job.plate.limits);
  held.show_in(loaded.frame);
  const Pass pass = pass_of(plan, scene, loaded.frame);
  Completer completer;
  const Frame frame = completer.complete(plan, loaded.frame, pass, executor, &job.output.simd);
  Pass whole = pass_of(plan, scene, frame);
  surveyed.survey.make(plan, frame, whole, executor, job.output.simd);
  if (gpu) {
    if (!plan.reads_environment) whole.environment = {};
    const ShaderProgram program =
        program_of(plan, loaded.frame, frame, whole, compute_shader(computed_aovs(job.output)));
    surveyed.gpu = gpu_load_text(plan, program);
  }
  surveyed.warnings = warnings_of(job, prepared.plate, plan);
  warn_of_picture(plan, frame, scene, surveyed.warnings);
  warn_of_deep_glass(loaded.transparent, surveyed.warnings);
  surveyed.beyond = beyond_of(plan, frame, scene);
  warn_of_beyond(surveyed.beyond, surveyed.warnings);
  refuse_warnings(job.output.strict, surveyed.warnings);
  return surveyed;
}

MeasuredPlan measure_composite(const CompositeJob& job, Executor& executor) {
  if (job.output.runner != Runner::kFused) {
    throw Error("runner " + std::string(runner_name(job.output.runner)) +
                    ": expected fused, for operators are timed in that one alone",
                Fault::kUsage);
  }
  CompositeKind kind;
  CompositeKind::Frame frame(kind);
  frame.read(job, kind.prepare(job));
  RunTimes times;
  for (int i = 0; i < 2; ++i) frame.run(job, executor, &times);
  const CompositeReport& report = frame.report();
  return {{report.plan, frame.survey(), frame.beyond(), report.warnings}, times};
}

CompositeReport composite(const CompositeJob& job, Executor& executor) {
  return run_job(CompositeKind(), job, executor);
}

void composite_sequence(const Sequence& sequence, const JobOfFrame<CompositeJob>& job_of,
                        const OnFrame& on_frame, Executor& executor) {
  run_jobs(CompositeKind(), sequence, job_of, on_frame, executor);
}

Rest rest_of_composite(const Sequence& sequence, const JobOfFrame<CompositeJob>& job_of,
                       Executor& executor, Scrutiny scrutiny) {
  return rest_of_jobs(CompositeKind(), sequence, job_of, executor, scrutiny);
}

}  // namespace limpid
