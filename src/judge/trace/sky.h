#pragma once
#include "limpid/op/context.h"
#include "limpid/optics/surroundings.h"

#include "judge/trace/beam.h"
#include "op/plain_texture.h"

namespace limpid::trace {

inline Rgb<double> environment_at(const Texture& environment, const Context& context,
                                  const glm::dvec3& direction) {
  return lat_long_rgb_at(
      environment, lat_long(glm::dot(context.map_x, direction), glm::dot(context.map_y, direction),
                            glm::dot(context.up, direction)));
}

/// The light of the sky on the water: the environment, or alike from everywhere.
class Sky {
 public:
  Sky(const Context& context, const Texture& environment, const Rgb<double>& even)
      : context_(context), environment_(environment), even_(even) {}

  Rgb<double> from(const glm::dvec3& direction) const {
    return environment_ ? environment_at(environment_, context_, direction) : even_;
  }

 private:
  const Context& context_;
  Texture environment_;
  Rgb<double> even_;
};

}  // namespace limpid::trace
