#pragma once
#include <filesystem>

#include "limpid/load/limits.h"

#include "load/gltf_files.h"
#include "load/gltf_parser.h"

namespace limpid {

/// Lets tinygltf read a checked document. It is given the bytes of all buffers and opens no file
/// itself; images keep their encoded bytes, or their uri where they lie in a file. Throws Error for
/// a buffer whose file is missing, too short or outside of `folder`, and for what tinygltf refuses.
tinygltf::Model parse_gltf(const GltfFile& file, const std::filesystem::path& folder,
                           const Limits& limits);

}  // namespace limpid
