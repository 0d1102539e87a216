#pragma once
#include <compare>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace limpid {

/// The file that a path means: the target of its symbolic links, existing or not, or the path
/// itself if it is no link. Throws Error that begins with the path if the system does not follow
/// it: links in a circle, or a link of another user in a folder writable for all.
std::filesystem::path followed(const std::filesystem::path& path);

/// Identifies files independently of their names: device and inode of an existing file; else those
/// of its folder, and its name.
struct FileIdentity {
  std::uint64_t device = 0, inode = 0;
  std::string name;  ///< "" for an existing file

  auto operator<=>(const FileIdentity&) const = default;
};

struct FileIdentityHash {
  std::size_t operator()(const FileIdentity& identity) const;
};

/// At most three system calls, except for links and for a file in a missing folder, which is
/// identified by its absolute path. Throws nothing.
FileIdentity identity_of(const std::filesystem::path& path);

}  // namespace limpid
