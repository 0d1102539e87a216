#pragma once
#include <optional>

#include "limpid/files/text/scene_file.h"

namespace limpid {

/// When a frame is, in seconds: drifting waves are where they are at that time.
struct JobTime {
  std::optional<double> asked = {};  ///< counts before what scene and plate say
  double otherwise = 0;              ///< where none of them says a time
  double after_plate = 0;            ///< added to the plate's own time where that counts

  /// The time that is asked for, else the scene file's, else the plate's own, else `otherwise`.
  double of(const SceneFile& scene, std::optional<double> plate = {}) const {
    if (asked) return *asked;
    if (scene.time) return *scene.time;
    return plate ? *plate + after_plate : otherwise;
  }
};

}  // namespace limpid
