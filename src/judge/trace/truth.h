#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/scene.h"
#include "limpid/ops/look.h"
#include "limpid/raster/model.h"
#include "limpid/run/target.h"

namespace limpid {

inline constexpr int kMaxTruthSamples = 16, kMaxTruthPaths = 65536, kMaxTruthPhotons = 50000000;

/// The light that would really arrive, by tracing rays through a model: what the chain, which only
/// looks things up in pictures, is judged by.
///
/// A view ray meets the model's dry triangles or the water: its raised mesh, as render_plate()
/// draws it, or the calm plane where the model has none. At the water it parts. The mirrored ray
/// goes on through the real scene, above the water or onto it once more. The refracted ray, one for
/// each index of refraction, goes on to the real bottom, or up through a crest. Both are followed
/// through kTruthEvents meetings with the surface; after these only what is dry is seen.
///
/// What the surface and the water are like, the look says, by the parameters and in the conventions
/// of the chain, so that on calm water over a flat, sunlit floor the chain and Light::kOnce agree:
/// - Normals: those of the raised mesh, or else what wave_normals makes of its map or waves, on a
///   surface that stays flat.
/// - Index: water.ior for green, with prism_split.gain times the dispersion of water for the
///   others, in all that an index enters, whatever prism_split.model is. Reflectance is exact.
/// - Medium: absorption, scattering, water_type, anisotropy, ambient, sunlight and crossing of
///   depth_fog, whatever its model is.
/// - Way down of the sun: as `sunlight` and `crossing` have it, under calm water; depths are those
///   below the calm plane. With `refracted` the sunlight on the bottom comes from where it comes
///   from in the water, and so do shadows. With kOnce ambient light loses as much as the sun's.
/// - Highlight: the lobe that sun_highlight has at the normal, times the sun's visibility: the sun
///   is a point to all else.
/// - What mirrored rays see where they leave the scene is by fresnel_reflection.source: the model's
///   background, the environment (if there is one), or the constant color. Others see the
///   background.
/// - Penetration, and the ways of the other operators to look things up, have no meaning here.
/// Dry surfaces answer light as in the raster pass (Shading), with hard shadows of the sun. Those
/// that blend are seen through where they lie, in the air or in the water, up to kBlendedLayers on
/// one way; shadows, ends of ways and `visible` are by the rule that AlphaMode has for depth.
///
/// Light::kPaths follows light through the water by random walks: scattered by the water, thrown
/// back by dry surfaces (evenly, by their color; unlit ones throw nothing back) and by the surface
/// from below, any number of times. Each channel is right in the mean. It differs from kOnce in
/// - the sun's way down: it loses all that the water takes and throws elsewhere, a + b, whatever a
///   `water_type` says, and the narrow peak of radiative_transfer, too, for what is thrown
///   elsewhere is followed. `sunlight` = `none` is straight.
/// - the sky: the environment, else Scene::sky, else an even one of depth_fog's `ambient`. It
///   lights the water through the surface.
/// - the surface from below: where `crossing` is not `none` it lets light through and throws it
///   back by Fresnel's law, and radiance is ior^2 of that in the air; with `none` it does nothing.
/// - dry surfaces in the water: the ambient light of a material is that of an even sky, and so
///   comes down through the water, as on level ground; all light of unlit ones does. In the
///   dry picture no dry surface lights another: of the light that it has, what would come straight
///   from one to another, through water or air, is left out here, too. What is added is what the
///   water scatters and the surface throws back, and that goes on from one dry surface to another.
///   Dry surfaces in the air are as in the dry picture. So a chain that gets the dry picture can be
///   judged by it.
/// Blended surfaces block walks by the rule that AlphaMode has for depth. Beside a mesh of the
/// water the water goes on. Where nothing is absorbed light from deeper than trace_column() has it
/// counts as none.
///
/// With `photons` the sun's light reaches the bottom through the waves (in the color of the common
/// index), where the picture shows it nearer than four times the median distance. It is blurred
/// over the disc that 100 photons would fill on level ground under calm water, and dimmed within
/// the disc's radius of edges. Light that the water scatters still comes through the calm plane.
///
/// Left out: light that waves focus in the water; with kOnce light that is scattered or
/// reflected more than once on its way from the sun to where it is seen, and the sky's light being
/// shadowed.
struct TruthOptions {
  enum class Light {
    kPaths,  ///< scattered, and thrown back by surface and bottom, any number of times
    kOnce,   ///< scattered once, in closed form
  };

  Size size{1920, 1080};
  /// N x N samples a pixel, stratified and filtered by their mean, 1 ... kMaxTruthSamples. One is
  /// the pixel's centre, as in the chain.
  int samples = 1;
  Light light = Light::kPaths;
  int paths = 16;  ///< random ones of each sample with kPaths, 1 ... kMaxTruthPaths
  /// Of the sun's light on the bottom, through the waves, which focus it: 0 ... kMaxTruthPhotons,
  /// 40 bytes each. With 0 it comes through the calm plane. Only for kPaths, and where depth_fog's
  /// `sunlight` is refracted.
  int photons = 0;
  std::uint64_t seed = 0;  ///< of where in its stratum each sample lies, and of the paths
  std::vector<Aov> aovs;   ///< all but AovInfo::of_buffers, for nothing is guessed
  bool visible = false;    ///< TruthPicture::visible and visible_below
  Texture wave_map;        ///< for a look that reads one
  Texture environment;     ///< for a look whose mirror shows it, and as the sky of kPaths
};

inline constexpr int kTruthEvents = 4;

/// AOVs mean what they mean in a run of the chain (run/target.h). Terms, fresnel and transmittance
/// are means of the samples; path, normal, surface_depth, the stmaps and `visible` are those of the
/// pixel's centre.
///
/// stmap: where the end of the channel's refracted ray lies in the picture, seen or not, inside or
/// not; rays that leave the scene end at infinity. Where nothing is refracted (dry pixels, total
/// reflection, views in the water alone), and for what lies behind the camera, the pixel's own
/// place.
struct TruthPicture {
  Rect window;
  std::vector<Plane> planes;
  Target target;  ///< color, alpha and the AOVs that were asked for
  /// The noise of the color: standard errors of its channels over their values, both in the mean of
  /// the picture. NaN where it is not known, for each pixel is of one path, and of a black picture.
  double relative_error = 0;
  /// For each channel, 1 where the dry camera sees the very point that the refracted ray ends at,
  /// so that the dry picture has its color; 0 where something hides it, where it is out of frame or
  /// behind the camera, and where the ray does not end. 1 where nothing is refracted.
  std::array<View<float>, 3> visible;
  /// The same of a picture of what lies under the crests of the water alone (PlaneId::kBelowR),
  /// which the chain looks things up in where a frame has one. Where the view can begin in the
  /// water, for which the chain keeps to the dry picture: as `visible`.
  std::array<View<float>, 3> visible_below;
};

/// The same bits for any number of threads. Throws Error for what render_plate() refuses, an
/// orthographic camera below the water, samples, paths or photons out of range, photons where
/// nothing bends the sun's light or for Light::kOnce, AOVs of buffers, AOVs that are
/// named twice, and where Embree finds no memory.
TruthPicture trace_truth(const Model& model, const Scene& scene, const Look& look,
                         const TruthOptions& options, Executor& executor);

}  // namespace limpid
