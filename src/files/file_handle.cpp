#include "files/file_handle.h"

#include <cctype>
#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace limpid {

FileHandle::FileHandle(const std::filesystem::path& path)
    : path_(path), descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
  struct stat status {};
  if (descriptor_ < 0 || ::fstat(descriptor_, &status) != 0) {
    const int error = errno;
    if (descriptor_ >= 0) ::close(descriptor_);
    throw Error(path.string() + ": cannot be opened (" + describe(error) + ")", fault_of(error));
  }
  if (!S_ISREG(status.st_mode)) {
    ::close(descriptor_);
    throw Error(path.string() + ": is not a file");
  }
  size_ = static_cast<std::uint64_t>(status.st_size);
}

FileHandle::~FileHandle() { ::close(descriptor_); }

std::size_t FileHandle::read(char* into, std::size_t bytes, std::uint64_t offset) const {
  std::size_t done = 0;
  while (done < bytes && offset + done < size_) {
    const ssize_t got =
        ::pread(descriptor_, into + done, bytes - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) {
      throw Error(path_.string() + ": cannot be read (" + describe(errno) + ")", fault_of(errno));
    }
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

std::string FileHandle::all(std::int64_t most) const {
  if (size_ > static_cast<std::uint64_t>(most)) {
    throw Error(path_.string() + ": has " + std::to_string(size_) + " bytes: expected at most " +
                std::to_string(most));
  }
  std::string bytes(size_, '\0');
  bytes.resize(read(bytes.data(), bytes.size(), 0));
  return bytes;
}

Fault fault_of(int system_error) {
  switch (system_error) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
    case EIO:
    case ESTALE:
    case ETIMEDOUT:
    case EMFILE:
    case ENFILE:
      return Fault::kRetry;
    default:
      return Fault::kJob;
  }
}

std::string describe(int system_error) {
  std::string text = std::generic_category().message(system_error);
  if (!text.empty()) text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

}  // namespace limpid
