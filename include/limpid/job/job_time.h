#pragma once
#include <optional>

#include "limpid/files/text/scene_file.h"

namespace limpid {

/// The time of a frame, in seconds, at which waves have drifted.
struct JobTime {
  std::optional<double> asked = {};  ///< takes precedence over the times of scene and plate
  double otherwise = 0;              ///< if none of them has a time
  double after_plate = 0;            ///< added to the plate's time, if that is used

  /// `asked`, else the time of the scene file, else that of the plate, else `otherwise`.
  double of(const SceneFile& scene, std::optional<double> plate = {}) const {
    if (asked) return *asked;
    if (scene.time) return *scene.time;
    return plate ? *plate + after_plate : otherwise;
  }
};

}  // namespace limpid
