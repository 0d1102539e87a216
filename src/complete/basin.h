#pragma once
#include <array>
#include <cstddef>
#include <functional>
#include <optional>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "limpid/core/frame.h"
#include "limpid/core/vec.h"

#include "op/pass.h"

namespace limpid {

/// Width of the water around places of its bottom, from the depth plane: light that rises from the
/// bottom and that the surface reflects comes down farther away, on the bottom or on a wall.
class Basin {
 public:
  /// Distances from a place at which walls are searched.
  static constexpr std::size_t kRings = 13;
  /// Share of the directions from a place that lead to a wall in each ring.
  using Walls = std::array<float, kRings>;
  /// The bottom in each ring: in how many directions the picture shows it, and the sum of its lit
  /// fractions there.
  struct Floor {
    std::array<float, kRings> seen{}, sunlit{};
  };
  /// Share of the light leaving a level bottom evenly that the surface reflects and that comes down
  /// between the middle of a ring and that of the next.
  using Reflected = std::array<double, kRings>;

  Basin(const Frame& frame, const Pass& pass);

  /// The walls around the point under water that a pixel shows. A wall rises out of the water
  /// steeper than 45 degrees; outside the picture there is water.
  Walls walls_around(int x, int y) const;
  /// The lit fraction of a pixel of the dry picture, if it is known.
  using Lit = std::function<std::optional<float>(int x, int y)>;
  /// The bottom around that point, where its light is known.
  Floor floor_around(int x, int y, const Lit& lit) const;

  /// Without scattering. `depth`: optical depth of the bottom; `ior`: index of the water.
  static Reflected reflected(double depth, double ior);
  /// Share of the diffuse light of a level bottom that the surface reflects onto these walls.
  static double share_on(const Walls& walls, const Reflected& light);
  /// Lit fraction of the bottom around: the mean, weighted by the light that the surface reflects
  /// from each place to the point (from two depths away and more). 1 if no bottom is seen.
  static double share_sunlit(const Floor& floor, const Reflected& light);

 private:
  /// A place of the bottom.
  struct Place {
    glm::dvec3 at;  ///< relative to the eye
    glm::dvec2 uv;
    double z;  ///< eye depth
  };
  enum class Shown { kWater, kDry, kUnknown, kOutside };
  /// The surface that the picture shows in the direction of a point.
  struct Sight {
    int x, y;        ///< pixel
    double z;        ///< eye depth of the point
    double seen;     ///< of the surface
    glm::dvec3 off;  ///< of the surface, from the point
  };
  std::optional<Place> place_of(int x, int y) const;
  std::optional<Sight> look(const Place& place, const glm::dvec3& by) const;
  Shown at(const Place& place, const glm::dvec3& by, double near) const;

  static constexpr std::size_t kDirections = 8;

  const Pass& c_;
  const View<const float>& depth_;
  std::array<glm::dvec3, kDirections> directions_;  ///< level, unit
};

}  // namespace limpid
