#pragma once
#include <glm/mat4x4.hpp>

#include "limpid/core/camera.h"

#include "files/text/json_place.h"

namespace limpid {

/// The camera of a checked document that stands there. Throws Error for one that is mirrored or
/// sheared; the scale of its node counts for nothing.
Camera gltf_camera(const JsonPlace& camera, glm::dmat4 world_from_node);

}  // namespace limpid
