#pragma once
#include <optional>
#include <string>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/job/composite.h"

#include "job/canvas.h"
#include "job/held_plate.h"
#include "job/shared_textures.h"

namespace limpid {

/// One variant of a composited plate: a look, or a look without one operator.
struct ShotVariant {
  std::string name;
  CompositeJob job;
  Plan plan;
  Frame frame = {};
  HeldTextures textures = {};  ///< of the frame
  double seconds = 0;          ///< the best round
};

/// A plate that is composited in many variants, one at a time, on one canvas.
class ShotVariants {
 public:
  /// Opens the plate. Throws Error. The executor must outlive it.
  ShotVariants(const CompositeJob& job, Executor& executor);

  const CompositeJob& job() const { return held_.job(); }
  const Plate& plate() const { return held_.plate(); }
  /// The frame with all planes read so far.
  const Frame& frame() const { return held_.frame(); }
  double transparent() const { return held_.transparent(); }
  const Scene& scene() const { return scene_; }
  Rect window() const { return held_.plate().display(); }

  /// Throws Error as plan_of().
  ShotVariant planned(std::string name, const Look& look, std::vector<Aov> aovs = {},
                      const std::vector<std::string>& left_out = {}) const;
  /// Reads the planes that these variants need. Frames of earlier variants may then be invalid.
  void read(std::vector<ShotVariant>& variants);

  /// Valid until the next call.
  const Target& run(const ShotVariant& variant, RunTimes* times = nullptr);
  /// Runs all in turn, round after round, after one round of warm-up.
  void time(std::vector<ShotVariant>& variants, int rounds);

 private:
  Executor& executor_;
  HeldPlate held_;
  Scene scene_;
  SharedTextures textures_;
  std::optional<Canvas> canvas_;
};

}  // namespace limpid
