#pragma once
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include <glm/mat4x4.hpp>

#include "limpid/core/rect.h"
#include "limpid/core/scene.h"
#include "limpid/optics/depth.h"

namespace limpid {

/// A camera as a scene file gives it: complete but for the shape of the picture.
struct CameraSpec {
  enum class Lens {
    kProjection,    ///< `projection` as it stands
    kFovX,          ///< horizontal field of view
    kFovY,          ///< vertical field of view
    kOrthographic,  ///< width of the picture
  };

  glm::dmat4 view{1.0};
  Lens lens = Lens::kProjection;
  glm::dmat4 projection{1.0};
  double extent = 0;         ///< field of view in radians, width in scene units
  double near = 0, far = 0;  ///< not for kProjection
  ClipSpace clip = ClipSpace::kGl;
};

/// The camera for a picture of that size with pixels `pixel_aspect` times as wide as high. Throws
/// Error for what Camera::validate, perspective and orthographic refuse, and for a projection whose
/// device depth runs the other way than `clip` says.
Camera camera_for(const CameraSpec& spec, Size display, double pixel_aspect = 1);

/// What a scene file (TOML) says. The page docs/files.md lists its tables and keys, which
/// scene_keys.h has as data. Each table may be absent. Directions need not be unit.
struct SceneFile {
  Scene scene;                       ///< water and sun; its camera comes from camera_for()
  std::optional<CameraSpec> camera;  ///< when there is a view
  DepthKind depth = DepthKind::kEye;
  std::optional<double> near, far;            ///< as given; far may be +inf
  std::optional<double> depth_nothing, time;  ///< as given
  std::optional<Primaries> primaries;         ///< as given
  /// Role -> absolute "FILE" or "FILE:CHANNELS", for split_plate().
  std::map<std::string, std::string> plates;
  std::filesystem::path geometry;     ///< glTF file, absolute, or empty
  std::filesystem::path environment;  ///< picture file, absolute, or empty
  double environment_rotation = 0;    ///< rad
  std::filesystem::path file;         ///< that it was read from, absolute, or empty
};

/// The most waves of a scene: every output carries them as text, which must be small enough to be
/// read again.
inline constexpr std::size_t kMaxWaves = 1024;

/// Throws Error, with "file:line:column: " in front, for what is not TOML, an unknown table or key
/// (with the nearest known name), a value of the wrong type or length, more than kMaxWaves, NaN,
/// and infinity but for far.
SceneFile load_scene(const std::filesystem::path& path);

/// The same from a text, as the attribute `limpid/scene` of a rendered plate holds it; `name`
/// stands for the file in errors.
SceneFile scene_from_toml(const std::string& text, const std::string& name);

/// Camera, water, sun, time, and primaries other than Rec.709 as a text that scene_from_toml()
/// reads back to the bit. Throws Error for more than kMaxWaves.
std::string to_toml(const Scene& scene);

/// "FILE:CHANNELS" in its two parts: cut at the last ':' unless a '/' follows it; channels are ""
/// where there are none.
struct PlateName {
  std::string file, channels;
};
PlateName split_plate(std::string_view text);

/// The kind called eye, ray, inverse, normalised or device on the command line. Throws Error of
/// Fault::kUsage with the nearest name.
DepthKind depth_kind_named(std::string_view word);
std::string_view depth_kind_name(DepthKind kind);

}  // namespace limpid
