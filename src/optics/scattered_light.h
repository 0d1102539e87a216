#pragma once
#include <array>
#include <cmath>
#include <numbers>

#include "limpid/core/vec.h"

#include "optics/absorption.h"

/// @file
/// Multiple scattering in water, with reflection by its bottom and surface: the coefficients of the
/// solution of the equation of radiative transfer (Chandrasekhar 1960, "Radiative Transfer") in a
/// level layer of water, solved once per frame (complete/scattered_light.h).

namespace limpid {

/// Share of light scattered by Henyey and Greenstein's phase function that turns by less than 10
/// degrees, so little that it counts as not scattered: the peak of the function above its value at
/// 10 degrees (Potter 1970, "The Delta Function Approximation in Radiative Transfer Theory").
/// `anisotropy` -0.99 ... 0.99; 0 up to 0.
inline double narrow_share(double anisotropy) {
  constexpr double kCosine = 0.984807753012208;  // of 10 degrees
  const double g = anisotropy;
  if (!(g > 1e-3)) return 0;
  const double away = std::sqrt(1 + g * g - 2 * g * kCosine);
  const double inside = (1 - g) * (1 + g) / (2 * g) * (1 / (1 - g) - 1 / away);
  const double level = (1 - g) * (1 + g) / (2 * away * away * away) * (1 - kCosine);
  return inside > level ? inside - level : 0;
}

/// The water of a frame, on which multiple scattering depends besides the pixel.
struct ScatteringWater {
  Rgb<double> absorption{0, 0, 0}, scattering{0, 0, 0};  ///< 1/scene unit, >= 0
  double anisotropy = 0;                                 ///< -0.99 ... 0.99
  double beam = 1;  ///< cosine of the sun's beam with the vertical, in the water, 0 ... 1
  double ior = 1.333;
  bool surface = true;  ///< whether the surface reflects light from below
  bool inside = false;  ///< whether views may begin in the water

  bool operator==(const ScatteringWater&) const = default;
};

/// The bottom around a viewer in the water, as a level floor.
struct WaterFloor {
  double depth = 0;             ///< below the calm surface, scene units
  Rgb<double> albedo{0, 0, 0};  ///< 0 ... 1
  double share = 0;  ///< of the views down into the water that meet a bottom; 0: endless water

  bool operator==(const WaterFloor&) const = default;
};

/// Multiple scattering in one channel. Radiances are those in the water, over the radiance of a
/// white Lambert surface that faces the sun's beam in the water ("sun"), or over the radiance of an
/// even sky ("sky"). Polynomials in x = t / (t + 2), without a constant, t being the optical depth
/// straight down to the bottom: all diffuse light is 0 at t = 0. They are fitted to the layer's
/// solution at optical depths 1/64 ... 8192.
struct ScatteredLight {
  static constexpr int kDegree = 6;
  static constexpr double kMaxAlbedo = 0.9;  ///< of a bottom
  /// The shapes by which the radiance of the sun's light depends on directions: 1, the cosine of
  /// the view with the vertical, that of the scattering angle of the beam, and the phase function
  /// of double scattering at that angle.
  static constexpr int kShapes = 4;
  using Power = std::array<double, kDegree>;

  std::array<Power, kShapes> sun{};  ///< scattered more than once, over 1 - exp(-both paths)
  std::array<Power, 2> sky{};        ///< scattered once and more; by the first two shapes
  /// Radiance that a bottom of radiance 1 shows through the layer, beyond exp(-path).
  std::array<Power, 2> passing{};
  Power sun_below{};  ///< light on a black bottom, beyond the beam itself
  Power sky_below{};  ///< likewise, beyond the light that the surface transmits
  double sky_at_once = 1;
  /// Share of the bottom's light that returns to it, beyond the share that a surface right above it
  /// reflects.
  Power back{};
  double back_at_once = 0;

