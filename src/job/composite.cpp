#include "limpid/job/composite.h"

#include "limpid/core/error.h"
#include "limpid/files/exr/exr_camera.h"

#include "complete/completer.h"
#include "core/toml_text.h"
#include "gpu/gpu_load.h"
#include "job/canvas.h"
#include "job/composite_inputs.h"
#include "job/held_gpu.h"
#include "job/picture_warnings.h"
#include "job/run_jobs.h"
#include "job/shared_textures.h"
#include "job/sheet.h"
#include "plan/pass_of.h"

namespace limpid {
namespace {

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
      beyond_ = beyond_of(report_.plan, loaded_.frame, scene_);
      report_.warnings = warnings_of(job, plate, report_.plan);
      warn_of_pixels(report_.plan, loaded_.frame, scene_, loaded_.transparent, report_.warnings);
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
      report_.preview = preview_pixels(*canvas_, file_.display, job.output);
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
  surveyed.beyond = beyond_of(plan, frame, scene);
  surveyed.warnings = warnings_of(job, prepared.plate, plan);
  warn_of_pixels(plan, frame, scene, loaded.transparent, surveyed.warnings);
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
