#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include <OpenEXR/ImfIO.h>

#include "files/file_handle.h"

namespace limpid {

/// A buffered position in a file, for OpenEXR and for limpid's own readers of EXR. Several streams
/// may share one file, which is closed with the last of them.
class FileStream : public Imf::IStream {
 public:
  explicit FileStream(std::shared_ptr<const FileHandle> file);

  const FileHandle& file() const { return *file_; }
  std::uint64_t remaining() const { return file_->size() - position_; }

  /// Throws Iex::InputExc at the end of the file, Error if the system cannot read.
  bool read(char into[], int bytes) override;
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = position; }

 private:
  std::shared_ptr<const FileHandle> file_;
  std::uint64_t position_ = 0;
  std::uint64_t buffer_begin_ = 0;
  std::vector<char> buffer_;
};

/// The next 1 to 8 bytes as a little-endian number. Throws as FileStream::read.
std::uint64_t read_number(FileStream& stream, int bytes);

}  // namespace limpid
