#include "write/atomic_file.h"

#include <cerrno>
#include <mutex>
#include <set>
#include <string>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "limpid/write/unfinished.h"

#include "load/file_stream.h"

namespace limpid {
namespace {

/// The temporary files that exist. A temporary file comes and goes only under the lock.
struct Unfinished {
  std::mutex mutex;
  std::set<std::filesystem::path> files;

  /// Never destroyed: a signal may come while the process ends.
  static Unfinished& all() {
    static Unfinished& instance = *new Unfinished;
    return instance;
  }
};

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

/// 0, or the number of the error. `flags` as for open(2).
int flush_to_disk(const std::filesystem::path& path, int flags) {
  const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC);
  if (descriptor < 0) return errno;
  const int error = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  return error;
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path_, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    throw Error(path_.string() + ": is there and not a file, so it is not replaced");
  }
  const std::filesystem::path folder = folder_of(path_);
  const std::lock_guard lock(Unfinished::all().mutex);
  for (int attempt = 0;; ++attempt) {
    temporary_ = folder / (".limpid-" + std::to_string(::getpid()) + "-" + std::to_string(attempt) +
                           path_.extension().string());
    const int descriptor =
        ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) {
      ::close(descriptor);
      Unfinished::all().files.insert(temporary_);
      return;
    }
    if (errno != EEXIST) {
      throw Error(path_.string() + ": the folder '" + folder.string() + "' cannot be written to (" +
                      describe(errno) + ")",
                  fault_of(errno));
    }
  }
}

AtomicFile::~AtomicFile() {
  if (committed_) return;
  const std::lock_guard lock(Unfinished::all().mutex);
  ::unlink(temporary_.c_str());
  Unfinished::all().files.erase(temporary_);
}

void AtomicFile::commit() {
  int error = flush_to_disk(temporary_, O_RDONLY);
  if (error == 0) {
    const std::lock_guard lock(Unfinished::all().mutex);
    if (::rename(temporary_.c_str(), path_.c_str()) != 0) error = errno;
    if (error == 0) Unfinished::all().files.erase(temporary_);
  }
  if (error != 0) {
    throw Error(path_.string() + ": cannot be written (" + describe(error) + ")", fault_of(error));
  }
  committed_ = true;
  // The new name is in force; a file system that cannot flush folders is no reason to fail.
  flush_to_disk(folder_of(path_), O_RDONLY | O_DIRECTORY);
}

std::unique_lock<std::mutex> remove_unfinished_files() {
  std::unique_lock lock(Unfinished::all().mutex);
  for (const std::filesystem::path& file : Unfinished::all().files) ::unlink(file.c_str());
  return lock;
}

}  // namespace limpid
