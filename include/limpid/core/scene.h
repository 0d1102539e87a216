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

  /// The numbers of a wave in files. If omega is left out, it is that of deep water, sqrt(9.81
  /// m/s^2 |k|).
  static constexpr std::string_view kColumns[] = {"amplitude", "k_x", "k_y", "phase", "omega"};
  static constexpr std::size_t kLeastColumns = 4;
  static SineWave from_row(std::span<const double> row);
  std::vector<double> to_row() const { return {amplitude, k_x, k_y, phase, omega}; }
};

/// The calm surface: the points p with dot(up, p) = height. `up` is unit. `waves` displace the
/// surface where it is rendered as geometry, and in the chain if the model of wave_normals is
/// `sines` (ops/wave_normals.h).
struct WaterPlane {
  glm::dvec3 up{0, 1, 0};
  double height = 0;
  std::vector<SineWave> waves = {};
};

/// World-fixed unit axes of the water plane: world x (z, if x is parallel to up) projected on the
/// plane, and cross(up, x).
struct PlaneAxes {
  glm::dvec3 x, y;
};
PlaneAxes plane_axes(const glm::dvec3& up);

/// `direction` is unit and points towards the sun; `color` scales its radiance: 0 ... kBrightest.
struct Sun {
  /// The product with the largest strength and the narrowest lobe of a highlight is 1e-18 of the
  /// largest float, so no sum or product of the chain becomes infinite.
  static constexpr double kBrightest = 1e9;

  glm::dvec3 direction{0, 1, 0};
  Rgb<double> color{1, 1, 1};
  static constexpr double kNarrowest = 0.01, kWidest = 90;
  double diameter = 0.533;  ///< of the sun's disc, in degrees: kNarrowest ... kWidest

  double radius() const { return diameter * (std::numbers::pi / 360); }  ///< of the disc, in rad
};

/// A uniform sky, which lights the water besides the sun; the water mirrors it in frames without a
/// reflection, an environment and a visible sky.
struct SkyLight {
  Rgb<double> radiance{0, 0, 0};  ///< 0 ... Sun::kBrightest
};

/// A strip of each pixel, for supersampling the waves: a pixel has `count` strips side by side, in
/// the direction in which the calm water recedes on screen (down, if it does not recede), and this
/// is the one with `index`. The view ray goes through the middle of the strip, and waves are
/// filtered over the strip. Planes of a frame keep their values per pixel; depths keep the heights
/// of their points (complete/part_depths.h). The mean of all strips is the picture.
struct PixelPart {
  int index = 0, count = 1;  ///< 0 <= index < count
};

/// The scene of a frame: its camera, its water, its light.
struct Scene {
  std::optional<Camera> camera;
  std::optional<WaterPlane> water;
  std::optional<Sun> sun;
  std::optional<SkyLight> sky;  ///< for frames without an environment
  /// The color space of the frame's pictures, of sun and sky, and of the look's colors. Named water
  /// types are fitted to it (optics/fitted_water.h).
  Primaries primaries = kRec709;
  double time = 0;  ///< seconds
  PixelPart part;   ///< the whole pixel by default

  /// Whether the water plane has waves.
  bool has_waves() const { return water && !water->waves.empty(); }

  /// Throws Error for an invalid camera, an up vector of the water or sun direction that is not
  /// unit, a color or diameter of the sun, a radiance of the sky or a part of a pixel out of its
  /// range, invalid primaries (Primaries::validate()), and numbers that are not finite.
  void validate() const;
};

}  // namespace limpid
