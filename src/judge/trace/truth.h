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

/// The true light, by tracing rays through a model: the standard for the chain, which only looks up
/// pictures.
///
/// A view ray meets the model's dry triangles or the water: its raised mesh, or the calm plane if
/// the model has none. Where the mesh is too wide for the scene's waves its edges are parted first
/// (FinerWater). At the water the ray splits. The mirrored ray continues through the real scene,
/// above the water or onto it again. The refracted ray, one for each index of refraction, continues
/// to the real bottom, or up through a crest. Both are traced through kTruthEvents events at the
/// surface; after these they see only dry surfaces.
///
/// The look gives the properties of surface and water, by the parameters and in the conventions of
/// the chain, so that on calm water over a flat, sunlit floor the chain and Light::kOnce agree:
/// - Normals: those of the scene's waves, or else those of wave_normals for its map or waves, on a
///   surface that stays flat.
/// - Index: water.ior for green, with prism_split.gain times the dispersion of water for the
///   others, wherever an index is used, for any prism_split.model. Reflectance is exact.
/// - Medium: absorption, scattering, water_type, anisotropy, ambient, sunlight and crossing of
///   depth_fog, for any of its models.
/// - Path of sunlight down: by `sunlight` and `crossing`, under calm water; depths are those below
///   the calm plane. With `refracted`, sunlight and shadows on the bottom come from the refracted
///   direction. With kOnce ambient light has the losses of sunlight.
/// - Highlight: the lobe of sun_highlight at the normal, times the sun's visibility; for everything
///   else the sun is a point.
/// - Mirrored rays that leave the scene see fresnel_reflection.source: the model's background, the
///   environment (if there is one), or the constant color. Other rays see the background.
/// - Penetration, and the lookup models of the other operators, are ignored.
/// Dry surfaces are shaded as in the raster pass (Shading), with hard shadows of the sun. Blended
/// surfaces are transparent, in the air and in the water, up to kBlendedLayers on one path; for
/// shadows, ends of paths and `visible` they follow AlphaMode's rule for depth.
///
/// Light::kPaths traces light through the water by random walks: scattered by the water, reflected
/// by dry surfaces (diffusely, by their color; unlit ones do not reflect) and by the surface from
/// below, any number of times. Each channel is unbiased. Differences from kOnce:
/// - the sun's path down: it loses a + b, by absorption and scattering, for any `water_type`,
///   including the narrow peak of radiative_transfer, because scattered light is traced.
///   `sunlight` = `none` is straight.
/// - the sky: the environment, else Scene::sky, else an even sky of depth_fog's `ambient`. It
///   lights the water through the surface.
/// - the surface from below: if `crossing` is not `none` it transmits and reflects light by
///   Fresnel's law, and radiance is ior^2 of that in the air; with `none` it has no effect.
/// - dry surfaces in the water: the ambient light of a material is that of an even sky, and so
///   comes down through the water, as on level ground; so does all light of unlit materials. In the
///   dry picture no dry surface lights another: light that would come straight from one to another,
///   through water or air, is left out here, too. The water's scattered light and the surface's
///   reflection are added, and are reflected from one dry surface to another. Dry surfaces in the
///   air are as in the dry picture. So this picture can judge a chain whose input is the dry
///   picture.
/// Blended surfaces block walks by AlphaMode's rule for depth. Beside a mesh of the water the water
/// continues. Without absorption, light from deeper than in trace_column() counts as 0.
///
/// With `photons` sunlight reaches the bottom through the waves (in the color of the common index),
/// where the picture shows it nearer than four times the median distance. It is blurred over the
/// disc that 100 photons would fill on level ground under calm water, and dimmed within the disc's
/// radius of edges. Light that the water scatters still comes through the calm plane.
///
/// Left out: caustics in the water; with kOnce light that is scattered or reflected more than once
/// between the sun and the view, and shadows of the sky's light.
struct TruthOptions {
  enum class Light {
    kPaths,  ///< scattered and reflected by surface and bottom, any number of times
    kOnce,   ///< scattered once, in closed form
  };

  Size size{1920, 1080};
  /// N x N samples per pixel, stratified and filtered by their mean, 1 ... kMaxTruthSamples. 1 is
  /// the pixel's centre, as in the chain.
  int samples = 1;
  Light light = Light::kPaths;
  int paths = 16;  ///< random paths per sample with kPaths, 1 ... kMaxTruthPaths
  /// Photons of sunlight through the waves to the bottom: 0 ... kMaxTruthPhotons, 40 bytes each.
  /// With 0 sunlight comes through the calm plane. Only for kPaths, and if depth_fog's `sunlight`
  /// is refracted.
  int photons = 0;
  std::uint64_t seed = 0;  ///< of each sample's place in its stratum, and of the paths
  std::vector<Aov> aovs;   ///< all but AovInfo::of_buffers, because nothing is guessed
  bool visible = false;    ///< TruthPicture::visible and visible_below
  Texture wave_map;        ///< for a look that reads it
  Texture environment;     ///< for a look whose mirror shows it, and as the sky of kPaths
};

inline constexpr int kTruthEvents = 4;

/// AOVs have the meaning of the chain's (run/target.h). Terms, fresnel and transmittance are means
/// of the samples; path, normal, surface_depth, the stmaps and `visible` are those of the pixel's
/// centre.
///
/// stmap: the place in the picture of the end of the channel's refracted ray, visible or not,
/// inside or not; rays that leave the scene end at infinity. The pixel's own place without
/// refraction (dry pixels, total reflection, views in the water alone), and for ends behind the
/// camera.
struct TruthPicture {
  Rect window;
  std::vector<Plane> planes;
  Target target;  ///< color, alpha and the requested AOVs
  /// The noise of the color: standard errors of its channels over their values, both in the mean of
  /// the picture. NaN if each pixel has a single path, and for a black picture.
  double relative_error = 0;
  /// For each channel, 1 if the dry camera sees exactly the end of the refracted ray, so that the
  /// dry picture has its color; 0 if another surface hides it, if it is out of frame or behind the
  /// camera, and if the ray has no end. 1 without refraction.
  std::array<View<float>, 3> visible;
  /// The same for a picture of the layer below the crests of the water (PlaneId::kBelowR), which
  /// the chain looks up if a frame has it. If the view may begin in the water, where the chain uses
  /// the dry picture: as `visible`.
  std::array<View<float>, 3> visible_below;
};

/// The same bits for any number of threads. Throws Error for inputs that render_plate() refuses, an
/// orthographic camera below the water, samples, paths or photons out of range, photons without
/// refracted sunlight or for Light::kOnce, AOVs of buffers, AOVs that are named twice, and if
/// Embree runs out of memory.
TruthPicture trace_truth(const Model& model, const Scene& scene, const Look& look,
                         const TruthOptions& options, Executor& executor);

}  // namespace limpid
