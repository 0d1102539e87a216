#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "limpid/files/limits.h"

#include "files/text/json_place.h"

namespace limpid {

/// A .gltf or .glb file, distinguished by its first bytes.
struct GltfFile {
  nlohmann::json json;
  std::optional<std::string> binary;  ///< the binary chunk of a .glb
  std::int64_t memory = 0;            ///< upper bound on the memory of the parsed file
};

/// Throws Error for a file that cannot be read, exceeds the limits, or is neither JSON nor a
/// complete .glb of version 2.
GltfFile read_gltf_file(const std::filesystem::path& path, const Limits& limits);

/// The same for a file's bytes.
GltfFile split_gltf(std::string_view bytes, const Limits& limits);

/// Whether a uri contains its data.
bool is_data_uri(std::string_view uri);

/// The bytes that a data uri of base64 holds (RFC 4648 "The Base16, Base32, and Base64 Data
/// Encodings", section 4). Throws Error for other letters.
std::string bytes_of_data_uri(const JsonPlace& uri);

/// The file of a uri, relative to the folder of the glTF file, percent-decoded. Throws Error unless
/// it is a plain relative path: no scheme, no "..", no backslash, not absolute.
std::filesystem::path relative_path_of(const JsonPlace& uri);

/// The bytes of a file in `folder`; throws Error for more than `limit`, for a missing file, and for
/// links that lead out of the folder.
std::string read_file_in(const std::filesystem::path& folder, const std::filesystem::path& relative,
                         std::int64_t limit);

}  // namespace limpid
