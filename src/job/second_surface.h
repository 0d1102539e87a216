#pragma once
#include <optional>

#include "limpid/job/composite.h"
#include "limpid/plan/plan.h"
#include "limpid/plate/plate.h"

#include "job/canvas.h"
#include "job/parallax.h"
#include "job/shared_textures.h"

/// @file
/// The second frame of a composite's motion vectors: its camera, its water and its waves.

namespace limpid {

/// The decisions before a pixel is read.
struct PreparedSecond {
  Scene scene;
  DepthMeaning depth;
  Plan plan;                   ///< of the waves alone
  std::optional<Plate> plate;  ///< none if the scene file has camera and water
  /// The planes of the surface that this frame's plan reads and the second plate has.
  PlaneSet surface;
  /// Whether this frame's water has normals from its plate, and the second frame's has none.
  bool lacks_normals = false;

  /// As Plate::inputs_text(), of these planes.
  std::string inputs_text() const;
};

/// Of the job's second frame; `plate`, `scene` and `plan` are this frame's. Throws Error, which
/// names the second frame, if the plate is missing and the scene file is without camera or water,
/// for another display window, and as Parallax does.
PreparedSecond prepare_second(const CompositeJob& job, const Plate& plate, const Scene& scene,
                              const Plan& plan);

/// The surface of the second frame's water, also behind objects, and beyond the picture as far as
/// its waves may move an image. Reuses its memory for the next frame.
class SecondSurface {
 public:
  /// Reads the plate's planes.
  void read(PreparedSecond second);
  const Scene& scene() const { return second_.scene; }
  /// Whether there are waves, in this frame or in the second.
  bool has_waves(const Plan& plan) const;
  /// Runs the operator of the waves by the runner of the choice, or by the fused one instead of a
  /// GPU. `display` is that of the picture.
  WaterSurface paint(const HeldTextures& textures, const Rect& display, const OutputChoice& choice,
                     Executor& executor);

 private:
  PreparedSecond second_;
  LoadedPlate loaded_;
  Plane dry_, depth_;
  std::optional<Canvas> canvas_;
};

}  // namespace limpid