  /// For views that begin in the water (else 0), deep enough for the bottom not to matter: radiance
  /// added per unit of path at depth z under the surface, by sunlight scattered more than once, and
  /// by the sky's light scattered once or more. A sum of terms that fade as exp(-fades[i] z), each
  /// by inside_sun_shapes() or inside_sky_shapes().
  static constexpr std::size_t kFades = 4, kInside = 6;
  std::array<double, kFades> fades{};
  std::array<std::array<double, kInside>, kFades> inside_sun{}, inside_sky{};

  /// What a floor of the water changes of that, above the floor: terms that fade with the height
  /// over the floor (the first kRising) or with the depth, each by those shapes.
  static constexpr std::size_t kFloored = 4, kRising = 3;
  double floor = 0;  ///< its depth; 0 without
  std::array<double, kFloored> floor_fades{};
  std::array<std::array<double, kInside>, kFloored> floor_sun{}, floor_sky{};

  /// For bounds. Multiple scattering: the largest radiance over all views and depths, and the
  /// largest per optical depth, for shallow water. Light from the bottom: the largest, for albedo
  /// kMaxAlbedo.
  double most_sun = 0, most_sky = 0, slope_sun = 0, slope_sky = 0;
  double most_bottom_sun = 0, most_bottom_sky = 0;
  /// Largest difference from endless water, in layers of optical depth kFirstLayer, each twice as
  /// deep as the last, to 8192, and in all deeper layers.
  static constexpr int kLayers = 20;
  static constexpr double kFirstLayer = 1.0 / 64;
  std::array<double, kLayers> beyond_sun{}, beyond_sky{};
  /// Largest radiance there of a bottom of albedo kMaxAlbedo that light of irradiance pi falls on.
  std::array<double, kLayers> beyond_bottom{};
};

/// Of red, green and blue.
using ScatteredLights = std::array<ScatteredLight, 3>;

/// The x of the polynomials.
template <class F>
LIMPID_INLINE F layer_variable(F depth) {
  return depth / (depth + F(2));
}

/// x (p0 + x (p1 + ...)).
template <class F>
LIMPID_INLINE F layer_power(const ScatteredLight::Power& p, F x) {
  F sum = given<F>(p[ScatteredLight::kDegree - 1]);
  for (int i = ScatteredLight::kDegree - 2; i >= 0; --i) sum = given<F>(p[i]) + x * sum;
  return x * sum;
}

/// The sum of several polynomials, each times its shape.
template <std::size_t N, class F>
LIMPID_INLINE F layer_power(const std::array<ScatteredLight::Power, N>& p,
                            const std::array<F, N>& shapes, F x) {
  F sum(0);
  for (int i = ScatteredLight::kDegree - 1; i >= 0; --i) {
    F coefficient = given<F>(p[0][i]) * shapes[0];
    for (std::size_t k = 1; k < N; ++k) coefficient = coefficient + given<F>(p[k][i]) * shapes[k];
    sum = coefficient + x * sum;
  }
  return x * sum;
}

/// The shapes by which light scattered into a view in the water depends on directions: the view's
/// cosine with the downwards vertical and, for sunlight in water that scatters unevenly (`turns`),
/// the cosine of the beam's scattering angle, wider the more times it is scattered; `square` is
/// that of the anisotropy.
template <class F>
LIMPID_INLINE std::array<F, ScatteredLight::kInside> inside_sky_shapes(F sink) {
  const F square = sink * sink;
  return {F(1), sink, square, sink * square, square * square, F(0)};
}
template <class F>
LIMPID_INLINE std::array<F, ScatteredLight::kInside> inside_sun_shapes(F sink, F turned, F square,
                                                                       bool turns) {
  if (!turns) return {F(1), sink, sink * sink, F(0), F(0), F(0)};
  return {F(1),
          sink,
          sink * sink,
          turned,
          henyey_greenstein(turned, square),
          henyey_greenstein(turned, square * square)};
}

}  // namespace limpid
