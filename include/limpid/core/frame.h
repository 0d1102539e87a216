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

/// The input channels of a frame. Meaning and conventions of each: Role, below.
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
};
constexpr int kPlaneCount = 29;
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
  kMask,    ///< NaN -> 0, then clamped to 0 ... 1
};

/// The type of numbers in files, unless all is stored as float.
enum class Storage : std::uint8_t {
  kHalf,
  kFloat,  ///< half is too coarse for lengths and for positions in the picture
};

/// A group of planes that belong together, by the name that files and the command line use.
struct Role {
  std::string_view name;
  PlaneId first;
  int count;
  float missing;  ///< the value outside of the plane's data window
  Sanitise sanitise;
  /// The layer that holds it in a plate of our own, or "" for a role that no file has.
  std::string_view layer;
  /// Of that layer, one for each plane, as they are written: "R G B". After '|' what is read, too.
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
/// Throws Error with the nearest name when there is no such role.
const Role& role_named(std::string_view name);
/// "color, depth": the roles that have a plane in the set; "-" for none.
std::string roles_text(PlaneSet planes);
/// "below.R": the channel that holds the i-th plane of the role in a plate of our own; "" for none.
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
struct EdgeCover;
struct ScatteredLight;
struct SlopeLevels;
struct TextureLevels;

/// A picture outside the screen (a map that tiles, an environment), three float channels r g b in
/// memory that somebody else owns.
struct Texture {
  std::array<View<const float>, 3> channels;
  /// The same again as r | g << 8 | b << 16 where every value is k / 255, as pack_bytes() makes it;
  /// or null. A third of the fetches for maps that tile.
  const std::uint32_t* bytes = nullptr;
  /// Of a tiling normal map, what LevelMaker makes of it, or null: a run whose waves ask for them
  /// then makes them anew for each frame.
  const TextureLevels* levels = nullptr;
  explicit operator bool() const { return static_cast<bool>(channels[0]); }

  /// Throws Error, which begins with `name`, for channels of several sizes, NaN and infinity.
  void validate(const std::string& name) const;
};

/// What Texture::bytes points to: width + 1 texels in each of height + 1 rows, the first column and
/// row once more at the end. Empty for a texture with any value but k / 255, k = 0 ... 255, to
/// within 1e-6: pictures of 8 bits have no others.
std::vector<std::uint32_t> pack_bytes(const Texture& texture);

/// The buffers of one picture, as views. Everything is already in the conventions of the chain:
/// linear eye depth (+inf where nothing was hit), scene-linear premultiplied color, shadow 1 = lit,
/// unit world normals, no NaN (see sanitise.h). Each plane may have its own data window; taps are
/// clamped to it. Every plane that is there must cover `work()`.
struct Frame {
  Rect display;  ///< the picture that uv 0..1 and the camera's projection belong to
  std::array<View<const float>, kPlaneCount> planes;
  Texture wave_map;  ///< tiling normal map, values 0 ... 1, blue is up
  /// The surroundings as a lat-long map of radiance: row 0 is straight up (the water's up), the
  /// middle column looks along PlaneAxes::x, columns run towards PlaneAxes::y.
  Texture environment;
  /// Of wave_map's waves at the time of the frame; null, or made by complete/.
  const SlopeLevels* wave_slopes = nullptr;
  /// How much those waves lean, for a wind that scales them: the covariance of their slopes, along
  /// the map's axes. 0 where nobody has made it: the waves then stay as the map has them.
  Sym2<double> wave_variance{0, 0, 0};
  /// What the water makes of light that it scatters more than once: of red, green, blue; null, or
  /// made by complete/.
  const ScatteredLight* scattered_light = nullptr;
  /// The mean radiance of the environment above, by the cosine with the water's up, where it is
  /// asked for.
  std::optional<Rgb<double>> sky_radiance;
  /// Of the bottom beyond the picture; null, or made by complete/.
  const Continuation* continuation = nullptr;
  /// Of the bottom behind what stands before it; null, or made by complete/.
  const BottomLayer* bottom_layer = nullptr;
  /// The sun's light on the bottom, as waves focus it; null, or made by complete/.
  const CausticsTable* caustics = nullptr;
  /// What stands before the water, of deep samples: red, green, blue, premultiplied, and alpha, its
  /// share of the pixel. None or all are there, and cover work(); `color` then shows it, too.
  std::array<View<const float>, 4> foreground;
  /// Pixels that something before the water covers in part; null, or made by complete/. Color and
  /// depth are then those of what is behind it.
  const EdgeCover* edges = nullptr;
  /// So many pixels beyond each side of the display window are computed, too, as far as all planes
  /// have them.
  int overscan = 0;

  const View<const float>& plane(PlaneId id) const { return planes[index_of(id)]; }
  PlaneSet present() const;
  /// The pixels that are computed: the display window as far as there is color, and `overscan`.
  Rect work() const;
  /// Throws Error when color is absent, the picture is empty, or a plane does not cover work().
  void validate() const;
};

}  // namespace limpid
