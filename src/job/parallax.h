#pragma once
#include <optional>

#include <glm/vec3.hpp>

#include "core/water_view.h"
#include "job/motion.h"
#include "job/screen.h"

namespace limpid {

/// Where a camera sees a point below a calm surface: the point is `down` below the surface, the eye
/// `up` above the surface, and `across` lies between them horizontally. The horizontal distance
/// from the eye to the place where the ray meets the surface, by the law of refraction. All
/// numbers are finite; up > 0, down >= 0, across >= 0, ior >= 1.
double refracted_reach(double up, double down, double across, double ior);

/// Motion vectors of a scene that stands still, by the camera and the water plane of a second
/// frame: from the place where the calm water of this frame shows a point to the place where the
/// calm water of the second frame shows the same point. In pixels, x to the right, y up. Exact over
/// calm water; the change of the waves' normals between the frames is not in them.
class Parallax {
 public:
  /// Throws Error for an eye that is not above the water, in either frame: there the sentence
  /// names the frame. The views must live as long.
  Parallax(const WaterView& now, const WaterView& second, double ior);

  /// Of what is seen through the water: the point that the pixel looks up, at the depth of the dry
  /// picture (+inf for none), on dry pixels the point that the pixel shows. 0 where the second
  /// frame has the point behind its camera.
  void seen(const LookedUp& looked_up, View<const float> depth, View<float> to_x,
            View<float> to_y) const;
  /// Of what the surface mirrors, by Aov::kReflectionDepth: also the sky, infinitely far away, and
  /// what the picture does not show. 0 on dry pixels.
  void reflected(const Mirrored& mirrored, View<float> to_x, View<float> to_y) const;

 private:
  // Points and directions are of `now`: relative to its eye.
  std::optional<Place> motion(const std::optional<Place>& from,
                              const std::optional<Place>& to) const;
  std::optional<Place> of_point(const glm::dvec3& point, bool through_water) const;
  std::optional<Place> of_image(const Mirrored& mirrored, int x, int y) const;

  Screen now_, second_;
  glm::dvec3 shift_;  ///< from the eye of `second` to that of `now`
  double ior_;
};

}  // namespace limpid
