#pragma once
#include <compare>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace limpid {

/// The file that a path means: what its symbolic links lead to, whether that is there or not; the
/// path itself where it is no link. Throws Error that begins with the path where the system does
/// not follow it: links in a circle, or a link of another user in a folder that all may write to.
std::filesystem::path followed(const std::filesystem::path& path);

/// What tells files apart, whatever their names: device and inode of a file that is there; of one
/// that is not, those of its folder, and its name.
struct FileIdentity {
  std::uint64_t device = 0, inode = 0;
  std::string name;  ///< "" for a file that is there

  auto operator<=>(const FileIdentity&) const = default;
};

struct FileIdentityHash {
  std::size_t operator()(const FileIdentity& identity) const;
};

/// Three system calls at most, but for links and for a file in a folder that is not there: that one
/// is known by its absolute path. Throws nothing.
FileIdentity identity_of(const std::filesystem::path& path);

}  // namespace limpid
