#pragma once
#include <filesystem>
#include <functional>
#include <string>

#include "limpid/core/camera.h"
#include "limpid/files/exr/exr_writer.h"

/// A plate of a pond with a shore on its left and sky above, computed from formulas: 64x36 pixels,
/// the camera 2 above the water y = 0, the bottom at y = -1, the shore at y = 0.2.

namespace limpid::test {

inline constexpr Rect kPicture{0, 0, 64, 36};
/// Columns left of this one are dry, except in the row at the horizon.
inline constexpr int kShore = 16;

/// The stored number for the eye depth Z of a pixel whose ray has the length `ray_length` at Z = 1.
using DepthCode = std::function<double(double z, double ray_length)>;

struct PlateOptions {
  Rect data = kPicture, display = kPicture;  ///< any windows give the same picture
  bool color = true, depth = true;           ///< whether the plate has these buffers
  DepthCode depth_code = [](double z, double) { return z; };
  bool broken = false;  ///< some NaN and inf: 2 in color, 1 in depth, 1 in shadow
  bool camera = false;  ///< with worldToCamera and worldToNDC
  double lamp = 0;      ///< radiance of two by two pixels of the sky, if not 0
};

Camera plate_camera(ClipSpace clip = ClipSpace::kGl);

/// R G B A, depth.Z, shadow.Y, reflection.R G B, and attributes "pond/studio" and "shot/take".
void write_plate(const std::filesystem::path& path, const PlateOptions& options = {});

/// A tiling normal map of gentle waves, R G B.
void write_waves(const std::filesystem::path& path);

/// The scene file of the plate; `more` holds further lines of its [camera].
std::string scene_toml(const std::string& more = "near = 0.1\nfar = 100.0\n");

/// A look in which every operator changes pixels; the wave map is waves.exr.
std::string look_toml();

}  // namespace limpid::test
