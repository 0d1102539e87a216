#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "limpid/core/field.h"
#include "limpid/core/scene.h"

namespace limpid {

/// The normal of the wavy surface, and its tilt m = (n.t, -n.b) on screen.
///
/// `plate`: the surface normals of the frame. The planner takes this model if there are any. The
/// others make waves; `strength` 0 is calm, 1 the unchanged waves. Models with a tiling normal map
/// fix it to the world, one period every tile_size units; its red, green, blue are (2 c - 1) along
/// map x, map y and up.
///
/// `four_maps` ("Realistic Water"): four lookups that drift along +x, -x, +y and -y; n =
/// normalize(mean of lerp(up, n_i, strength)). Blending vectors instead of slopes flattens steep
/// waves; kept as in the article.
///
/// `two_flows` (Rito15 2021): n = normalize(lerp(up, (n1 + n2 / 2) / 2, strength)), n1 drifts along
/// `direction`, n2, with half the tile density, back at 0.3 of the speed. The article does not
/// normalise and so reflects less than intended.
///
/// `dudv` (Digiorgio 2024): a first lookup at (u + move, v), times 0.01, displaces the position (u,
/// v + move) of a second; its normal is (2r - 1, 2g - 1, b) along map x, map y and up: blue is not
/// decoded, which flattens, kept as in the article. The tilt is not that of this normal: the
/// article takes (2r - 1, 2g - 1) as right and down on screen for any camera, and so does this
/// model, clamped to -1 ... 1.
///
/// `sines`: the exact normals of a sum of sine waves: `waves`, or the scene's if `waves` is empty.
/// Calm if neither has waves. These waves have height, too, times `strength`: if the frame has no
/// surface_depth, limpid computes it (complete/displaced_surface.h), and all operators use that
/// intersection of ray and water. With all other models the water of such a frame is flat, whatever
/// its normals. `slopes`: the lookups of four_maps, but slopes are added: with h the mean of (-n_x,
/// -n_y) / n_z times strength, n = normalize(-h_x, -h_y, 1). n_z below 0.05 counts as 0.05, so no
/// slope passes
/// 20. Mikkelsen 2020, "Surface Gradient-Based Bump Mapping Framework".
///
/// `wind`, in m/s, 12.5 m over the water, replaces `speed` for all models with a map, and blows
/// towards `direction`: 0 is map x, 90 map y. Scene units must then be metres. - Lookups move with
/// the wind, each at the speed of deep-water waves of its length (Lamb 1932, "Hydrodynamics"), plus
/// the drift of the water's skin (Wu 1975, "Wind-Induced Drift Currents"). An eighth of a tile
/// counts as the length of the map's waves. The four lookups of four_maps and slopes stand for
/// waves of 2, 1.4, 1 and 0.7 times that length, which run 15, -25, 40 and -40 degrees off the
/// wind, with different offsets in the map. The first lookup of two_flows runs along the wind, the
/// second, of waves twice as long, at 15 degrees; the second lookup of dudv runs along the wind. -
/// Slopes are scaled along the wind and across it, so that the mean square of each over the map, at
/// this time, is that of a clean sea (Cox & Munk 1954; optics/wind.h), times strength squared. The
/// error of this mean square is at most 2 % for `slopes`, at strength 1 4 % for four_maps and dudv
/// and 10 % for two_flows, whose lookups count as two maps. The tilt of dudv has no direction in
/// the world: its factor is the root mean square of both. A map flatter than the rounding of its
/// bytes is not scaled. Cox & Munk's slopes include all waves down to ripples, so the roughness of
/// other operators comes on top of them. Without wind the coordinates of the first lookup of
/// two_flows move along `direction`, as in the article, so its waves move in the opposite
/// direction.
///
/// `filter` treats waves that are too small for a pixel (op/footprint.h). `none`: each pixel takes
/// the normal at its centre. `variance`: the normal is that of the mean slope in the pixel, and
/// slope_variance the covariance around it: for sines in closed form, for a Gaussian footprint; for
/// the frame's normals the expectation of a Gaussian field of slopes with the same statistics
/// (complete/plate_waves.h), given the pixel's normal. `mip`: the mean alone; the frame's normals
/// are unchanged.
///
/// Lookups of a map with `mip` read the level, a mean of colors, whose texels are as wide as
/// the pixel (at least a quarter of its length); `slopes` reads mean slopes instead, and with
/// `variance` their covariance, too (Olano & Baker 2010, "LEAN Mapping"). four_maps,
/// two_flows and dudv, whose vectors are not slopes, treat `variance` as `mip`: their
/// slope_variance is 0. Where a pixel is at most one texel wide, every filter gives the bits
/// of `none`.
struct WaveNormals {
  enum class Model { kFourMaps, kTwoFlows, kDudv, kSines, kSlopes, kPlate };
  enum class Filter { kNone, kMip, kVariance };
  struct Params {
    Model model = Model::kSlopes;
    Filter filter = Filter::kNone;
    double strength = 0.5;
    double tile_size = 4;
    double speed = 0.3;
    double direction = 135;
    double wind = 0;
    std::string map;
    std::vector<SineWave> waves;
  };

  static constexpr std::string_view kName = "wave_normals";
  static constexpr std::string_view kAbout = "Normal of the wavy surface and its tilt on screen.";
  static std::span<const Field<Params>> fields();
};

}  // namespace limpid
