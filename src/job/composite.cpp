#include "limpid/job/composite.h"

#include "limpid/core/error.h"

#include "complete/completer.h"
#include "gpu/gpu_load.h"
#include "job/canvas.h"
#include "job/composite_inputs.h"
#include "job/composite_view.h"
#include "job/held_gpu.h"
#include "job/picture_warnings.h"
#include "job/run_jobs.h"
#include "job/shared_textures.h"
#include "job/sheet.h"
#include "job/stereo.h"
#include "plan/pass_of.h"

namespace limpid {
namespace {

/// A survey reads depths, colors, shadows and the water's normals; not the reflected planes.
constexpr PlaneSet kUnsurveyed =
    kReflectionPlanes | PlaneSet{PlaneId::kReflectionValid, PlaneId::kReflectionDepth};

/// The jobs of composite().
class CompositeKind {
 public:
  using Job = CompositeJob;
  using Report = CompositeReport;
  struct Prepared {
    std::vector<PreparedView> views;
  };

  static JobFiles files(const CompositeJob& job) { return files_of(job); }
  static Prepared prepare(const CompositeJob& job) {
    Prepared prepared;
    for (std::size_t i = 0; i <= job.other_views.size(); ++i) {
      prepared.views.push_back(prepare_view(job_of_view(job, i)));
    }
    expect_views(job, prepared.views);
    return prepared;
  }
  Record record(const CompositeJob& job, const Prepared& prepared) {
    const std::string gpu = gpu_.name(job.output);
    Record record = record_of(job, prepared.views.front(), textures_, gpu);
    for (std::size_t i = 1; i < prepared.views.size(); ++i) {
      const PreparedView& view = prepared.views[i];
      add_view(record, view.name, record_of(job_of_view(job, i), view, textures_, gpu));
    }
    return record;
  }
  static void expect_writable(const CompositeJob& job) { limpid::expect_writable(job.output); }

  class Frame {
   public:
    explicit Frame(CompositeKind& kind) : kind_(kind) {}

    void read(const CompositeJob& job, Prepared prepared) {
      views_.resize(prepared.views.size());
      plans_.clear();
      names_.clear();
      for (std::size_t i = 0; i < views_.size(); ++i) {
        names_.push_back(prepared.views[i].name);
        CompositeReport report;
        views_[i].read(job_of_view(job, i), std::move(prepared.views[i]), kind_.textures_, report);
        plans_.push_back(report.plan);
        if (i == 0) {
          report_ = std::move(report);
        } else {
          add_view(report_, names_[i], report);
        }
      }
    }
    void run(const CompositeJob& job, Executor& executor, RunTimes* times = nullptr) {
      for (std::size_t i = 0; i < views_.size(); ++i) {
        views_[i].run(job, plans_[i], executor, times);
      }
    }
    void write(const CompositeJob& job, Record record) {
      std::vector<WrittenView> written;
      for (std::size_t i = 0; i < views_.size(); ++i) {
        written.push_back(views_[i].written(i == 0 ? record : record_of_view(record, names_[i])));
        written.back().view = names_[i];
      }
      const WrittenView& first = written.front();
      report_.preview =
          preview_pixels(*first.canvas, first.described.display, job.output, first.primaries);
      write_frame(std::move(written), job.output);
      for (CompositeView& view : views_) view.forget();
    }
    CompositeReport& report() { return report_; }
    const Survey& survey() const { return views_.front().survey(); }
    const OffFrameLookups& off_frame() const { return views_.front().off_frame(); }

   private:
    CompositeKind& kind_;
    CompositeReport report_;
    std::vector<CompositeView> views_;
    std::vector<Plan> plans_;
    std::vector<std::string> names_;
  };

 private:
  SharedTextures textures_;
  HeldGpu gpu_;
};

}  // namespace

Plan plan_composite(const CompositeJob& job) { return prepare_view(job).plan; }

SurveyedPlan survey_composite(const CompositeJob& job, Executor& executor) {
  PreparedView prepared = prepare_view(job);
  const Scene& scene = prepared.scene;
  SurveyedPlan surveyed{std::move(prepared.plan), {}, {}, {}};
  const Plan& plan = surveyed.plan;
  const bool gpu = job.output.runner == Runner::kGpu;
  LoadedPlate loaded =
      prepared.plate.read(gpu ? plan.planes : plan.planes - kUnsurveyed, scene, prepared.depth);
  loaded.frame.overscan = job.output.overscan;
  loaded.frame.validate();
  SharedTextures textures;
  const HeldTextures held = textures.load(prepared.textures, job.plate.limits);
  held.show_in(loaded.frame);  // completers and cells depend on the wave map
  const Pass pass = pass_of(plan, scene, loaded.frame);
  Completer completer;
  const Frame frame = completer.complete(plan, loaded.frame, pass, executor, &job.output.simd);
  Pass whole = pass_of(plan, scene, frame);
  whole.plate_waves = completer.plate_waves();
  surveyed.survey.make(plan, frame, whole, executor, job.output.simd);
  if (gpu) {
    if (!plan.reads_environment) whole.environment = {};
    const ShaderProgram program =
        program_of(plan, loaded.frame, frame, whole, compute_shader(computed_aovs(job.output)),
                   Gathered::kAll);
    surveyed.gpu = gpu_load_text(plan, scene, program);
  }
  surveyed.off_frame = off_frame_lookups_of(plan, frame, scene);
  surveyed.warnings = warnings_of(job, prepared.plate, plan);
  warn_of_pixels(job, plan, frame, scene, loaded.transparent, surveyed.warnings);
  warn_of_off_frame(surveyed.off_frame, surveyed.warnings);
  refuse_warnings(job.output.strict, surveyed.warnings);
  return surveyed;
}

MeasuredPlan measure_composite(const CompositeJob& job, Executor& executor) {
  if (job.output.runner != Runner::kFused) {
    throw Error("runner " + std::string(runner_name(job.output.runner)) +
                    ": expected fused, the only runner that times operators",
                Fault::kUsage);
  }
  CompositeKind kind;
  CompositeKind::Frame frame(kind);
  frame.read(job, kind.prepare(job));
  RunTimes times;
  for (int i = 0; i < 2; ++i) frame.run(job, executor, &times);
  const CompositeReport& report = frame.report();
  return {{report.plan, frame.survey(), frame.off_frame(), report.warnings}, times};
}

CompositeReport composite(const CompositeJob& job, Executor& executor) {
  return run_job(CompositeKind(), job, executor);
}

void composite_sequence(const Sequence& sequence, const JobOfFrame<CompositeJob>& job_of,
                        const OnFrame& on_frame, Executor& executor) {
  run_jobs(CompositeKind(), sequence, job_of, on_frame, executor);
}

Rest rest_of_composite(const Sequence& sequence, const JobOfFrame<CompositeJob>& job_of,
                       Executor& executor, VerifyLevel level) {
  return rest_of_jobs(CompositeKind(), sequence, job_of, executor, level);
}

std::vector<FrameFault> faults_of_composite(const Sequence& sequence,
                                            const JobOfFrame<CompositeJob>& job_of,
                                            Executor& executor) {
  return faults_of_jobs(CompositeKind(), sequence, job_of, executor);
}

}  // namespace limpid
