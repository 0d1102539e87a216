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

/// Light by random ways through the water, of any number of scatterings, bounces off dry surfaces
/// and mirrorings at the surface: from the viewer back to the sun, which each scattering and each
/// bounce looks for, and to the sky, which ways that leave the water end in.
///
/// The dry picture's own light is given: the sun on a dry surface, and the ambient light of its
/// material. So the given light that one dry surface throws straight at another, and what the sky
/// sends straight to the bottom, count as part of that ambient light; the ways add what the water
/// sends, straight and by dry surfaces.
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

  /// Radiance, in the water, that a dry surface there sends back along the beam.
  Rgb<double> bottom(const SolidPoint& point, const Beam& beam, const Band& band,
                     Samples& samples) const;

  /// The same in the air, as the raster pass has it.
  Rgb<double> dry(const SolidPoint& point, const Beam& beam) const;

 private:
  /// A way under way.
  struct Way {
    Chances chances;
    Ray ray{};
    double scale = 1;  ///< of radiance, for where the way is
    bool in_air = false;
    bool from_dry =
        false;  ///< straight on from dry surfaces: what light is given there is their ambient
    Rgb<double> light{0, 0, 0};
  };
  using Going = bool;  ///< whether the way goes on

  void go(Way& way, const Band& band, Samples& samples) const;
  Going through_water(Way& way, const Band& band, Samples& samples) const;
  Going through_air(Way& way, const Band& band, Samples& samples) const;
  Going scatter(Way& way, const glm::dvec3& at, const Band& band, Samples& samples) const;
  Going bounce(Way& way, const SolidPoint& point, Samples& samples) const;
  Going meet_surface(Way& way, const SurfacePoint& at, const Band& band, Samples& samples) const;
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
