#pragma once
#include <array>
#include <cstddef>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "limpid/core/frame.h"
#include "limpid/core/vec.h"

#include "op/pass.h"

namespace limpid {

/// How wide the water is around places of its bottom, by what the depth plane shows: light that
/// rises from the bottom and is thrown back by the surface comes down farther away, on the bottom
/// or on a wall.
class Basin {
 public:
  /// Distances from a place, between which walls are told apart.
  static constexpr std::size_t kRings = 13;
  /// Of the directions in which one may go from a place, the share that comes to a wall in each.
  using Walls = std::array<float, kRings>;

  Basin(const Frame& frame, const Pass& pass) : c_(pass), depth_(frame.plane(PlaneId::kDepth)) {}

  /// Around what a pixel shows under the water. A wall is what rises out of the water steeper than
  /// 45 degrees; what the picture does not show is water.
  Walls around(int x, int y) const;

  /// Of light that leaves a level bottom evenly, the share that comes down from the surface, not
  /// scattered on its way, on these walls. `depth`: of the bottom, optical; `ior`: of the water.
  static double thrown_on(const Walls& walls, double depth, double ior);

 private:
  /// A place of the bottom.
  struct Place {
    glm::dvec3 at;  ///< relative to the eye
    glm::dvec2 uv;
    double z;  ///< eye depth
  };
  enum class Shown { kWater, kDry, kUnknown, kOutside };
  Shown at(const Place& place, const glm::dvec3& by, double near) const;

  const Pass& c_;
  const View<const float>& depth_;
};

}  // namespace limpid
