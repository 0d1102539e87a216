#include "limpid/files/exr/exr_camera.h"
#include "limpid/job/water.h"

#include "job/canvas.h"
#include "job/run_jobs.h"
#include "job/scene_job.h"

namespace limpid {
namespace {

/// The jobs of render().
class RenderKind {
 public:
  using Job = RenderJob;
  using Report = CompositeReport;  ///< size and times
  struct Prepared {
    Scene scene;
  };

  explicit RenderKind(const Model& model) : model_(model) {}

  JobFiles files(const RenderJob& job) const { return files_of(*model_.model, job); }
  Prepared prepare(const RenderJob& job) const {
    return {scene_of(*model_.model, job, job.render.size)};
  }
  Record record(const RenderJob& job, const Prepared& prepared) const {
    return record_of(prepared.scene, model_inputs(model_, job.render),
                     raster_options(job.render.simd) +
                         file_options(job.output.compression, job.output.store_float));
  }
  static void expect_writable(const RenderJob& job) { limpid::expect_writable(job.output.plate); }

  class Frame {
   public:
    explicit Frame(const RenderKind& kind) : model_(*kind.model_.model) {}

    void read(const RenderJob& job, Prepared prepared) {
      scene_ = std::move(prepared.scene);
      report_.size = job.render.size;
    }
    void run(const RenderJob& job, Executor& executor) {
      plate_ = {};  // freed before a new one is made
      plate_ = render_plate(model_, scene_, job.render, renderable(model_, scene_), executor);
    }
    void write(const RenderJob& job, Record record) {
      ExrOutput file;
      file.data = plate_.planes[0].view().window;
      file.display = plate_.frame.display;
      file.compression = job.output.compression;
      file.matrices = camera_attributes(*scene_.camera);
      file.text = std::move(record);
      for (const Role& role : roles()) {
        const bool half = !job.output.store_float && role.storage == Storage::kHalf;
        for (int i = 0; i < role.count; ++i) {
          const Plane& plane = plate_.planes[static_cast<std::size_t>(index_of(role.first) + i)];
          if (plane) file.channels.push_back({channel_name(role, i), plane.view(), half});
        }
      }
      write_exr(job.output.plate, file);
    }
    CompositeReport& report() { return report_; }

   private:
    const Model& model_;
    CompositeReport report_;
    Scene scene_;
    RenderedPlate plate_;
  };

 private:
  HashedModel model_;
};

}  // namespace

void render(const Model& model, const RenderJob& job, Executor& executor) {
  run_job(RenderKind(model), job, executor);
}

void render_sequence(const Model& model, const Sequence& sequence,
                     const JobOfFrame<RenderJob>& job_of, const OnFrame& on_frame,
                     Executor& executor) {
  run_jobs(RenderKind(model), sequence, job_of, on_frame, executor);
}

Rest rest_of_render(const Model& model, const Sequence& sequence,
                    const JobOfFrame<RenderJob>& job_of, Executor& executor, VerifyLevel level) {
  return rest_of_jobs(RenderKind(model), sequence, job_of, executor, level);
}

}  // namespace limpid
