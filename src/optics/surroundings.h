#pragma once
#include <numbers>

#include "limpid/core/vec.h"

/// @file
/// The direction in which a mirror sees the surroundings, and its place in a map of all directions.

namespace limpid {

/// The place of a direction in a lat-long map, from its components along two level axes and up: x
/// in turns, 0.5 along the first axis and growing towards the second, y 0 straight up ... 1
/// straight down. The vector may have any length but 0; straight up and down x is 0.5.
template <class F>
LIMPID_INLINE Vec2<F> lat_long(F along_x, F along_y, F along_up) {
  const F level = sqrt(along_x * along_x + along_y * along_y);
  return {F(0.5) + F(0.5 / std::numbers::pi) * atan2(along_y, along_x),
          F(1 / std::numbers::pi) * atan2(level, along_up)};
}

/// The unit direction, made level where it goes below the horizon; `up`, unit, where it goes
/// straight down.
template <class F>
LIMPID_INLINE Vec3<F> lifted(Vec3<F> direction, Vec3<F> up) {
  const F sunk = max(F(0) - dot(up, direction), F(0));
  return normalize_or(direction + sunk * up, up);
}

}  // namespace limpid
