#pragma once
#include <string>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/scene.h"
#include "limpid/raster/model.h"

namespace limpid {

/// Of a picture with its overscan.
inline constexpr int kMostRenderedSide = 32000;
inline constexpr int kMostShadowMap = 16384;

struct RenderOptions {
  Size size{1920, 1080};       ///< 1 ... kMostRenderedSide a side
  int overscan = 0;            ///< pixels beyond each side of the display window
  int shadow_map_size = 2048;  ///< texels a side, 1 ... kMostShadowMap
  std::string simd = {};       ///< "" for the best
};

/// The planes of a rendered plate, over the display window and the overscan.
struct RenderedPlate {
  Frame frame;  ///< views into `planes`, by PlaneId
  std::vector<Plane> planes;
};

/// What the camera sees, from a model: its own source of buffers for who has no renderer at hand.
/// Draws only the passes that `wanted` needs.
///
/// Color, depth and shadow of the dry scene, from above the water or in it; the sun's share of that
/// color, in which the sky and what is unlit or emits are black. The mirrored scene cut
/// at the water (mirror.h), its eye depth along the mirrored ray, and where it is real: 1 for a
/// front face or the sky, 0 where it looks into what the water cut open. An eye below the calm
/// plane sees the mirror's underside; one in the plane sees none, and these planes stay empty.
/// Below: what lies under the calm plane, or under the highest crest of waves, alone, by a clip
/// plane there. Depth and normals of the water's own meshes, raised and lowered by
/// scene.water.waves, seen from either side, and the sun's visibility there; without a water mesh
/// depth and normals stay empty, as the chain derives them from the calm plane, and the shadow is
/// that on the calm plane. Without a sun there is ambient light alone, and neither its
/// share nor a surface shadow.
///
/// Throws Error when the scene lacks camera or water, the sun is below the horizon, or a size is
/// out of bounds.
RenderedPlate render_plate(const Model& model, const Scene& scene, const RenderOptions& options,
                           PlaneSet wanted, Executor& executor);

/// What render_plate() can make of this model in this scene: of the planes that say something.
/// Throws Error when the scene lacks water, or waves shall move a mesh that is not there.
PlaneSet renderable(const Model& model, const Scene& scene);

/// The scene of a model: `scene`, with the model's camera (its aspect made that of `size`) and sun
/// where it has none.
Scene scene_of_model(const Scene& scene, const Model& model, Size size);

}  // namespace limpid
