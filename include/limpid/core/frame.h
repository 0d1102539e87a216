#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "limpid/core/enum_set.h"
#include "limpid/core/plane.h"
#include "limpid/core/vec.h"

namespace limpid {

/// The input channels of a frame. roles() lists their meaning and conventions.
enum class PlaneId : std::uint8_t {
  kColorR,
  kColorG,
  kColorB,
  kColorA,
  kDepth,
  kShadow,
  kReflectionR,
  kReflectionG,
  kReflectionB,
  kSurfaceDepth,
  kSurfaceNormalX,
  kSurfaceNormalY,
  kSurfaceNormalZ,
  kReflectionValid,
  kReflectionDepth,
  kBelowR,
  kBelowG,
  kBelowB,
  kBelowDepth,
  kSurfaceShadow,
  kSkyR,
  kSkyG,
  kSkyB,
  kAlbedoR,
  kAlbedoG,
  kAlbedoB,
  kSunColorR,
  kSunColorG,
  kSunColorB,
  kBasin,
};
constexpr int kPlaneCount = 30;
constexpr int index_of(PlaneId id) { return static_cast<int>(id); }
/// The plane `step` planes after `id`, as in plane_after(kColorR, 2) = kColorB.
constexpr PlaneId plane_after(PlaneId id, int step) {
  return static_cast<PlaneId>(index_of(id) + step);
}

using PlaneSet = EnumSet<PlaneId>;

/// The replacement of NaN and infinity in a plane on entry.
enum class Sanitise : std::uint8_t {
  kColor,   ///< NaN, -inf -> 0; +inf -> the largest half
  kDepth,   ///< NaN, and values for "no surface hit" -> +inf
  kShadow,  ///< NaN, inf -> 1, then clamped to 0 ... 1
  kNormal,  ///< made unit; NaN, inf or zero length -> up
  kMask,    ///< NaN, inf -> 0, then clamped to 0 ... 1
};

/// The sample type in files, unless a whole file is written as float.
enum class Storage : std::uint8_t {
  kHalf,
  kFloat,  ///< for lengths and for positions in the picture, for which half is too coarse
};

/// A group of planes that belong together, with its name in files and on the command line.
struct Role {
  std::string_view name;
  PlaneId first;
  int count;
  float missing;  ///< the value outside of the plane's data window
  Sanitise sanitise;
  /// The layer of the role in plates that limpid writes, or "" for a role without a layer in files.
  std::string_view layer;
  /// The channels of that layer, one for each plane, as limpid writes them: "R G B". Names after
  /// '|' are accepted on reading, too.
  std::string_view channels;
  Storage storage;
  std::string_view about;

  constexpr PlaneSet planes() const {
    PlaneSet set;
    for (int i = 0; i < count; ++i) set = set | PlaneSet{plane_after(first, i)};
    return set;
  }
};

/// All roles, in the order of PlaneId.
std::span<const Role> roles();
/// Throws Error with the nearest name for an unknown role.
const Role& role_named(std::string_view name);
/// "color, depth": the roles that have a plane in the set; "-" for none.
std::string roles_text(PlaneSet planes);
/// "below.R": the channel of the i-th plane of the role in plates that limpid writes; "" for none.
std::string channel_name(const Role& role, int i);

inline constexpr PlaneSet kColorPlanes{PlaneId::kColorR, PlaneId::kColorG, PlaneId::kColorB};
inline constexpr PlaneSet kReflectionPlanes{PlaneId::kReflectionR, PlaneId::kReflectionG,
                                            PlaneId::kReflectionB};
inline constexpr PlaneSet kSurfaceNormalPlanes{PlaneId::kSurfaceNormalX, PlaneId::kSurfaceNormalY,
                                               PlaneId::kSurfaceNormalZ};

inline constexpr PlaneSet kSkyPlanes{PlaneId::kSkyR, PlaneId::kSkyG, PlaneId::kSkyB};

inline constexpr PlaneSet kAlbedoPlanes{PlaneId::kAlbedoR, PlaneId::kAlbedoG, PlaneId::kAlbedoB};

inline constexpr PlaneSet kSunColorPlanes{PlaneId::kSunColorR, PlaneId::kSunColorG,
                                          PlaneId::kSunColorB};

inline constexpr PlaneSet kBelowPlanes{PlaneId::kBelowR, PlaneId::kBelowG, PlaneId::kBelowB,
                                       PlaneId::kBelowDepth};

struct BottomLayer;
struct CausticsTable;
struct Continuation;
struct EdgeSurfaces;
struct EdgeCover;
struct ScatteredLight;
struct SlopeLevels;
struct TextureLevels;

/// A picture that is not in screen space (a tiling map, an environment): three float channels r g
/// b, in memory that another object owns.
struct Texture {
  std::array<View<const float>, 3> channels;
  /// The same texels as r | g << 8 | b << 16 if every value is k / 255, as pack_bytes() makes them,
  /// or null. Lookups of tiling maps then fetch a third of the memory words.
  const std::uint32_t* bytes = nullptr;
  /// The mip levels of a tiling normal map, made by LevelMaker. If null, a run that needs levels
  /// makes them anew for each frame.
  const TextureLevels* levels = nullptr;
  explicit operator bool() const { return static_cast<bool>(channels[0]); }

