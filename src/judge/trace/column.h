#pragma once
#include <cmath>
#include <cstdint>

#include "limpid/core/vec.h"

namespace limpid {

/// Homogeneous water between two level planes, lit by the sun and an even sky: the standard for
/// closed forms, without a model. Angles are in degrees, lengths in scene units.
struct Column {
  Rgb<double> absorption{0, 0, 0}, scattering{0, 0, 0};  ///< 1/scene unit, >= 0
  double anisotropy = 0;                                 ///< of henyey_greenstein(), -0.99 ... 0.99
  double depth = HUGE_VAL;                               ///< >= 0; +inf: no light comes from below
  Rgb<double> bottom{0, 0, 0};                           ///< albedo of a Lambert bottom, 0 ... 1

  /// With a real surface light is refracted and partly reflected on its way in and out, light from
  /// below is reflected back down, and radiance is 1 / ior^2 of that in the water. Without it light
  /// enters straight and leaves without loss; only the view is refracted, and loses the reflected
  /// share.
  bool real_surface = true;
  double ior = 1.333;  ///< >= 1

  double view = 45, sun = 50;  ///< heights of eye and sun over the horizon, in the air, up to 90;
                               ///< the eye's is above 0, a sun at 0 or below counts as none
  double azimuth = 0;          ///< of the sun from the eye: at 0 the eye has the sun behind it
  Rgb<double> irradiance{1, 1, 1};  ///< of the sun in the air, on a surface that faces it
  Rgb<double> sky{0, 0, 0};         ///< radiance from everywhere above
};

/// Radiance that leaves the water towards the eye, without the reflection.
struct ColumnLight {
  Rgb<double> mean{0, 0, 0};
  Rgb<double> error{0, 0, 0};  ///< standard error of the mean
};

/// By random paths of any number of scatterings (at least 2 paths). The same bits for the same
/// seed. Light from deeper than 2000 mean free paths of scattering (reduced by the anisotropy)
/// counts as 0; it is less than 1/1000 even without absorption.
ColumnLight trace_column(const Column& column, std::uint64_t paths, std::uint64_t seed = 0);

}  // namespace limpid
