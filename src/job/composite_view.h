#pragma once
#include <optional>
#include <string>
#include <vector>

#include "limpid/complete/off_frame.h"
#include "limpid/job/composite.h"

#include "job/canvas.h"
#include "job/composite_inputs.h"
#include "job/motion.h"
#include "job/provenance.h"
#include "job/second_surface.h"
#include "job/shared_textures.h"

/// @file
/// One view of a composite: the only one, or one of stereo.

namespace limpid {

/// The decisions before a pixel is read.
struct PreparedView {
  std::string name;  ///< the job's name of the view, or ""
  Plate plate;
  Scene scene;
  DepthMeaning depth;
  Plan plan;
  TextureFiles textures;
  std::vector<PassedPart> passed;
  std::vector<MotionLayer> motion;
  std::optional<PreparedSecond> second = {};  ///< for motion vectors, unless the plate has them
};
PreparedView prepare_view(const CompositeJob& job);

/// The job of one view alone, 0 being the first.
CompositeJob job_of_view(const CompositeJob& job, std::size_t view);

/// Scene, inputs, look and plan; `gpu` as picture_options().
Record record_of(const CompositeJob& job, const PreparedView& view, SharedTextures& textures,
                 const std::string& gpu);

/// The buffers of a view, reused by the next frame.
class CompositeView {
 public:
  /// Reads the planes, and finds the other parts to write. Warnings go into the report, which gets
  /// the plan.
  void read(const CompositeJob& job, PreparedView view, SharedTextures& textures,
            CompositeReport& report);
  void run(const CompositeJob& job, const Plan& plan, Executor& executor, RunTimes* times);
  /// The view for write_frame(); `record` goes into the picture's part. Referenced data lives until
  /// forget().
  WrittenView written(Record record);
  /// Closes the plate's files.
  void forget();

  const Survey& survey() const { return canvas_->survey(); }
  const OffFrameLookups& off_frame() const { return off_frame_; }

 private:
  void run_motion(const OutputChoice& choice, const Plan& plan, Executor& executor);

  OffFrameLookups off_frame_;
  Scene scene_;
  std::optional<SecondSurface> second_;
  LoadedPlate loaded_;
  HeldTextures textures_;
  std::optional<Plate> plate_;     ///< whose layers are passed through
  ExrOutput file_;                 ///< without the picture's channels and the record
  std::vector<ExrOutput> others_;  ///< parts beside it
  MotionChannels motion_;
  std::optional<Canvas> canvas_;
};

}  // namespace limpid
