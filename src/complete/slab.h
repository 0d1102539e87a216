#pragma once
#include <array>
#include <cstddef>

#include "optics/scattered_light.h"

namespace limpid {

/// Directions of a level layer, as cosines with the vertical, and their weights: Gauss's,
/// separately for directions that a calm surface reflects totally and directions that it transmits.
struct SlabDirections {
  static constexpr int kInside = 4;  ///< number of each kind
  static constexpr int kCount = 2 * kInside;
  using Radiance = std::array<double, kCount>;

  explicit SlabDirections(double ior);
  Radiance cosine, weight;

  /// Irradiance over pi by light from all directions.
  double flux(const Radiance& radiance) const;
};

/// Water of a layer: of the light that it removes from a beam it scatters `albedo`, by a phase
/// function with these moments, the first of them 1.
struct SlabWater {
  static constexpr int kMoments = 2 * SlabDirections::kCount;
  double albedo;
  std::array<double, kMoments> moments;
};

/// A layer of an optical depth, and its outgoing light; all per azimuth mode.
struct SlabLight {
  static constexpr std::size_t kLayers = ScatteredLight::kLayers;
  static constexpr double kFirst = ScatteredLight::kFirstLayer;

  using Radiance = SlabDirections::Radiance;
  double depth;      ///< optical
  Radiance sun;      ///< up at the top, over a black bottom, from a beam; without its first order
  double sun_below;  ///< on a black bottom, over pi, without the beam's own
  // Mode 0 only; 0 in other modes.
  Radiance sky{};        ///< up at the top, from an even sky, all of it
  Radiance passing{};    ///< up at the top, from a bottom of radiance 1
  double sky_below = 0;  ///< on a black bottom, over pi
  double back = 0;       ///< share of the bottom's light that returns to it
};

using SlabLayers = std::array<SlabLight, SlabLight::kLayers>;

/// Light in endless water at a depth, around a direction's cosine; per azimuth mode.
struct InsideLight {
  using Radiance = SlabDirections::Radiance;
  double depth;               ///< optical
  Radiance sun_up, sun_down;  ///< from a beam, without the beam itself
  Radiance sky_up, sky_down;  ///< from an even sky, all of it; mode 0 only, 0 in others
};

/// All layers by doubling: the response of two layers follows from the responses of each (van de
/// Hulst 1963, "A New Look at Multiple Scattering"; Hansen & Travis 1974, "Light Scattering in
/// Planetary Atmospheres"). `reflects`: reflectance of the surface from below, by direction, 0
/// without a surface; it transmits the rest. The beam, of irradiance pi on a surface that faces it,
/// comes down along `beam`, a cosine of 0.02 ... 1, in the water. `mode`: that of cos(mode
/// azimuth); sky and bottom are even and only in mode 0.
SlabLayers solve_slab(const SlabDirections& directions, const SlabWater& water,
                      const SlabDirections::Radiance& reflects, double beam, int mode);

/// The same at the depths of these layers, in endless water.
using InsideLights = std::array<InsideLight, SlabLight::kLayers>;
InsideLights solve_inside(const SlabDirections& directions, const SlabWater& water,
                          const SlabDirections::Radiance& reflects, double beam, int mode);

/// A level floor under the water, at an optical depth. A `share` of it reflects the light as a
/// Lambert surface of this albedo does; the rest is the water's own light, as of endless water.
struct SlabFloor {
  double depth, albedo, share;
};

/// Light between the surface and a floor. Depths crowd near both.
struct FlooredLights {
  static constexpr std::size_t kHalvings = 10, kCount = 2 * kHalvings - 1;
  std::array<InsideLight, kCount> lights;
};
FlooredLights solve_over_floor(const SlabDirections& directions, const SlabWater& water,
                               const SlabDirections::Radiance& reflects, double beam,
                               const SlabFloor& floor, int mode);

/// In-scatter per unit of optical path along a cosine with the upwards vertical, -1 ... 1: of light
/// that travels up and down, by direction.
struct SlabSource {
  SlabSource(const SlabDirections& directions, const SlabWater& water, int mode, double cosine);
  double of(const SlabDirections::Radiance& up, const SlabDirections::Radiance& down) const;

 private:
  SlabDirections::Radiance up_, down_;
};

}  // namespace limpid
