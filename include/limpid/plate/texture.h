#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "limpid/core/color_space.h"
#include "limpid/core/frame.h"
#include "limpid/core/plane.h"
#include "limpid/core/texture_levels.h"
#include "limpid/files/limits.h"

namespace limpid {

/// A texture that owns its planes.
struct LoadedTexture {
  Texture texture;
  std::vector<Plane> planes;
  std::vector<std::uint32_t> bytes;          ///< of a tiling texture of 8 bits
  std::shared_ptr<const LevelMaker> levels;  ///< of a tiling texture
};

/// The first three channels of a picture file as a tiling texture: R G B of an EXR, or of any other
/// format of image_file.h. NaN and -inf become 0, +inf the largest half. Throws Error if the file
/// has fewer channels.
LoadedTexture load_texture(const std::filesystem::path& path, const Limits& limits = {});

/// The surroundings from a picture file of either layout, with channels as load_texture() reads
/// them, as the lat-long map that Frame::environment is:
/// - lat-long: twice as wide as high. The top row is straight up, and columns run to the right as
///   one sees them from inside, that is clockwise from above: as all renderers have it. Texels are
///   areas, the outermost columns meet in an edge.
/// - cube: six square faces one below the other, in the order and the orientation that OpenEXR's
///   ImfEnvmap.h draws, +Y being up and +Z where the middle of a lat-long map looks. Centres of
///   outermost texels lie on the cube's edges, as there. It is resampled (bilinear) to four times
///   the width and twice the height of a face.
/// An EXR's attribute `envmap` must agree with the picture's shape, which decides without one.
///
/// The file's up is the water's up; its middle looks along PlaneAxes::x, turned by `rotation` (rad)
/// about up, counter-clockwise from above. That is how Blender sees a file, with its z up; with y
/// up in the scene, and the file's middle to look along z as OpenEXR says, a quarter turn
/// clockwise. Turning by parts of a texel mixes neighbours.
///
/// The light becomes one of `primaries` where the file says what its red, green and blue are; a
/// file that does not say is taken to be of them. Throws Error for other shapes.
LoadedTexture load_environment(const std::filesystem::path& path, double rotation,
                               const Primaries& primaries = kRec709, const Limits& limits = {});

}  // namespace limpid
