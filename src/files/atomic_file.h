#pragma once
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "limpid/core/error.h"

namespace limpid {

/// A file that appears complete or not at all. It is written under a temporary name in the same
/// folder and with the same extension; commit() flushes it to disk and renames it. Without commit()
/// the temporary file is removed and the former file at `path` remains. If `path` is a symbolic
/// link, all this applies to its target, existing or not, and the link stays. While it exists it is
/// locked, which distinguishes it from leftover temporary files of killed processes
/// (files/unfinished.h); only on file systems known to be local (local_files.h).
class AtomicFile {
 public:
  /// Creates the empty temporary file. Throws Error that names the folder if that fails, and if
  /// `path` is not a file, or a link that the system does not follow.
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& temporary() const { return temporary_; }
  /// Adds bytes to the temporary file. Throws Error.
  void write(std::string_view bytes);
  /// Flushes the temporary file to disk, after the last write(). Throws Error.
  void flush();
  /// Flushes, and renames to the final name. Throws Error.
  void commit();

 private:
  std::filesystem::path path_, target_, temporary_;  ///< target_ is the end of the links of path_
  int descriptor_ = -1;  ///< open while the file is temporary: it holds the lock, if there is one
};

/// Files that appear together: if one cannot be written, the temporary files of all are removed.
/// Only if the system fails between two renamings may some of the files appear alone.
class AtomicFiles {
 public:
  /// Adds a file, which must be written and closed before commit(). Throws as AtomicFile.
  AtomicFile& add(const std::filesystem::path& path);
  /// Commits in the order of add(). Throws Error.
  void commit();

 private:
  std::vector<std::unique_ptr<AtomicFile>> files_;
};

/// Throws the Error with which an AtomicFile of this path would not begin, and changes nothing,
/// neither the folder's files nor its times. The disk may still be full at the time of writing.
void expect_replaceable(const std::filesystem::path& path);

/// Removes leftover temporary files of killed processes from the folder of a file
/// (remove_abandoned_files()), at the first call of this process for the folder; AtomicFiles::add()
/// calls it.
void tidy_folder_of(const std::filesystem::path& path);

}  // namespace limpid
