#pragma once
#include "core/water_view.h"
#include "judge/trace/beam.h"
#include "op/plain_texture.h"
#include "optics/surroundings.h"

namespace limpid::trace {

inline Rgb<double> environment_at(const Texture& environment, const WaterView& view,
                                  const glm::dvec3& direction) {
  return lat_long_rgb_at(environment,
                         lat_long(glm::dot(view.map_x, direction), glm::dot(view.map_y, direction),
                                  glm::dot(view.up, direction)));
}

/// The light of the sky on the water: the environment, or an even sky.
class Sky {
 public:
  Sky(const WaterView& view, const Texture& environment, const Rgb<double>& even)
      : view_(view), environment_(environment), even_(even) {}

  Rgb<double> from(const glm::dvec3& direction) const {
    return environment_ ? environment_at(environment_, view_, direction) : even_;
  }

 private:
  const WaterView& view_;
  Texture environment_;
  Rgb<double> even_;
};

}  // namespace limpid::trace
