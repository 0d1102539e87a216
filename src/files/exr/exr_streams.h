#pragma once
#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <utility>
#include <vector>

#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfIO.h>

namespace limpid {

/// The temporary file. Keeps the first error, because OpenEXR swallows those of its destructor.
class OutputStream : public Imf::OStream {
 public:
  enum Mode { kNew, kChange };  ///< empty at first, or with its content

  explicit OutputStream(const std::filesystem::path& path, Mode mode = kNew)
      : Imf::OStream(path.c_str()), file_(std::fopen(path.c_str(), mode == kNew ? "wb" : "r+b")) {
    if (file_ == nullptr) error_ = errno;
  }
  ~OutputStream() override {
    if (file_ != nullptr) std::fclose(file_);
  }

  void write(const char bytes[], int count) override {
    const std::size_t size = static_cast<std::size_t>(count);
    check(file_ != nullptr && std::fwrite(bytes, 1, size, file_) == size);
  }
  std::uint64_t tellp() override {
    return file_ == nullptr ? 0 : static_cast<std::uint64_t>(ftello(file_));
  }
  void seekp(std::uint64_t position) override {
    check(file_ != nullptr && fseeko(file_, static_cast<off_t>(position), SEEK_SET) == 0);
  }
  void close() {
    if (file_ == nullptr) return;
    const bool closed = std::fclose(std::exchange(file_, nullptr)) == 0;
    if (!closed && error_ == 0) error_ = errno;
  }
  /// Error number of the first failed system call, 0 if none failed.
  int error() const { return error_; }

 private:
  void check(bool done) {
    if (done) return;
    if (error_ == 0) error_ = errno;
    throw Iex::IoExc("cannot be written");
  }

  std::FILE* file_;
  int error_ = 0;
};

/// The bytes of one attribute, for OpenEXR to read.
class BytesStream : public Imf::IStream {
 public:
  explicit BytesStream(const std::vector<char>& bytes) : Imf::IStream("attribute"), bytes_(bytes) {}
  bool read(char into[], int count) override {
    if (static_cast<std::size_t>(count) > bytes_.size() - position_) {
      throw Iex::InputExc("it is too short");
    }
    std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(position_), count, into);
    position_ += static_cast<std::size_t>(count);
    return position_ < bytes_.size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = position; }

 private:
  const std::vector<char>& bytes_;
  std::size_t position_ = 0;
};

}  // namespace limpid
