#pragma once
#include "limpid/raster/model.h"

#include "load/gltf_material.h"
#include "load/gltf_mesh.h"
#include "load/gltf_parser.h"

namespace limpid {

/// Walks the nodes of the default scene and puts what hangs on them into `model`: meshes with their
/// instances, the first camera, the first directional light. A node of scale 0 hides what is below
/// it; its triangles count as skipped. Throws Error for other matrices without an inverse.
void read_gltf_scene(const tinygltf::Model& gltf, const std::vector<GltfMaterial>& materials,
                     MemoryBudget& budget, Model& model);

}  // namespace limpid
