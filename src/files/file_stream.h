#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include <OpenEXR/ImfIO.h>

#include "limpid/core/error.h"

namespace limpid {

/// A file opened for reading, closed with the last stream on it.
class FileHandle {
 public:
  /// Throws Error that begins with the path.
  explicit FileHandle(const std::filesystem::path& path);
  ~FileHandle();
  FileHandle(const FileHandle&) = delete;
  FileHandle& operator=(const FileHandle&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::uint64_t size() const { return size_; }
  /// Reads up to `bytes` from `offset`; fewer at the end of the file only. Throws Error.
  std::size_t read(char* into, std::size_t bytes, std::uint64_t offset) const;

 private:
  std::filesystem::path path_;
  int descriptor_;
  std::uint64_t size_;
};

/// A position in such a file, buffered. Several streams may share one file.
class FileStream : public Imf::IStream {
 public:
  explicit FileStream(std::shared_ptr<const FileHandle> file);

  const FileHandle& file() const { return *file_; }
  std::uint64_t remaining() const { return file_->size() - position_; }

  /// Throws Iex::InputExc at the end of the file, Error when the system cannot read.
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

/// Whether a failed system call is worth another try (disk full, file-size limit, network file
/// gone) or not.
Fault fault_of(int system_error);

/// "no space left on device" for the number of a failed system call.
std::string describe(int system_error);

}  // namespace limpid
