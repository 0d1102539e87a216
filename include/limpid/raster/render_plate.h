#pragma once
#include <string>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/scene.h"
#include "limpid/raster/model.h"

namespace limpid {

/// Largest width and height of a picture with its overscan, in pixels.
inline constexpr int kMaxRenderedSide = 32000;
inline constexpr int kMaxShadowMap = 16384;

struct RenderOptions {
  Size size{1920, 1080};       ///< width and height, 1 ... kMaxRenderedSide
  int overscan = 0;            ///< pixels beyond each side of the display window
  int shadow_map_size = 2048;  ///< texels along each side, 1 ... kMaxShadowMap
  std::string simd = {};       ///< instruction set; "" for the best
};

/// The planes of a rendered plate, over the display window and the overscan.
struct RenderedPlate {
  Frame frame;  ///< views into `planes`, by PlaneId
  std::vector<Plane> planes;
};

/// Renders the buffers of a model from the camera, for hosts without a renderer. Draws only the
/// passes that `wanted` needs.
///
/// Color, depth and shadow of the dry scene, from above the water or under it; the part of that
/// color that is direct sunlight, in which the sky and unlit or emissive surfaces are black. The
/// reflection, clipped at the water (mirror.h), its eye depth along the mirrored ray, and its
/// validity: 1 for a front face or the sky, 0 inside of clipped objects. An eye below the calm
/// plane sees the mirror's underside; an eye in the plane sees none, and these planes stay empty.
/// The layer below: geometry under the calm plane, or under the highest crest of waves, by a clip
/// plane there. Depth and normals of the surface where water meshes are seen, displaced by
/// scene.water.waves, from either side, and the sun's visibility there. They are those of the waves
/// themselves between a mesh's vertices, too, if all water meshes lie in the calm plane; else the
/// depth is that of the raised mesh. Without a water mesh depth and normals stay empty, as the
/// chain derives them from the calm plane, and the shadow is that on the calm plane. Without a sun
/// there is ambient light only, and neither direct sunlight nor a surface shadow.
///
/// Throws Error if the scene lacks camera or water, if the sun is below the horizon, or if a size
/// is out of bounds.
RenderedPlate render_plate(const Model& model, const Scene& scene, const RenderOptions& options,
                           PlaneSet wanted, Executor& executor);

/// The planes that render_plate() can render from this model in this scene. Throws Error if the
/// scene lacks water, or if it has waves but the model has no water mesh.
PlaneSet renderable(const Model& model, const Scene& scene);

/// The scene of a model: `scene`, with the model's camera (with the aspect of `size`) and sun if it
/// has none.
Scene scene_of_model(const Scene& scene, const Model& model, Size size);

}  // namespace limpid
