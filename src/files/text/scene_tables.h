#pragma once
#include <filesystem>
#include <limits>
#include <span>
#include <string_view>

#include "limpid/core/error.h"
#include "limpid/core/field.h"
#include "limpid/core/frame.h"
#include "limpid/core/scene.h"
#include "limpid/optics/depth.h"

/// @file
/// The tables of scene files as data: scene_file.cpp reads and writes them, scene_keys.cpp lists
/// them.

namespace limpid {

/// A table of the file, whose keys are the fields of P.
template <class P>
struct FieldTable {
  std::string_view name, about;
  std::span<const Field<P>> fields;
  std::string_view required = {};  ///< a required key, or ""
  std::string_view expected = {};  ///< that key in words
};

inline constexpr std::string_view kClips[] = {"gl", "d3d", "reversed"};
inline constexpr std::string_view kDepths[] = {"eye", "ray", "inverse", "normalised", "device"};

/// Tables that are not members of another struct, with the file's values; NaN for numbers without a
/// default.
struct GeometryKeys {
  std::filesystem::path gltf;
};
struct PlateKeys {
  std::filesystem::path environment;
  double environment_rotation = 0;
};
struct CameraKeys {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  glm::dmat4 view{1.0}, projection{1.0};
  double fov_x = kNone, fov_y = kNone, orthographic = kNone;
  ClipSpace clip = ClipSpace::kGl;
  double near = kNone, far = kNone;
  DepthKind depth = DepthKind::kEye;
  double depth_nothing = kNone;
};

inline constexpr Field<GeometryKeys> kGeometryKeys[] = {
    file<&GeometryKeys::gltf>("gltf", "The glTF 2.0 scene, .gltf or .glb."),
};
inline constexpr FieldTable<GeometryKeys> kGeometryTable{"geometry", "A scene to be rendered.",
                                                         kGeometryKeys, "gltf", "gltf = FILE"};

inline constexpr Field<PlateKeys> kPlateKeys[] = {
    file<&PlateKeys::environment>("environment",
                                  "A picture of the surroundings, lat-long or cube."),
    real<&PlateKeys::environment_rotation>(
        "environment_rotation", "degrees", kFinite,
        "Angle from the water plane's x axis to the direction of the middle of the environment, "
        "counter-clockwise as seen from above."),
};
inline constexpr FieldTable<PlateKeys> kPlatesTable{
    "plates",
    "The buffers of a rendered frame, each FILE or FILE:CHANNELS, and a picture of its "
    "surroundings.",
    kPlateKeys};
/// The roles of frames are keys of [plates], too.
constexpr FieldInfo role_field(const Role& role) {
  return {role.name, "", FieldKind::kFile, {}, {}, {}, 0, role.about};
}

inline constexpr Field<CameraKeys> kCameraKeys[] = {
    matrix<&CameraKeys::view>(
        "view", "Rigid matrix from world to eye space, which looks down -Z with +Y up."),
    matrix<&CameraKeys::projection>("projection", "Matrix from eye to clip space."),
    real<&CameraKeys::fov_x>("fov_x", "degrees", kFinite,
                             "Horizontal field of view, above 0 and below 180."),
    real<&CameraKeys::fov_y>("fov_y", "degrees", kFinite,
                             "Vertical field of view, above 0 and below 180."),
    real<&CameraKeys::orthographic>("orthographic", "scene units", kFinite,
                                    "Width of the view of an orthographic camera."),
    choice<&CameraKeys::clip, kClips>("clip",
                                      "Device depth from near to far: -1 to 1, 0 to 1 or 1 to 0."),
    real<&CameraKeys::near>(
        "near", "scene units", kFinite,
        "Near plane; default: 0.01 with a field of view, 0 with an orthographic width. Only device "
        "and normalised depth read it, and require it."),
    real<&CameraKeys::far>("far", "scene units",
                           {kFinite.min, std::numeric_limits<double>::infinity()},
                           "Far plane, beyond near; default: inf with a field of view, near + 1e4 "
                           "with an orthographic width."),
    choice<&CameraKeys::depth, kDepths>(
        "depth",
        "Kind of the depth: distance along the view axis, along the ray, inverse distance, 0 to 1 "
        "from near to far, or device depth."),
    real<&CameraKeys::depth_nothing>(
        "depth_nothing", "", kFinite,
        "Depth where no surface was hit, besides 1e9 and above, inf and the far plane; usually 0."),
};
inline constexpr FieldTable<CameraKeys> kCameraTable{
    "camera",
    "The camera of the frame: a view, and one of projection, fov_x, fov_y and orthographic; and "
    "the kind of its depth.",
    kCameraKeys};

inline constexpr Field<WaterPlane> kWaterKeys[] = {
    direction<&WaterPlane::up>("up", "Normal of the water plane, of any length."),
    real<&WaterPlane::height>("height", "scene units", kFinite,
                              "Distance of the plane from the origin along up."),
    table<&WaterPlane::waves>(
        "waves", "", kFinite,
        "Sine waves of the surface, at most 1024: amplitude in scene units, wave vector in rad / "
        "scene unit, phase in rad, omega in rad / s; without omega a wave has that of deep water. "
        "Plates need a look with wave_normals.model = sines."),
};
inline constexpr FieldTable<WaterPlane> kWaterTable{
    "water", "The water plane, and waves that displace it.", kWaterKeys};

inline constexpr Field<Sun> kSunKeys[] = {
    direction<&Sun::direction>("direction", "Direction towards the sun, of any length."),
    color<&Sun::color>("color", "", {0, Sun::kBrightest},
                       "Radiance of a white surface that faces the sun."),
    real<&Sun::diameter>("diameter", "degrees", {Sun::kNarrowest, Sun::kWidest},
                         "Diameter of its disc."),
};
inline constexpr FieldTable<Sun> kSunTable{"sun", "The light of the sun.", kSunKeys, "direction",
                                           "a direction towards the sun"};

inline constexpr Field<SkyLight> kSkyKeys[] = {
    color<&SkyLight::radiance>("radiance", "", {0, Sun::kBrightest},
                               "Radiance in red, green and blue, equal in all directions."),
};
inline constexpr FieldTable<SkyLight> kSkyTable{
    "sky",
    "A uniform sky, which lights the water if there is no environment, and which the water mirrors "
    "if the picture shows no sky.",
    kSkyKeys, "radiance", "its radiance, three numbers"};

/// Primaries by name or as numbers, a text.
inline constexpr Field<Scene> kColorSpaceKey = {
    {"colorspace",
     "",
     FieldKind::kText,
     {},
     {},
     {},
     0,
     "Color space of plate, sun and sky: Rec.709, Rec.2020, ACEScg, ACES2065-1, P3-D65, DCI-P3 "
     "or Adobe RGB, or x and y of red, green, blue and white. Without it, the color space of the "
     "plate."},
    [](const Scene& scene) -> Value { return to_string(scene.primaries); },
    [](Scene& scene, const Value& value) {
      try {
        scene.primaries = color_space_named(std::get<std::string>(value));
      } catch (const Error& error) {
        throw Error(std::string("scene.colorspace: ") + error.what());
      }
    },
    [](const Scene& scene) -> const void* { return &scene.primaries; }};
inline constexpr Field<Scene> kSceneKeys[] = {
    real<&Scene::time>("time", "s", kFinite,
                       "Time of the picture, for the waves; --time overrides it."),
    kColorSpaceKey,
};
inline constexpr FieldTable<Scene> kSceneTable{"scene", "Time and color space.", kSceneKeys};

}  // namespace limpid
