#pragma once
#include <cstdint>

#include "files/text/json_place.h"

/// The types of an accessor's numbers (glTF 2.0, 3.6.2.2 "Accessor Data Types").

namespace limpid {

constexpr std::int64_t kGltfByte = 5120, kGltfUbyte = 5121, kGltfShort = 5122, kGltfUshort = 5123,
                       kGltfUint = 5125, kGltfFloat = 5126;

/// Bytes of a component type, 0 for an unknown one.
std::int64_t gltf_component_size(std::int64_t component);

/// Bytes of an accessor's element. Throws Error for an unknown type.
std::int64_t gltf_element_size(const JsonPlace& accessor);

/// Whether an accessor's integers are fractions of the largest.
bool is_normalized(const JsonPlace& accessor);

}  // namespace limpid
