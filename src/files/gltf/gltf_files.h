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

/// A .gltf or .glb file, told apart by its first bytes.
struct GltfFile {
  nlohmann::json json;
  std::optional<std::string> binary;  ///< the binary chunk of a .glb
  std::int64_t memory = 0;            ///< bytes that it takes, read, at most
};

/// Throws Error for a file that cannot be read, is over the limits, or is neither JSON nor a whole
/// .glb of version 2.
GltfFile read_gltf_file(const std::filesystem::path& path, const Limits& limits);

/// The same of a file's bytes.
GltfFile split_gltf(std::string_view bytes, const Limits& limits);

/// Whether a uri holds its bytes itself.
bool is_data_uri(std::string_view uri);

/// The bytes that a data uri of base64 holds (RFC 4648 "The Base16, Base32, and Base64 Data
/// Encodings", section 4). Throws Error for other letters.
std::string bytes_of_data_uri(const JsonPlace& uri);

/// The file that a uri names, relative to the folder of the glTF file, percent-decoded. Throws
/// Error unless it is a plain relative path: no scheme, no "..", no backslash, not absolute.
std::filesystem::path relative_path_of(const JsonPlace& uri);

/// The bytes of a file in `folder`; at most `limit` of them, else throws Error. Throws Error for a
/// file that is missing, or that links lead out of the folder.
std::string read_file_in(const std::filesystem::path& folder, const std::filesystem::path& relative,
                         std::int64_t limit);

}  // namespace limpid
