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

/// Sunlight on the bottom that the waves focus: photons from the sun through the surface as it is.
/// How many lie round a point, beside those that the calm plane would send there, is its light. The
/// disc that they are counted in would hold kCounted of the calm ones: light is blurred over it,
/// and within its radius of an edge there is less. Jensen 1996, "Global Illumination using Photon
/// Maps".
class Caustics {
 public:
  static constexpr double kCounted = 100;

  /// What they are made from; all must outlive them.
  struct Scenery {
    const WaterView& view;
    const Solid& solid;
    const Surface& surface;
    const Medium& medium;
    const SunPath& sun_path;
    glm::dvec3 to_sun;  ///< in the air
  };

  /// So many photons, on the water over that part of the bottom that the eye sees.
  Caustics(const Scenery& scenery, const Eye& eye, Size size, int photons, std::uint64_t seed,
           Executor& executor);

  /// The sunlight that arrives at a point of the bottom over that of the calm plane without
  /// shadows. Nothing where no photons were sent, and where the calm sun only grazes the surface.
  std::optional<double> at(const SolidPoint& point) const;

 private:
  struct Photon {
    glm::vec3 place{0}, face{0};
    float weight = 0;  ///< of the light of a calm one; 0: it went nowhere
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
  double rise_in_air_, rise_;    ///< of the sun, in the air and in the water
  glm::dvec2 low_{0}, high_{0};  ///< on the plane, where light enters to points that count
  glm::dvec2 low_sent_{0}, high_sent_{0};  ///< where photons are sent
  double radius_ = 0, expected_ = 0;       ///< calm photons in a level disc
  std::vector<Photon> photons_;            ///< by cell
};

}  // namespace limpid::trace
