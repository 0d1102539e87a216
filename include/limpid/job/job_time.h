#pragma once
#include <optional>

#include "limpid/files/text/scene_file.h"

namespace limpid {

/// The time of a frame, in seconds, at which waves have drifted.
struct JobTime {
  std::optional<double> explicit_time = {};  ///< takes precedence over the times of scene and plate
  double fallback = 0;                       ///< used if none of these has a time
  double plate_offset = 0;                   ///< added to the plate's time, if that is used

  /// `explicit_time`, else the time of the scene file, else that of the plate, else `fallback`.
  double of(const SceneFile& scene, std::optional<double> plate = {}) const {
    if (explicit_time) return *explicit_time;
    if (scene.time) return *scene.time;
    return plate ? *plate + plate_offset : fallback;
  }
};

}  // namespace limpid
