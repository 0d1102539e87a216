#pragma once
#include <optional>

#include "limpid/core/scene.h"
#include "limpid/job/water.h"
#include "limpid/raster/render_plate.h"

#include "job/canvas.h"
#include "job/provenance.h"
#include "job/shared_textures.h"

namespace limpid {

/// What render() and water() of a job write into their files, found without drawing a pixel.
Record record_of(const HashedModel& model, const PlateJob& job);
Record record_of(const HashedModel& model, const WaterJob& job, SharedTextures& textures);

/// render() in two steps, of three.
class RenderFrame {
 public:
  explicit RenderFrame(const HashedModel& model) : model_(&model) {}

  void read(const PlateJob& job, Executor& executor);
  void run(const PlateJob&, Executor&) {}
  void write(const PlateJob& job);
  const CompositeReport& report() const { return report_; }

 private:
  const HashedModel* model_;
  CompositeReport report_;  ///< sizes and times
  Scene scene_;
  Record record_;
  RenderedPlate plate_;
};

/// water() in three steps, the first of which renders. Another frame may follow.
class WaterFrame {
 public:
  WaterFrame(const HashedModel& model, SharedTextures& textures)
      : model_(&model), textures_(&textures) {}

  void read(const WaterJob& job, Executor& executor);
  void run(const WaterJob& job, Executor& executor);
  void write(const WaterJob& job);
  const CompositeReport& report() const { return report_; }

 private:
  const HashedModel* model_;
  SharedTextures* textures_;
  CompositeReport report_;
  Scene scene_;
  Record record_;
  RenderedPlate plate_;
  SharedTextures::Held wave_map_, environment_;
  std::optional<Canvas> canvas_;
};

}  // namespace limpid
