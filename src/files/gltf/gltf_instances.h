#pragma once
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

#include "files/gltf/gltf_accessors.h"
#include "files/text/json_place.h"

namespace limpid {

/// The instances of EXT_mesh_gpu_instancing, checked by check_gltf(): node from instance. Throws
/// Error for rotations that are no unit quaternions.
std::vector<glm::dmat4> read_gltf_instances(const JsonPlace& instancing,
                                            const GltfAccessors& accessors, MemoryBudget& budget);

}  // namespace limpid
