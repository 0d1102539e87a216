#include "files/exr/exr_input_stream.h"

#include <algorithm>
#include <cstring>

#include <OpenEXR/Iex.h>

namespace limpid {
namespace {
constexpr std::size_t kBufferBytes = 16384;
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

}  // namespace limpid
