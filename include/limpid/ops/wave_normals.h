#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "limpid/core/field.h"
#include "limpid/core/scene.h"

namespace limpid {

/// The normal of the wavy surface, and its tilt m = (n.t, -n.b) as the camera sees it.
///
/// `plate`: the frame's own surface normals. The planner takes this model whenever there are any.
/// The others make waves; `strength` 0 is calm, 1 the waves as they are. Those with a tiling normal
/// map tie it to the world, one period every tile_size units; its red, green, blue are (2 c - 1)
/// along map x, map y and up.
///
/// `four_maps` ("Realistic Water"): four lookups that drift along +x, -x, +y and -y; n =
/// normalize(mean of lerp(up, n_i, strength)). Blending vectors instead of slopes flattens steep
/// waves; kept as the article has it.
///
/// `two_flows` (Rito15 2021): n = normalize(lerp(up, (n1 + n2 / 2) / 2, strength)), n1 drifts along
/// `direction`, n2, half as densely tiled, back at 0.3 of the speed. The article does not normalise
/// and so reflects less than it means to.
///
/// `dudv` (Digiorgio 2024): a first lookup at (u + move, v), times 0.01, distorts the place (u, v +
/// move) of a second; its normal is (2r - 1, 2g - 1, b) along map x, map y and up: blue is not
/// decoded, which flattens, kept as the article has it. The tilt is not this normal's: the article
/// takes (2r - 1, 2g - 1) for right and down on screen wherever the camera looks, and so does this
/// model, to within -1 ... 1.
///
/// `sines`: the true normals of a sum of sine waves: `waves`, or the scene's own where there are
/// none. Calm when neither has any. These waves have height, too, times `strength`: where the frame
/// has no depth of the surface it is made (complete/displaced_surface.h), and all operators meet
/// the water there. With all other models such a frame's water is flat, however its normals lean.
///
/// `slopes`: the lookups of four_maps, but slopes are added: with h the mean of (-n_x, -n_y) / n_z
/// times strength, n = normalize(-h_x, -h_y, 1). n_z below 0.05 counts as 0.05, so no slope passes
/// 20. Mikkelsen 2020, "Surface Gradient-Based Bump Mapping Framework".
///
/// `wind`, in m/s, 12.5 m over the water, takes the place of `speed` for all models of a map, and
/// blows towards `direction`: 0 is map x, 90 map y. A scene unit is a metre then.
///  - Lookups run with the wind, each as fast as deep-water waves of its own length do (Lamb 1932,
///    "Hydrodynamics"), on water whose skin the wind drags along (Wu 1975, "Wind-Induced Drift
///    Currents"). An eighth of a tile counts as the length of the map's waves. The four lookups of
///    four_maps and slopes stand for waves of 2, 1.4, 1 and 0.7 times that length, which run 15,
///    -25, 40 and -40 degrees off the wind, and begin apart. The first of two_flows runs straight,
///    the second, of waves twice as long, at 15 degrees; the second of dudv straight.
///  - Slopes are scaled along the wind and across it, until the mean square of each over the map,
///    at this time, is that of a clean sea (Cox & Munk 1954; optics/wind.h), times strength
///    squared. That is so to 2 % of it for `slopes`, at strength 1 to 4 % for four_maps and dudv
///    and to 10 % for two_flows, whose lookups count as two maps. The tilt of dudv knows no
///    direction of the world: it has the root mean square of both factors. A map flatter than the
///    rounding of its bytes stays as it is. Cox & Munk's slopes are those of all waves down to
///    ripples: roughness elsewhere adds to them.
/// Without wind two_flows' `direction` is where its first lookup goes, as the article has it: its
/// waves go the other way.
///
/// `filter` says what becomes of waves that are too small for a pixel (op/footprint.h). `none`:
/// each pixel takes the normal at its centre. `variance`: the normal is that of the mean slope in
/// the pixel, and slope_variance the covariance around it. Of sines that is closed form, for a
/// Gaussian footprint; of the frame's own normals it is what a Gaussian field of slopes like theirs
/// (complete/plate_waves.h) is expected to do in the pixel, given the normal there. `mip`: the mean
/// alone; the frame's own normals stay as they are.
///
/// Lookups of a map with `mip` read the level, a mean of colors, whose texels are as wide as the
/// pixel (at least a quarter of its length); `slopes` reads mean slopes instead, and with
/// `variance` their covariance, too (Olano & Baker 2010, "LEAN Mapping"). four_maps, two_flows and
/// dudv, whose vectors are no slopes, do the same with `variance` as with `mip`: their
/// slope_variance is 0. Where a pixel is at most one texel wide, every filter gives the bits of
/// `none`.
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
