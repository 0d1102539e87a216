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
  std::vector<std::uint32_t> bytes;          ///< Texture::bytes, for a tiling texture of 8 bits
  std::shared_ptr<const LevelMaker> levels;  ///< for a tiling texture
};

/// The first three channels of a picture file as a tiling texture: R G B of an EXR, or of any other
/// format of image_file.h. NaN and -inf become 0, +inf the largest half. Throws Error if the file
/// has fewer channels.
LoadedTexture load_texture(const std::filesystem::path& path, const Limits& limits = {});

/// Loads the surroundings as the lat-long map of Frame::environment, from a picture file of either
/// layout, with channels as load_texture() reads them:
/// - lat-long: twice as wide as high. The top row is straight up, and columns run to the right as
///   seen from inside, that is clockwise from above, as in all renderers. Texels are areas: the
///   first and the last column share an edge.
/// - cube: six square faces one below the other, in the order and orientation of OpenEXR's
///   ImfEnvmap.h; +Y is up, and +Z is the direction of the middle of a lat-long map. Centres of the
///   outermost texels lie on the cube's edges, as in OpenEXR. The cube is resampled (bilinear) to
///   four times the width and twice the height of a face. An EXR's attribute `envmap` must agree
///   with the picture's shape; without it the shape decides.
///
/// The file's up is the water's up; its middle is the direction PlaneAxes::x, turned by `rotation`
/// (rad) about up, counter-clockwise from above. Without a rotation this is Blender's convention,
/// for z up. OpenEXR's convention, for y up and the middle along z, is a quarter turn clockwise.
/// Rotations by fractions of a texel interpolate linearly.
///
/// The colors are converted to `primaries` if the file names its own color space; else they count
/// as being in `primaries`. Throws Error for other shapes.
LoadedTexture load_environment(const std::filesystem::path& path, double rotation,
                               const Primaries& primaries = kRec709, const Limits& limits = {});

}  // namespace limpid
