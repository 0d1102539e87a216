#pragma once
#include <numbers>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "limpid/core/camera.h"
#include "limpid/core/color_space.h"
#include "limpid/core/vec.h"

namespace limpid {

/// A sine wave on the water: height amplitude sin(k_x x + k_y y + phase - omega t), with x and y
/// along PlaneAxes and t the scene's time.
struct SineWave {
  double amplitude = 0;     ///< scene units
  double k_x = 0, k_y = 0;  ///< rad / scene unit; the wave travels along (k_x, k_y)
  double phase = 0;         ///< rad
  double omega = 0;         ///< rad / s

  /// How files write a wave: a row of these numbers. Without omega it is that of deep water,
  /// sqrt(9.81 m/s^2 |k|).
  static constexpr std::string_view kColumns[] = {"amplitude", "k_x", "k_y", "phase", "omega"};
  static constexpr std::size_t kLeastColumns = 4;
  static SineWave from_row(std::span<const double> row);
  std::vector<double> to_row() const { return {amplitude, k_x, k_y, phase, omega}; }
};

/// The calm surface: the points p with dot(up, p) = height. `up` is unit. `waves` raise and lower
/// it where it is rendered as geometry, and for the chain where the waves are `sines`
/// (ops/wave_normals.h).
struct WaterPlane {
  glm::dvec3 up{0, 1, 0};
  double height = 0;
  std::vector<SineWave> waves = {};
};

/// Axes of the water plane that stay with the world: world x (z, should x be parallel to up)
/// projected on the plane, and cross(up, x). Unit.
struct PlaneAxes {
  glm::dvec3 x, y;
};
PlaneAxes plane_axes(const glm::dvec3& up);

/// `direction` is unit and points towards the sun; `color` scales its radiance: 0 ... kBrightest.
struct Sun {
  /// Times the largest strength and the narrowest lobe of a highlight it is 1e-18 of the largest
  /// float, so that no sum or product of the chain becomes infinite.
  static constexpr double kBrightest = 1e9;

  glm::dvec3 direction{0, 1, 0};
  Rgb<double> color{1, 1, 1};
  static constexpr double kNarrowest = 0.01, kWidest = 90;
  double diameter = 0.533;  ///< of its disc, in degrees: kNarrowest ... kWidest

  double radius() const { return diameter * (std::numbers::pi / 360); }  ///< rad
};

/// An even sky: what the water is lit by besides the sun.
struct SkyLight {
  Rgb<double> radiance{0, 0, 0};  ///< 0 ... Sun::kBrightest
};

/// The part of each pixel that is seen: of `count` strips side by side, in the direction in which
/// the calm water recedes on screen (down, where it does not), the one `index`. The water is met in
/// the middle of the strip, and waves are filtered over it; planes of a frame remain those of whole
/// pixels, depths at their heights (complete/part_depths.h). The mean of all strips resolves waves.
struct PixelPart {
  int index = 0, count = 1;  ///< 0 <= index < count
};

/// What stands around a frame: where it was seen from, where the water is, where the light comes
/// from.
struct Scene {
  std::optional<Camera> camera;
  std::optional<WaterPlane> water;
  std::optional<Sun> sun;
  std::optional<SkyLight> sky;  ///< of a frame whose surroundings nobody has a picture of
  /// What red, green and blue are: of the frame's pictures, of sun and sky, and of a look's colors.
  /// Waters that a look names are fitted to them (optics/fitted_water.h).
  Primaries primaries = kRec709;
  double time = 0;  ///< seconds
  PixelPart part;   ///< all of the pixel

  /// Whether its water has waves of its own.
  bool has_waves() const { return water && !water->waves.empty(); }

  /// Throws Error for a bad camera, a water or sun direction that is not unit, a color or
  /// diameter of the sun, a radiance of the sky or a part of a pixel out of its range, primaries
  /// that are none, and numbers that are not finite.
  void validate() const;
};

}  // namespace limpid
