#pragma once
#include <optional>

#include "limpid/core/scene.h"
#include "limpid/raster/render_plate.h"
#include "limpid/water.h"

#include "canvas.h"
#include "shared_textures.h"

namespace limpid {

/// render() in two steps, of three.
class RenderFrame {
 public:
  explicit RenderFrame(const Model& model) : model_(&model) {}

  void read(const PlateJob& job, Executor& executor);
  void run(const PlateJob&, Executor&) {}
  void write(const PlateJob& job);
  const CompositeReport& report() const { return report_; }

 private:
  const Model* model_;
  CompositeReport report_;  ///< sizes and times
  Scene scene_;
  RenderedPlate plate_;
};

/// water() in three steps, the first of which renders. Another frame may follow.
class WaterFrame {
 public:
  WaterFrame(const Model& model, SharedTextures& textures) : model_(&model), textures_(&textures) {}

  void read(const WaterJob& job, Executor& executor);
  void run(const WaterJob& job, Executor& executor);
  void write(const WaterJob& job);
  const CompositeReport& report() const { return report_; }

 private:
  const Model* model_;
  SharedTextures* textures_;
  CompositeReport report_;
  Scene scene_;
  RenderedPlate plate_;
  SharedTextures::Held wave_map_, environment_;
  std::optional<Canvas> canvas_;
};

}  // namespace limpid
