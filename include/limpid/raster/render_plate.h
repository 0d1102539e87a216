#pragma once
#include <string>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/scene.h"
#include "limpid/raster/model.h"

namespace limpid {

struct RenderOptions {
  Size size{1920, 1080};
  int overscan = 0;            ///< pixels beyond each side of the display window
  int shadow_map_size = 2048;  ///< texels a side
  std::string simd = {};       ///< "" for the best
};

/// Buffers of a plate that no frame holds yet but files do.
enum class ExtraPlane {
  kReflectionValid,  ///< 1 where the mirror sees a front face or the sky, 0 where it looks into
                     ///< what the water cut open
  kReflectionDepth,  ///< linear eye depth along the mirrored ray from the mirrored eye, +inf for
                     ///< the sky
  kBelowR,  ///< color of what lies below the calm surface alone (a clip plane at the water)
  kBelowG,
  kBelowB,
  kBelowDepth,  ///< its linear eye depth, +inf where nothing is
};
constexpr int kExtraPlaneCount = 6;

/// The planes of a rendered plate, over the display window and the overscan.
struct RenderedPlate {
  Frame frame;  ///< views into `planes`, by PlaneId
  std::vector<Plane> planes;
  std::vector<Plane> extras;  ///< by ExtraPlane; empty ones were not asked for
};

/// What the camera sees, from a model: its own source of buffers for who has no renderer at hand.
/// Color, depth and shadow of the dry scene; the mirrored scene cut at the water (mirror.h); depth
/// and normals of the water's own meshes, raised and lowered by scene.water.waves, or of the calm
/// plane where the model has no water mesh. Draws only the passes that `wanted` (and `extras`)
/// need.
///
/// Throws Error when the scene lacks camera or water, the eye is not above every wave, the sun is
/// below the horizon (without a sun there is ambient light alone), or a size is out of bounds.
RenderedPlate render_plate(const Model& model, const Scene& scene, const RenderOptions& options,
                           PlaneSet wanted, bool extras, Executor& executor);

/// The scene of a model: `scene`, with the model's camera (its aspect made that of `size`) and sun
/// where it has none.
Scene scene_of_model(const Scene& scene, const Model& model, Size size);

}  // namespace limpid
