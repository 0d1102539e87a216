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

/// The camera of a scene file, complete except for the aspect of the picture.
struct CameraSpec {
  enum class Lens {
    kProjection,    ///< `projection`, unchanged
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

/// The camera for a picture of size `display` with pixels `pixel_aspect` times as wide as high.
/// Throws Error as Camera::validate(), perspective() and orthographic() do, and for a projection
/// whose device depth runs against `clip`.
Camera camera_for(const CameraSpec& spec, Size display, double pixel_aspect = 1);

/// The contents of a scene file (TOML). The page docs/files.md lists its tables and keys, which
/// scene_keys.h has as data. Each table may be absent. Directions in the file need not be unit.
struct SceneFile {
  Scene scene;                       ///< water and sun; its camera comes from camera_for()
  std::optional<CameraSpec> camera;  ///< if the file has a `view`
  DepthKind depth = DepthKind::kEye;
  std::optional<double> near, far;            ///< if the file has them; far may be +inf
  std::optional<double> depth_nothing, time;  ///< if the file has them
  std::optional<Primaries> primaries;         ///< if the file has them
  /// Role -> absolute "FILE" or "FILE:CHANNELS", for split_plate().
  std::map<std::string, std::string> plates;
  std::filesystem::path geometry;     ///< glTF file, absolute, or empty
  std::filesystem::path environment;  ///< picture file, absolute, or empty
  double environment_rotation = 0;    ///< rad
  std::filesystem::path file;         ///< the scene file, absolute, or empty
};

/// The largest number of waves of a scene: every output records them as text, which must be small
/// enough to be read again.
inline constexpr std::size_t kMaxWaves = 1024;

/// Throws Error, with "file:line:column: " in front, for invalid TOML, an unknown table or key
/// (with the nearest known name), a value of the wrong type or length, more than kMaxWaves, NaN,
/// and infinities other than for `far`.
SceneFile load_scene(const std::filesystem::path& path);

/// The same from a text, such as the attribute `limpid/scene` of a rendered plate; `name` stands
/// for the file in errors.
SceneFile scene_from_toml(const std::string& text, const std::string& name);

/// Camera, water, sun, time, and primaries other than Rec.709 as a text that scene_from_toml()
/// reads back to the bit. Throws Error for more than kMaxWaves.
std::string to_toml(const Scene& scene);

/// The two parts of "FILE:CHANNELS", which is cut at the last ':' that no '/' follows; without such
/// a ':' `channels` is "".
struct PlateName {
  std::string file, channels;
};
PlateName split_plate(std::string_view text);

/// The kind with the name eye, ray, inverse, normalised or device. Throws Error of Fault::kUsage
/// with the nearest name for another word.
DepthKind depth_kind_named(std::string_view word);
std::string_view depth_kind_name(DepthKind kind);

}  // namespace limpid
