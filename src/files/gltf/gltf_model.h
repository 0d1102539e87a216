#pragma once
#include <filesystem>

#include "limpid/files/gltf/gltf.h"
#include "limpid/files/limits.h"
#include "limpid/raster/model.h"

#include "files/gltf/gltf_files.h"

namespace limpid {

/// The model that load_gltf() returns for a file; `folder` is the file's folder. Throws Error
/// without the name of the file.
Model gltf_model(const GltfFile& file, const std::filesystem::path& folder, const Limits& limits,
                 Undrawable undrawable = Undrawable::kRefuse);

}  // namespace limpid
