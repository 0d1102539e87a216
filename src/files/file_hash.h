#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "files/file_handle.h"

namespace limpid {

/// The text attribute in which limpid's EXR files have the hash of their own bytes. Not
/// "limpid/...": those attributes say how a file was made, this one whether it is unchanged.
inline constexpr std::string_view kFileHashName = "limpid_file_hash";
/// The placeholder until the hash is known, with which the hash is computed.
inline constexpr std::string_view kNoFileHash = "00000000000000000000000000000000";

struct FileHash {
  std::uint64_t place = 0;  ///< offset of the text in the file
  std::string said;         ///< the text in the file
  std::string found;        ///< the hash (content_hash.h) of all bytes, kNoFileHash for the text
};

/// Reads the whole file, whose header ends at `header_end`. Nothing if it has no such attribute.
/// Throws Error if the system cannot read.
std::optional<FileHash> file_hash(const FileHandle& file, std::uint64_t header_end);

}  // namespace limpid
