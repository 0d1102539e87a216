#pragma once
#include <filesystem>

#include "limpid/core/error.h"

namespace limpid {

/// A file that appears whole or not at all. It is written under a temporary name in the same folder
/// and with the same extension; commit() flushes it to disk and renames it. Without commit() the
/// temporary file is removed and what was under `path` before stays. Where `path` is a symbolic
/// link, all that is about the file it leads to, there or not, and the link stays. While it exists
/// it is locked, so that others can tell it from what a killed process has left
/// (files/unfinished.h); the first of a process in a folder removes what lies there of those.
/// Neither on a file system that is not known to be of this machine (local_files.h).
class AtomicFile {
 public:
  /// Creates the empty temporary file. Throws Error that names the folder when that fails, and when
  /// `path` is something else than a file, or a link that the system does not follow.
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& temporary() const { return temporary_; }
  /// Call it when the temporary file is written and closed. Throws Error.
  void commit();

 private:
  std::filesystem::path path_, target_, temporary_;  ///< the second is what the first leads to
  int descriptor_ = -1;  ///< open while the file is temporary: it holds the lock, if there is one
};

}  // namespace limpid
