#pragma once
#include <array>

#include "limpid/core/executor.h"
#include "limpid/core/plane.h"
#include "limpid/core/scene.h"
#include "limpid/raster/model.h"

namespace limpid {

struct ShadowMap;

/// The water of a model at one time: its meshes in world space, every vertex raised by the waves.
/// Empty if the model has no water.
Model raised_water(const Model& model, const WaterPlane& water, double time);

/// Whether all water of a model lies in the calm plane, to a hundredth of its waves' height.
bool is_level(const Model& model, const WaterPlane& water);

/// Unit normal of the waves at a point in world space, out of the water; `axes` are those of the
/// water. Exact between the vertices of raised_water, however far apart they are.
glm::dvec3 wave_normal(const WaterPlane& water, const PlaneAxes& axes, const glm::dvec3& point,
                       double time);

/// The water surface seen by one camera, over a window of its display.
struct SeenSurface {
  Plane depth;                  ///< linear eye depth, +inf where there is no water
  std::array<Plane, 3> normal;  ///< unit, world, out of the water; empty for the calm plane
};

/// Height of the highest wave over the calm plane.
double highest_crest(const WaterPlane& water);

/// The normals of the waves at each point of the surface, 0 where there is no surface.
std::array<Plane, 3> surface_normals(const Plane& depth, const Camera& camera,
                                     const WaterPlane& water, double time, const Rect& display,
                                     Executor& executor);

/// The calm plane as the camera sees it.
SeenSurface calm_surface(const Camera& camera, const WaterPlane& water, const Rect& display,
                         const Rect& window);

/// The sun's visibility at each point of the surface, 1 where there is no surface.
Plane surface_shadow(const SeenSurface& surface, const Camera& camera, const WaterPlane& water,
                     const Rect& display, const ShadowMap& map, Executor& executor);

}  // namespace limpid
