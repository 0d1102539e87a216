#pragma once
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "limpid/core/error.h"

namespace limpid {

/// A file that appears whole or not at all. It is written under a temporary name in the same folder
/// and with the same extension; commit() flushes it to disk and renames it. Without commit() the
/// temporary file is removed and what was under `path` before stays. Where `path` is a symbolic
/// link, all that is about the file it leads to, there or not, and the link stays. While it exists
/// it is locked, so that others can tell it from what a killed process has left
/// (files/unfinished.h), but for a file system that is not known to be of this machine
/// (local_files.h).
class AtomicFile {
 public:
  /// Creates the empty temporary file. Throws Error that names the folder when that fails, and when
  /// `path` is something else than a file, or a link that the system does not follow.
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& temporary() const { return temporary_; }
  /// Adds bytes to the temporary file. Throws Error.
  void write(std::string_view bytes);
  /// Call it when the temporary file is written: its bytes are on the disk. Throws Error.
  void flush();
  /// The same, and it gets its name. Throws Error.
  void commit();

 private:
  std::filesystem::path path_, target_, temporary_;  ///< the second is what the first leads to
  int descriptor_ = -1;  ///< open while the file is temporary: it holds the lock, if there is one
};

/// Files that appear together: what is not committed, because one of them could not be written, is
/// removed with all of them. Only where the system fails between two of their renamings may a part
/// of them be there.
class AtomicFiles {
 public:
  /// One more, which commit() is to find written and closed. Throws as AtomicFile.
  AtomicFile& add(const std::filesystem::path& path);
  /// In the order in which they were added. Throws Error.
  void commit();

 private:
  std::vector<std::unique_ptr<AtomicFile>> files_;
};

/// Throws the Error with which an AtomicFile of this path would not begin, and changes nothing:
/// neither what is in the folder nor its times. The disk may be full by the time of writing.
void expect_replaceable(const std::filesystem::path& path);

/// Removes what killed processes have left in the folder of a file (remove_abandoned_files()), at
/// the first call of this process for the folder; AtomicFiles::add() does.
void tidy_folder_of(const std::filesystem::path& path);

}  // namespace limpid
