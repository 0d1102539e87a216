#include "files/atomic_file.h"

#include <algorithm>
#include <cerrno>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "limpid/files/unfinished.h"

#include "files/file_handle.h"
#include "files/file_identity.h"
#include "files/local_files.h"

namespace limpid {
namespace {

/// The existing temporary files. A temporary file is made and removed only under the lock.
struct Unfinished {
  std::mutex mutex;
  std::set<std::filesystem::path> files;
  std::set<std::filesystem::path> tidied;  ///< folders

  /// Never destroyed: a signal may arrive while the process ends.
  static Unfinished& all() {
    static Unfinished& instance = *new Unfinished;
    return instance;
  }
};

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

constexpr std::string_view kBegin = ".limpid-";

/// The name of a temporary file: kBegin, the process, a dash, a number, the extension.
std::string temporary_name(int number, const std::string& extension) {
  return std::string(kBegin) + std::to_string(::getpid()) + "-" + std::to_string(number) +
         extension;
}

bool is_temporary_name(std::string_view name) {
  if (!name.starts_with(kBegin)) return false;
  name.remove_prefix(kBegin.size());
  const auto skip_number = [&] {
    const std::size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
    name.remove_prefix(digits);
    return digits > 0;
  };
  if (!skip_number() || !name.starts_with('-')) return false;
  name.remove_prefix(1);
  return skip_number() && (name.empty() || name.front() == '.');
}

/// Locks a new file. False if another process has removed it before: that process had the lock, or
/// the file has lost its name. Where no process removes abandoned files no lock is needed.
bool locked(int descriptor) {
  if (!is_local(descriptor)) return true;
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) return errno != EWOULDBLOCK;
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 && status.st_nlink > 0;
}

/// Removes the file unless it is locked. A process that gets the lock while the file still has this
/// name knows that its maker has ended, or will find it removed in locked().
void remove_if_abandoned(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return;
  struct stat open_file {
  }, named{};
  const bool abandoned = is_local(descriptor) && ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 &&
                         ::fstat(descriptor, &open_file) == 0 && S_ISREG(open_file.st_mode) &&
                         ::lstat(path.c_str(), &named) == 0 && open_file.st_dev == named.st_dev &&
                         open_file.st_ino == named.st_ino;
  if (abandoned) ::unlink(path.c_str());
  ::close(descriptor);
}

/// A file system that cannot flush folders is no error.
void flush_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

/// The target of `path`, a file or nothing.
std::filesystem::path target_of(const std::filesystem::path& path) {
  std::filesystem::path target = followed(path);
  std::error_code ignored;
  const auto status = std::filesystem::status(target, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    throw Error(path.string() + ": exists and is not a file: expected a file to replace, or none");
  }
  return target;
}

Error not_writable(const std::filesystem::path& path, const std::filesystem::path& folder,
                   int system_error) {
  return Error(path.string() + ": the folder '" + folder.string() + "' cannot be written to (" +
                   describe(system_error) + ")",
               fault_of(system_error));
}

Error not_written(const std::filesystem::path& path, int system_error) {
  return Error(path.string() + ": cannot be written (" + describe(system_error) + ")",
               fault_of(system_error));
}

/// The error with which creating a file in the folder would fail, or 0. A file without a name
/// (open(2), O_TMPFILE) tests this without a trace; where the file system has none, the folder's
/// permissions do.
int error_of_new_file(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
  if (descriptor >= 0) {
    ::close(descriptor);
    return 0;
  }
  if (errno != EOPNOTSUPP && errno != EISDIR) return errno;
  return ::faccessat(AT_FDCWD, (folder / ".").c_str(), W_OK | X_OK, AT_EACCESS) == 0 ? 0 : errno;
}

}  // namespace

void expect_replaceable(const std::filesystem::path& path) {
  const std::filesystem::path folder = folder_of(target_of(path));
  if (const int error = error_of_new_file(folder)) throw not_writable(path, folder, error);
}

void tidy_folder_of(const std::filesystem::path& path) {
  const std::filesystem::path folder = folder_of(followed(path));
  std::error_code ignored;
  Unfinished& unfinished = Unfinished::all();
  const std::lock_guard lock(unfinished.mutex);
  if (unfinished.tidied.insert(std::filesystem::absolute(folder, ignored)).second) {
    remove_abandoned_files(folder);
  }
}

AtomicFile::AtomicFile(std::filesystem::path path)
    : path_(std::move(path)), target_(target_of(path_)) {
  const std::filesystem::path folder = folder_of(target_);
  Unfinished& unfinished = Unfinished::all();
  const std::lock_guard lock(unfinished.mutex);
  for (int attempt = 0;; ++attempt) {
    temporary_ = folder / temporary_name(attempt, target_.extension().string());
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ >= 0 && locked(descriptor_)) {
      unfinished.files.insert(temporary_);
      return;
    }
    if (descriptor_ >= 0) {
      ::close(descriptor_);
    } else if (errno != EEXIST) {
      throw not_writable(path_, folder, errno);
    }
  }
}

AtomicFile::~AtomicFile() {
  if (descriptor_ < 0) return;
  const std::lock_guard lock(Unfinished::all().mutex);
  ::unlink(temporary_.c_str());
  Unfinished::all().files.erase(temporary_);
  ::close(descriptor_);
}

void AtomicFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw not_written(path_, errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void AtomicFile::flush() {
  if (::fsync(descriptor_) != 0) throw not_written(path_, errno);
}

void AtomicFile::commit() {
  flush();
  {
    const std::lock_guard lock(Unfinished::all().mutex);
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) throw not_written(path_, errno);
    Unfinished::all().files.erase(temporary_);
  }
  ::close(std::exchange(descriptor_, -1));
  flush_folder(folder_of(target_));
}

AtomicFile& AtomicFiles::add(const std::filesystem::path& path) {
  tidy_folder_of(path);
  return *files_.emplace_back(std::make_unique<AtomicFile>(path));
}

void AtomicFiles::commit() {
  for (const auto& file : files_) file->flush();
  for (const auto& file : files_) file->commit();
  files_.clear();
}

std::unique_lock<std::mutex> remove_unfinished_files() {
  std::unique_lock lock(Unfinished::all().mutex);
  for (const std::filesystem::path& file : Unfinished::all().files) ::unlink(file.c_str());
  return lock;
}

void remove_abandoned_files(const std::filesystem::path& folder) {
  std::error_code none;
  std::filesystem::directory_iterator entry(folder, none);
  while (!none && entry != std::filesystem::directory_iterator()) {
    if (is_temporary_name(entry->path().filename().native())) remove_if_abandoned(entry->path());
    entry.increment(none);
  }
}

}  // namespace limpid
