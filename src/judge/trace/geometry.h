#pragma once
#include <array>

#include "judge/trace/eye.h"
#include "judge/trace/tracer.h"

namespace limpid::trace {

/// The source of the light at a pixel's centre: the values that are not means of samples.
struct Geometry {
  bool wet = false;  ///< meets the surface, or runs through water from the eye on
  double path = 0;   ///< +inf without an end
  double surface_depth = HUGE_VAL;
  glm::dvec3 normal{0};            ///< calm for views in the water that do not meet the surface
  std::array<glm::dvec2, 3> uv{};  ///< of each channel's end; (0, 0) at the upper left
  std::array<bool, 3> visible{}, visible_below{};
};

/// `x`, `y`: the place in the picture, in pixels.
Geometry geometry_at(const Tracer& tracer, const Eye& eye, const WaterView& water, double x,
                     double y, bool in_water);

}  // namespace limpid::trace
