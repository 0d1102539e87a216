#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "files/file_handle.h"

namespace limpid {

/// The text attribute in which an EXR of ours has the hash of its own bytes. Not "limpid/...":
/// those say how a file was made, this one whether it is as it was made.
inline constexpr std::string_view kFileHashName = "limpid_file_hash";
/// What stands there until the hash is known, and counts for it in the hash.
inline constexpr std::string_view kNoFileHash = "00000000000000000000000000000000";

struct FileHash {
  std::uint64_t place = 0;  ///< where in the file the text begins
  std::string said;         ///< the text
  std::string found;        ///< the hash (content_hash.h) of all bytes, kNoFileHash for the text
};

/// Reads the file whole, whose header ends at `header_end`. Nothing where it has no such attribute.
/// Throws Error when the system cannot read.
std::optional<FileHash> file_hash(const FileHandle& file, std::uint64_t header_end);

}  // namespace limpid
