#pragma once
#include <cstdint>
#include <optional>

#include "limpid/load/limits.h"

#include "load/json_place.h"

/// What a glTF document must be before anything is read by it: every index, size, type and uri
/// holds. tinygltf checks few of them and drops what it does not understand. What only the bytes of
/// the buffers can tell (index values, NaN) is checked where they are read, and so are materials.

namespace limpid {

/// `binary_bytes` is the size of a .glb's binary chunk. Throws Error as load_gltf() says.
void check_gltf(const JsonPlace& root, std::optional<std::int64_t> binary_bytes,
                const Limits& limits);

// Its parts, a file each.
void check_gltf_buffers(const JsonPlace& root, std::optional<std::int64_t> binary_bytes,
                        const Limits& limits);
void check_gltf_meshes(const JsonPlace& root);
void check_gltf_nodes(const JsonPlace& root);

}  // namespace limpid
