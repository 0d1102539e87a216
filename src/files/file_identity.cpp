#include "files/file_identity.h"

#include <cerrno>
#include <functional>
#include <string_view>
#include <utility>

#include <sys/stat.h>

#include "limpid/core/error.h"

#include "files/file_handle.h"

namespace limpid {
namespace {

namespace fs = std::filesystem;

bool is_link(const fs::path& path) {
  std::error_code ignored;
  return fs::is_symlink(fs::symlink_status(path, ignored));
}

/// The target of a chain of links, existing or not.
fs::path end_of_links(fs::path path) {
  constexpr int kMaxLinks = 40;  // the system's own limit
  for (int i = 0; i < kMaxLinks && is_link(path); ++i) {
    std::error_code failed;
    const fs::path next = fs::read_symlink(path, failed);
    if (failed) break;
    path = path.parent_path() / next;
  }
  return path;
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

bool same(const struct stat& a, const struct stat& b) {
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

}  // namespace

fs::path followed(const fs::path& path) {
  if (!is_link(path)) return path;
  const auto refuse = [&](int cause) {
    throw Error(path.string() + ": is a link that cannot be followed (" + describe(cause) + ")",
                fault_of(cause));
  };
  const fs::path end = end_of_links(path);
  struct stat by_system {
  }, by_name{};
  if (::stat(path.c_str(), &by_system) != 0) {
    if (errno != ENOENT) refuse(errno);
    return end;
  }
  // The links of /proc may name deleted files.
  if (::stat(end.c_str(), &by_name) != 0 || !same(by_system, by_name)) refuse(ENOENT);
  return end;
}

std::size_t FileIdentityHash::operator()(const FileIdentity& identity) const {
  const std::size_t place = identity.inode * 0x9E3779B97F4A7C15u + identity.device;
  return place ^ (std::hash<std::string_view>()(identity.name) << 1);
}

FileIdentity identity_of(const fs::path& path) {
  const auto identity = [](const struct stat& status, std::string name) {
    return FileIdentity{std::uint64_t{status.st_dev}, std::uint64_t{status.st_ino},
                        std::move(name)};
  };
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0) return identity(status, "");
  const fs::path end = end_of_links(path);
  if (::stat(folder_of(end).c_str(), &status) == 0) return identity(status, end.filename());
  std::error_code ignored;
  return {0, 0, fs::absolute(end, ignored).lexically_normal()};
}

}  // namespace limpid
