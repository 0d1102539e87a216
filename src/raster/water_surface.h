#pragma once
#include <array>

#include "limpid/core/executor.h"
#include "limpid/core/plane.h"
#include "limpid/core/scene.h"
#include "limpid/raster/model.h"

namespace limpid {

struct ShadowMap;

/// The water of a model as it stands at one time: its meshes in world space, every vertex raised by
/// the waves, with the true normals of the raised surface. Empty where the model has no water.
Model raised_water(const Model& model, const WaterPlane& water, double time);

/// The water surface as one camera sees it, over a window of its display.
struct SeenSurface {
  Plane depth;                  ///< linear eye depth, +inf where there is no water
  std::array<Plane, 3> normal;  ///< unit, world, out of the water; empty for the calm plane
};

/// How far the waves can raise the water over the calm plane.
double highest_crest(const WaterPlane& water);

/// Turns normals around that point into the water, to a viewer below.
void point_out_of_water(const glm::dvec3& up, std::array<Plane, 3>& normal);

/// Where the camera sees the calm plane.
SeenSurface calm_surface(const Camera& camera, const WaterPlane& water, const Rect& display,
                         const Rect& window);

/// The sun's visibility at each point of the surface, 1 where there is none.
Plane surface_shadow(const SeenSurface& surface, const Camera& camera, const WaterPlane& water,
                     const Rect& display, const ShadowMap& map, Executor& executor);

}  // namespace limpid
