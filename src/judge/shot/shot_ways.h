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

/// One way to put water into a plate: a look, or one without an operator.
struct ShotWay {
  std::string name;
  CompositeJob job;
  Plan plan;
  Frame frame = {};
  HeldTextures textures = {};  ///< of the frame
  double seconds = 0;          ///< the best round
};

/// A plate that water is put into in many ways, one at a time, in one canvas.
class ShotWays {
 public:
  /// Opens the plate. Throws Error. The executor must outlive it.
  ShotWays(const CompositeJob& job, Executor& executor);

  const CompositeJob& job() const { return held_.job(); }
  const Plate& plate() const { return held_.plate(); }
  /// Of all planes that were read.
  const Frame& frame() const { return held_.frame(); }
  double transparent() const { return held_.transparent(); }
  const Scene& scene() const { return scene_; }
  Rect window() const { return held_.plate().display(); }

  /// Throws Error as plan_of().
  ShotWay planned(std::string name, const Look& look, std::vector<Aov> aovs = {},
                  const std::vector<std::string>& left_out = {}) const;
  /// Reads what all of them need. Frames of ways before these may be stale then.
  void read(std::vector<ShotWay>& ways);

  /// Valid until the next.
  const Target& run(const ShotWay& way, RunTimes* times = nullptr);
  /// Runs all in turn, round after round, after one that does not count.
  void time(std::vector<ShotWay>& ways, int rounds);

 private:
  Executor& executor_;
  HeldPlate held_;
  Scene scene_;
  SharedTextures textures_;
  std::optional<Canvas> canvas_;
};

}  // namespace limpid
