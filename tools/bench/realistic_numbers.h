#pragma once
#include <array>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "limpid/core/frame.h"
#include "limpid/core/scene.h"
#include "limpid/ops/look.h"

namespace limpid::bench {

/// Numbers that a program for the look `realistic` alone computes once per frame, for rivals
/// written by hand. The camera is perspective and in the air.
struct RealisticNumbers {
  RealisticNumbers(const Look& look, const Frame& frame, const Scene& scene);

  Size size;
  glm::dvec3 ray, ray_dx, ray_dy;  ///< at the centre of the pixel (0, 0), and its steps
  /// Position in the map, in periods, of a point p relative to the eye: begin + (dot(p, u), dot(p,
  /// v)).
  std::array<glm::dvec2, 4> map_begin;
  glm::dvec3 map_u, map_v;
  /// The normal before normalization, from the sum of four colors: blend sum + blend_begin.
  glm::dmat3 blend;
  glm::dvec3 blend_begin;
  glm::dvec3 tilt_x, tilt_y;                            ///< tilt = (dot(n, tilt_x), dot(n, tilt_y))
  glm::dvec2 refract_shift, prism_shift, mirror_shift;  ///< pixels per unit tilt
  double fog_density, fog_offset, fog_alpha;
  glm::dvec3 fog_color;
  double shadow_strength, rim_power, sun_power;
  glm::dvec3 sun_direction, sun_color;
};

}  // namespace limpid::bench
