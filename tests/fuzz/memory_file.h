#pragma once
#include <filesystem>

#include "fuzz/harness.h"

namespace limpid::fuzz {

/// A file without a disk, for readers that want a path.
class MemoryFile {
 public:
  MemoryFile();
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  /// What is in it from now on.
  void hold(Bytes bytes);
  const std::filesystem::path& path() const { return path_; }

 private:
  int descriptor_;
  std::filesystem::path path_;
};

}  // namespace limpid::fuzz
