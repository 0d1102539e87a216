#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "limpid/core/executor.h"

#include "core/water_view.h"
#include "judge/trace/eye.h"
#include "judge/trace/medium.h"
#include "judge/trace/solid.h"
#include "judge/trace/sun_path.h"
#include "judge/trace/surface.h"

namespace limpid::trace {

/// Caustics on the bottom: photons from the sun through the real surface. Their density around a
/// point, over that of photons through the calm plane, is its light. The gathering disc would hold
/// kCounted photons under calm water: light is blurred over it, and dimmed within its radius of an
/// edge. Jensen 1996, "Global Illumination using Photon Maps".
class Caustics {
 public:
  static constexpr double kCounted = 100;

  /// The inputs; all must outlive the object.
  struct Scenery {
    const WaterView& view;
    const Solid& solid;
    const Surface& surface;
    const Medium& medium;
    const SunPath& sun_path;
    glm::dvec3 to_sun;  ///< in the air
  };

  /// Sends photons to the water over the part of the bottom that the eye sees.
  Caustics(const Scenery& scenery, const Eye& eye, Size size, int photons, std::uint64_t seed,
           Executor& executor);

  /// Sunlight at a point of the bottom over that of the calm plane without shadows. Nothing without
  /// photons, and where the calm sun only grazes the surface.
  std::optional<double> at(const SolidPoint& point) const;

 private:
  struct Photon {
    glm::vec3 place{0}, face{0};
    float weight = 0;  ///< light, over that of a calm photon; 0: it was lost
    std::uint64_t cell = 0;
  };

  void choose_region(const Eye& eye, Size size);
  Photon sent(std::uint64_t number) const;
  std::optional<Triangles::Hit> bottom_seen(const Ray& view) const;
  glm::dvec2 entry_of(const glm::dvec3& point) const;
  std::uint64_t cell_of(const glm::dvec3& place, int dx, int dy, int dz) const;

  const Scenery scenery_;
  const Band& band_;
  std::uint64_t seed_;
  double rise_in_air_, rise_;              ///< of the sun, in the air and in the water
  glm::dvec2 low_{0}, high_{0};            ///< on the plane, bounds of the entry points that count
  glm::dvec2 low_sent_{0}, high_sent_{0};  ///< bounds of the photons' start
  double radius_ = 0, expected_ = 0;       ///< expected_: calm photons in a level disc
  std::vector<Photon> photons_;            ///< by cell
};

}  // namespace limpid::trace
