#pragma once
#include <optional>

#include <glm/vec3.hpp>

#include "limpid/core/camera.h"
#include "limpid/core/vec.h"

namespace limpid {

/// The calm surface: the points p with dot(up, p) = height. `up` is unit.
struct WaterPlane {
  glm::dvec3 up{0, 1, 0};
  double height = 0;
};

/// `direction` is unit and points towards the sun; `color` scales its radiance.
struct Sun {
  glm::dvec3 direction{0, 1, 0};
  Rgb<double> color{1, 1, 1};
};

/// What stands around a frame: where it was seen from, where the water is, where the light comes
/// from.
struct Scene {
  std::optional<Camera> camera;
  std::optional<WaterPlane> water;
  std::optional<Sun> sun;
  double time = 0;  ///< seconds

  /// Throws Error for a bad camera, or a water or sun direction that is zero or not finite.
  void validate() const;
};

}  // namespace limpid
