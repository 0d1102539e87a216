#pragma once
#include <filesystem>

#include "fuzz/harness.h"

namespace limpid::fuzz {

/// A file in memory, for readers that need a path.
class MemoryFile {
 public:
  MemoryFile();
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  /// Replaces the content of the file.
  void hold(Bytes bytes);
  const std::filesystem::path& path() const { return path_; }

 private:
  int descriptor_;
  std::filesystem::path path_;
};

}  // namespace limpid::fuzz
