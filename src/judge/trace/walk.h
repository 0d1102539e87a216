#pragma once
#include "judge/trace/caustics.h"
#include "judge/trace/chances.h"
#include "judge/trace/medium.h"
#include "judge/trace/samples.h"
#include "judge/trace/sky.h"
#include "judge/trace/solid.h"
#include "judge/trace/sun_path.h"
#include "judge/trace/surface.h"

namespace limpid::trace {

/// Light by random paths through the water, with any number of scatterings, reflections by dry
/// surfaces and by the surface: from the viewer back to the sun, to which each scattering and each
/// reflection connects, and to the sky, where paths end that leave the water.
///
/// The dry picture's own light is given: the sun on a dry surface, and the ambient light of its
/// material. So the given light that one dry surface reflects straight to another, and the sky's
/// light straight to the bottom, count as part of that ambient light; the paths add the light that
/// the water sends, directly and by dry surfaces.
class Walk {
 public:
  /// All must outlive it. `sun`: of dry surfaces in the air. Without caustics sunlight comes
  /// through the calm plane.
  Walk(const Solid& solid, const Surface& surface, const Medium& medium, const SunPath& sun_path,
       const Sunlight& sun, const Sky& sky, const Caustics* caustics)
      : solid_(solid),
        surface_(surface),
        medium_(medium),
        sun_path_(sun_path),
        sun_(sun),
        sky_(sky),
        caustics_(caustics) {}

  /// Radiance, in the water, that is scattered into the ray within that length.
  Rgb<double> scattered(const Ray& ray, double length, const Band& band, Samples& samples) const;

  /// Radiance, in the water, that a dry surface there reflects back along the beam.
  Rgb<double> bottom(const SolidPoint& point, const Beam& beam, const Band& band,
                     Samples& samples) const;

  /// The same in the air, as in the raster pass.
  Rgb<double> dry(const SolidPoint& point, const Beam& beam) const;

 private:
  /// The state of a random path.
  struct RandomPath {
    Chances chances;
    Ray ray{};
    double scale = 1;  ///< factor of radiance in the path's medium
    bool in_air = false;
    bool from_dry = false;  ///< directly from a dry surface: given light there is the ambient light
    Rgb<double> light{0, 0, 0};
  };
  using Going = bool;  ///< whether the path continues

  void go(RandomPath& path, const Band& band, Samples& samples) const;
  Going through_water(RandomPath& path, const Band& band, Samples& samples) const;
  Going through_air(RandomPath& path, const Band& band, Samples& samples) const;
  Going scatter(RandomPath& path, const glm::dvec3& at, const Band& band, Samples& samples) const;
  Going bounce(RandomPath& path, const SolidPoint& point, Samples& samples) const;
  Going meet_surface(RandomPath& path, const SurfacePoint& at, const Band& band,
                     Samples& samples) const;
  std::optional<SolidPoint> nearest(const Ray& ray) const;
  Rgb<double> own_light(const SolidPoint& point, const Beam& beam, const Band& band,
                        Samples& samples) const;
  double sunlit(const SolidPoint& point, const Band& band) const;
  Rgb<double> skylight_at(const glm::dvec3& point, const Band& band, Samples& samples) const;
  bool lost_below(const glm::dvec3& point) const;

  const Solid& solid_;
  const Surface& surface_;
  const Medium& medium_;
  const SunPath& sun_path_;
  const Sunlight& sun_;
  const Sky& sky_;
  const Caustics* caustics_;
};

}  // namespace limpid::trace
