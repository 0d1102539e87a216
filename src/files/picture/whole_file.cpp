#include "files/picture/whole_file.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <istream>
#include <streambuf>
#include <string>
#include <string_view>

#include "limpid/core/error.h"

namespace limpid {
namespace {

using namespace std::string_view_literals;

// The checksum of PNG chunks: ISO 15948:2003 "Portable Network Graphics", annex D.
class Crc {
 public:
  void add(std::string_view bytes) {
    for (const char byte : bytes) {
      state_ = kTable[(state_ ^ static_cast<unsigned char>(byte)) & 255] ^ (state_ >> 8);
    }
  }
  std::uint32_t value() const { return ~state_; }

 private:
  static constexpr std::array<std::uint32_t, 256> kTable = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      table[i] = i;
      for (int bit = 0; bit < 8; ++bit) {
        table[i] = (table[i] & 1) != 0 ? 0xEDB88320u ^ (table[i] >> 1) : table[i] >> 1;
      }
    }
    return table;
  }();
  std::uint32_t state_ = ~0u;
};

class WholeFile {
 public:
  WholeFile(std::istream& in, std::string name) : in_(in), name_(std::move(name)) {}

  void check() {
    const std::string start(next(24));
    if (start.starts_with("\x89PNG\r\n\x1a\n"sv)) return check_png();
    if (start.starts_with("\xFF\xD8\xFF"sv)) return check_jpeg();
    if (start.size() < 24) return;
    std::string size = start.substr(16, 4);
    if (start.starts_with("SDPX")) return check_size(big_endian(size));
    std::reverse(size.begin(), size.end());
    if (start.starts_with("XPDS")) return check_size(big_endian(size));
  }

 private:
  // Up to `count` bytes, fewer where the file ends. Valid until the next call.
  std::string_view next(std::size_t count) {
    count = std::min(count, buffer_.size());
    in_.read(buffer_.data(), static_cast<std::streamsize>(count));
    return {buffer_.data(), static_cast<std::size_t>(in_.gcount())};
  }

  [[noreturn]] void refuse(const std::string& phrase) const { throw Error(name_ + ": " + phrase); }

  std::string_view exactly(std::size_t count) {
    const std::string_view bytes = next(count);
    if (bytes.size() < count) refuse("ends too early: expected the rest of its pixels");
    return bytes;
  }

  static std::uint32_t big_endian(std::string_view bytes) {
    std::uint32_t value = 0;
    for (const char byte : bytes.substr(0, 4))
      value = value << 8 | static_cast<unsigned char>(byte);
    return value;
  }

  // Chunks of a length, a name, data and a checksum follow the signature, the last is IEND.
  void check_png() {
    in_.seekg(8);
    for (std::string name; name != "IEND";) {
      const std::string head(exactly(8));
      name = head.substr(4);
      Crc crc;
      crc.add(name);
      for (std::size_t left = big_endian(head); left > 0;) {
        const std::string_view data = exactly(std::min(left, buffer_.size()));
        crc.add(data);
        left -= data.size();
      }
      if (big_endian(exactly(4)) != crc.value())
        refuse("is damaged: wrong checksum of a chunk " + name);
    }
  }

  // Inside a scan's data neither marker can occur, and a thumbnail comes before the picture: a
  // whole file has an end of image (FF D9) behind its last start of scan (FF DA).
  void check_jpeg() {
    in_.clear();
    in_.seekg(0);
    bool ended = false, marker = false;
    for (std::string_view bytes = next(buffer_.size()); !bytes.empty();
         bytes = next(buffer_.size())) {
      for (const char byte : bytes) {
        if (marker && byte == '\xDA') ended = false;
        if (marker && byte == '\xD9') ended = true;
        marker = byte == '\xFF';
      }
    }
    if (!ended) refuse("ends too early: expected the rest of its pixels");
  }

  // 0 and all bits set mean that the writer did not say.
  void check_size(std::uint32_t expected) {
    in_.clear();
    const std::streamoff size = in_.seekg(0, std::ios::end).tellg();
    if (expected == ~0u || size >= expected) return;
    refuse("ends after " + std::to_string(size) + " bytes: expected " + std::to_string(expected));
  }

  std::istream& in_;
  std::string name_;
  std::array<char, 1 << 16> buffer_;
};

// Lets a stream read bytes where they are; positions as check_jpeg() and check_size() need them.
class Bytes : public std::streambuf {
 public:
  explicit Bytes(std::string_view bytes) {
    char* begin = const_cast<char*>(bytes.data());  // a get area is never written to
    setg(begin, begin, begin + bytes.size());
  }

 private:
  pos_type seekoff(off_type offset, std::ios::seekdir from, std::ios::openmode) override {
    char* base = from == std::ios::beg ? eback() : from == std::ios::end ? egptr() : gptr();
    setg(eback(), base + offset, egptr());
    return gptr() - eback();
  }
  pos_type seekpos(pos_type position, std::ios::openmode which) override {
    return seekoff(position, std::ios::beg, which);
  }
};

}  // namespace

void check_whole(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  WholeFile(in, path.string()).check();
}

void check_whole(std::string_view bytes, const std::string& name) {
  Bytes buffer(bytes);
  std::istream in(&buffer);
  WholeFile(in, name).check();
}

}  // namespace limpid
