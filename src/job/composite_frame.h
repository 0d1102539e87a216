#pragma once
#include <optional>

#include "limpid/core/scene.h"
#include "limpid/files/exr/exr_writer.h"
#include "limpid/job/composite.h"
#include "limpid/plate/plate.h"

#include "job/canvas.h"
#include "job/provenance.h"
#include "job/shared_textures.h"

namespace limpid {

/// What composite() of this job writes into its files, found without decoding a pixel. Throws as
/// composite() does.
Record record_of(const CompositeJob& job, SharedTextures& textures);

/// composite() in three steps, each with the same job. Another frame may follow, in the buffers of
/// the one before.
class CompositeFrame {
 public:
  explicit CompositeFrame(SharedTextures& textures) : textures_(&textures) {}

  /// `writes`: whether write() will follow, and can.
  void read(const CompositeJob& job, Executor& executor, bool writes = true);
  void run(const CompositeJob& job, Executor& executor, RunTimes* times = nullptr);
  void write(const CompositeJob& job);
  const CompositeReport& report() const { return report_; }
  const Survey& survey() const { return canvas_->survey(); }
  const Beyond& beyond() const { return beyond_; }

 private:
  SharedTextures* textures_;
  CompositeReport report_;
  Beyond beyond_;
  Scene scene_;
  LoadedPlate loaded_;
  SharedTextures::Held wave_map_, environment_;
  ExrOutput file_;  ///< all but the channels
  std::optional<Canvas> canvas_;
};

}  // namespace limpid