  /// Throws Error, with a message that begins with `name`, for channels of different sizes, NaN and
  /// infinity.
  void validate(const std::string& name) const;
};

/// The texels for Texture::bytes: height + 1 rows of width + 1 texels, with the first column and
/// row repeated at the end. Empty if a value of the texture differs from all k / 255, k = 0 ...
/// 255, by more than 1e-6; pictures of 8 bits have only such values.
std::vector<std::uint32_t> pack_bytes(const Texture& texture);

/// The change of a sky, for red, green and blue: multiples of that of the logarithm of a clear
/// sky's radiance (optics/clear_sky.h), with elevation and with the angle to the sun.
struct SkyChange {
  Rgb<double> with_elevation{0, 0, 0}, with_sun{0, 0, 0};
};

/// The buffers of one picture, as views, in the conventions of the chain: linear eye depth (+inf
/// where no surface was hit), scene-linear premultiplied color, shadow 1 = lit, unit world normals,
/// no NaN (see sanitise.h). Each plane may have its own data window; lookups are clamped to it.
/// Every plane that is present must cover `work()`.
struct Frame {
  Rect display;  ///< the rectangle that uv 0 ... 1 and the camera's projection cover, in pixels
  std::array<View<const float>, kPlaneCount> planes;
  Texture wave_map;  ///< tiling normal map, values 0 ... 1, blue is up
  /// The surroundings as a lat-long map of radiance: row 0 is straight up (the water's up), the
  /// middle column is the direction PlaneAxes::x, and columns run towards PlaneAxes::y.
  Texture environment;
  /// Mip levels of the slopes of wave_map at the time of the frame; null, or made by complete/.
  const SlopeLevels* wave_slopes = nullptr;
  /// The covariance of those slopes along the map's axes, by which a wind scales them. If 0, the
  /// wind does not scale the waves of the map.
  Sym2<double> wave_variance{0, 0, 0};
  /// Multiple scattering in the water, for red, green and blue; null, or made by complete/.
  const ScatteredLight* scattered_light = nullptr;
  /// The mean radiance above the horizon, weighted by the cosine with the water's up: of the
  /// environment, of Scene::sky or of the sky that the frame shows, with the surfaces around that
  /// hide a part of it (complete/surroundings.h); absent if no operator needs it. Of a host, that
  /// of the sky alone, in place of Scene::sky.
  std::optional<Rgb<double>> sky_radiance;
  /// How the planes of the sky go on beyond their edge; none, or made by complete/.
  SkyChange sky_change;
  /// The surfaces above the water at the edge of the picture; null, or made by complete/.
  const EdgeSurfaces* edge_surfaces = nullptr;
  /// The bottom beyond the picture; null, or made by complete/.
  const Continuation* continuation = nullptr;
  /// The bottom behind the objects in front of it; null, or made by complete/.
  const BottomLayer* bottom_layer = nullptr;
  /// Sunlight on the bottom, focused by the waves; null, or made by complete/.
  const CausticsTable* caustics = nullptr;
  /// The objects in front of the water, from deep samples: red, green, blue, premultiplied, and
  /// alpha, their share of the pixel. Either none or all four are present and cover work(); `color`
  /// still includes the objects.
  std::array<View<const float>, 4> foreground;
  /// Pixels that objects in front of the water cover in part; null, or made by complete/. Color and
  /// depth are then those of the scene behind the objects.
  const EdgeCover* edges = nullptr;
  /// The number of pixels beyond each side of the display window that are computed, too, as far as
  /// all planes reach.
  int overscan = 0;

  const View<const float>& plane(PlaneId id) const { return planes[index_of(id)]; }
  PlaneSet present() const;
  /// The pixels that are computed: the display window as far as color reaches, and `overscan`.
  Rect work() const;
  /// Throws Error if color is absent, the picture is empty, or a plane does not cover work().
  void validate() const;
};

}  // namespace limpid
