#pragma once
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include "limpid/core/camera.h"
#include "limpid/core/scene.h"

namespace limpid {

/// Reflects points in the plane: I - 2 p p^T. Mirroring twice is the identity; winding flips.
glm::dmat4 mirror(const WaterPlane& plane);

/// Whether the eye is off the plane, above or below, so that a mirror in it is visible.
bool sees_mirror(const Camera& camera, const WaterPlane& plane);

/// The camera for which every pixel shows the mirror image that a flat mirror in the plane shows
/// the given camera there: its view is view * mirror(plane), and its near plane is the water plane,
/// so that nothing beyond it is drawn. Its depth buffer is not usable (store linear depth
/// separately). Throws Error if the plane passes through the eye.
Camera mirrored_camera(const Camera& camera, const WaterPlane& plane);

/// `projection` with its near plane replaced by the camera-space plane C (points with C.p > 0 are
/// kept), for each clip space. Lengyel 2005, "Oblique View Frustum Depth Projection and Clipping";
/// the reversed form puts the corner of the frustum on the far plane z = 0 instead, and holds for
/// an infinite far.
glm::dmat4 oblique_near_plane(const glm::dmat4& projection, ClipSpace clip,
                              const glm::dvec4& plane);

}  // namespace limpid
