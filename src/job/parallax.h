#pragma once
#include <optional>

#include <glm/vec3.hpp>

#include "limpid/core/executor.h"

#include "core/water_view.h"
#include "job/motion.h"
#include "job/screen.h"

namespace limpid {

/// For the ray from a point below a calm surface to an eye, the horizontal distance from the eye to
/// the intersection with the surface, by the law of refraction. The point is `down` below the
/// surface, the eye `up` above it, and the horizontal distance between them is `across`. All
/// numbers are finite; up > 0, down >= 0, across >= 0, ior >= 1.
double refracted_reach(double up, double down, double across, double ior);

/// The surface of a frame's water as its camera sees it: Aov::kSurfaceDepth and Aov::kNormal, in
/// one window, which may be larger than the picture.
struct WaterSurface {
  View<const float> depth, normal_x, normal_y, normal_z;
};

/// Motion vectors of a static scene, by the camera and the water of a second frame: from
/// the place where the water of this frame shows a point to the place where the water of the second
/// frame shows the same point. In pixels, x to the right, y up.
///
/// Exact over calm water. With waves a point has an image where the ray of a place, refracted or
/// mirrored at that frame's own surface, passes through the point. A wavy surface shows some points
/// at several places: the vector leads to the place to which an iteration (Broyden 1965, "A Class
/// of Methods for Solving Nonlinear Simultaneous Equations") converges from the pixel plus the
/// vector of calm water. If it does not converge within kSteps steps, the vector is that of calm
/// water. The error of this frame's own lookup (of looks that do not refract by Snell's law) counts
/// for both frames, so that the vectors are 0 if water and camera do not move.
class Parallax {
 public:
  struct Waves {
    WaterSurface now, second;
  };
  static constexpr int kSteps = 12;

  /// Throws Error for an eye that is not above the water, in either frame: there the sentence
  /// names the frame. The views must live as long. Without `waves` both waters are calm.
  Parallax(const WaterView& now, const WaterView& second, double ior,
           const std::optional<Waves>& waves = {});

  /// Vectors of the bottom as seen through the water: of the point that the pixel looks up, at the
  /// depth of the dry picture (+inf for none), on dry pixels of the point that the pixel shows. 0
  /// where the second frame has the point behind its camera.
  void seen(const LookedUp& looked_up, View<const float> depth, View<float> to_x, View<float> to_y,
            Executor& executor) const;
  /// Vectors of the mirror image, by Aov::kReflectionDepth: also of the sky, infinitely far away,
  /// and of objects that the picture does not show. 0 on dry pixels.
  void reflected(const Mirrored& mirrored, View<float> to_x, View<float> to_y,
                 Executor& executor) const;

 private:
  // Points and directions are of `now`: relative to its eye.
  template <class Off>  // off(frame with its waves, place, from the eye of `now` to the frame's)
  std::optional<Place> with_waves(const std::optional<Place>& calm, const Place& here,
                                  const Off& off) const;
  std::optional<Place> of_point(const glm::dvec3& point, int x, int y, bool through_water) const;
  std::optional<Place> of_image(const Mirrored& mirrored, int x, int y) const;

  Screen now_, second_;
  std::optional<Waves> waves_;
  glm::dvec3 shift_;  ///< from the eye of `second` to that of `now`
  double ior_;
};

}  // namespace limpid
