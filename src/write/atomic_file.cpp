#include "write/atomic_file.h"

#include <cerrno>
#include <string>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "load/file_stream.h"

namespace limpid {
namespace {

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
  for (int attempt = 0;; ++attempt) {
    temporary_ = folder / (".limpid-" + std::to_string(::getpid()) + "-" + std::to_string(attempt) +
                           path_.extension().string());
    const int descriptor =
        ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) {
      ::close(descriptor);
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
  if (!committed_) ::unlink(temporary_.c_str());
}

void AtomicFile::commit() {
  int error = flush_to_disk(temporary_, O_RDONLY);
  if (error == 0 && ::rename(temporary_.c_str(), path_.c_str()) != 0) error = errno;
  if (error != 0) {
    throw Error(path_.string() + ": cannot be written (" + describe(error) + ")", fault_of(error));
  }
  committed_ = true;
  // The new name is in force; a file system that cannot flush folders is no reason to fail.
  flush_to_disk(folder_of(path_), O_RDONLY | O_DIRECTORY);
}

}  // namespace limpid
