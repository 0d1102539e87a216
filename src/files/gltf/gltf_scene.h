#pragma once
#include <string>
#include <vector>

#include "limpid/files/gltf/gltf.h"
#include "limpid/raster/model.h"

#include "files/gltf/gltf_accessors.h"
#include "files/gltf/gltf_check.h"
#include "files/gltf/gltf_material.h"
#include "files/gltf/memory_budget.h"
#include "files/gltf/model_warnings.h"
#include "files/text/json_place.h"

namespace limpid {

/// A checked document and the objects read from it.
struct GltfDocument {
  const JsonPlace& root;
  const GltfFaults& faults;
  const GltfAccessors& accessors;
  const std::vector<GltfMaterial>& materials;
};

/// Walks the nodes of the default scene and adds their objects to `model`: meshes with their
/// instances, the first camera, the first directional light. A node of scale 0 hides its subtree,
/// whose triangles count as skipped. Throws Error for other matrices without an inverse, and for an
/// object of a node that cannot be read; with Undrawable::kLeaveOut warns of such nodes.
void read_gltf_scene(const GltfDocument& document, Undrawable undrawable, MemoryBudget& budget,
                     ModelWarnings& warnings, Model& model);

}  // namespace limpid
