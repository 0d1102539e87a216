#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "limpid/core/error.h"

namespace limpid {

/// A file opened for reading.
class FileHandle {
 public:
  /// Throws Error that begins with the path.
  explicit FileHandle(const std::filesystem::path& path);
  ~FileHandle();
  FileHandle(const FileHandle&) = delete;
  FileHandle& operator=(const FileHandle&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::uint64_t size() const { return size_; }
  /// Reads up to `bytes` from `offset`; fewer at the end of the file only. Throws Error.
  std::size_t read(char* into, std::size_t bytes, std::uint64_t offset) const;
  /// The whole content. Throws Error for more than `most` bytes.
  std::string all(std::int64_t most) const;

 private:
  std::filesystem::path path_;
  int descriptor_;
  std::uint64_t size_;
};

/// Whether retrying after a failed system call may help (disk full, file-size limit, network file
/// gone).
Fault fault_of(int system_error);

/// "no space left on device" for the number of a failed system call.
std::string describe(int system_error);

}  // namespace limpid
