#include "files/file_stream.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <system_error>

#include <OpenEXR/Iex.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace limpid {
namespace {
constexpr std::size_t kBufferBytes = 16384;
}

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

FileStream::FileStream(std::shared_ptr<const FileHandle> file)
    : Imf::IStream(file->path().c_str()), file_(std::move(file)) {}

bool FileStream::read(char into[], int bytes) {
  const std::uint64_t wanted = static_cast<std::uint64_t>(std::max(bytes, 0));
  if (position_ > file_->size() || wanted > file_->size() - position_) {
    throw Iex::InputExc("unexpected end of file");
  }
  std::uint64_t done = 0;
  while (done < wanted) {
    const bool buffered = position_ >= buffer_begin_ && position_ < buffer_begin_ + buffer_.size();
    if (buffered) {
      const std::uint64_t skip = position_ - buffer_begin_;
      const std::uint64_t count = std::min(wanted - done, buffer_.size() - skip);
      std::memcpy(into + done, buffer_.data() + skip, count);
      position_ += count;
      done += count;
    } else if (wanted - done >= kBufferBytes) {
      const std::size_t got = file_->read(into + done, wanted - done, position_);
      if (got < wanted - done) throw Iex::InputExc("unexpected end of file");
      position_ += got;
      done += got;
    } else {
      buffer_.resize(kBufferBytes);
      buffer_.resize(file_->read(buffer_.data(), kBufferBytes, position_));
      buffer_begin_ = position_;
      if (buffer_.empty()) throw Iex::InputExc("unexpected end of file");
    }
  }
  return position_ < file_->size();
}

std::uint64_t read_number(FileStream& stream, int bytes) {
  char memory[8];
  stream.read(memory, bytes);
  std::uint64_t number = 0;
  for (int i = bytes; i-- > 0;) number = number << 8 | static_cast<unsigned char>(memory[i]);
  return number;
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
