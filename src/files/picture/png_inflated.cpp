#include "files/picture/png_inflated.h"

#include <array>
#include <cstddef>
#include <new>

#include <zlib.h>

#include "limpid/core/error.h"

namespace limpid {
namespace {

std::size_t number_at(std::string_view bytes, std::size_t at) {
  std::size_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

/// Counts what a zlib stream that comes in pieces inflates to, and keeps none of it.
class Inflated {
 public:
  Inflated() {
    if (inflateInit(&stream_) != Z_OK) throw std::bad_alloc();
  }
  ~Inflated() { inflateEnd(&stream_); }
  Inflated(const Inflated&) = delete;
  Inflated& operator=(const Inflated&) = delete;

  /// Until there are more than `most`.
  void take(std::string_view piece, std::int64_t most) {
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(piece.data()));
    stream_.avail_in = static_cast<uInt>(piece.size());
    while (good() && !ended_ && count_ <= most) {
      std::array<Bytef, 16384> scratch;
      stream_.next_out = scratch.data();
      stream_.avail_out = scratch.size();
      const int result = inflate(&stream_, Z_NO_FLUSH);
      if (result == Z_MEM_ERROR) throw std::bad_alloc();
      const std::size_t made = scratch.size() - stream_.avail_out;
      count_ += static_cast<std::int64_t>(made);
      ended_ = result == Z_STREAM_END;
      failed_ = result != Z_OK && result != Z_BUF_ERROR && !ended_;
      if (made == 0 && stream_.avail_in == 0) return;
    }
  }

  bool good() const { return !failed_; }
  std::int64_t count() const { return count_; }

 private:
  z_stream stream_{};
  bool failed_ = false, ended_ = false;
  std::int64_t count_ = 0;
};

}  // namespace

void check_inflated(std::string_view png, std::int64_t most, const std::string& name) {
  constexpr std::size_t kSignature = 8, kAroundData = 12;
  Inflated inflated;
  bool first = true;
  for (std::size_t at = kSignature; at + kAroundData <= png.size();) {
    const std::size_t length = number_at(png, at);
    const std::string_view type = png.substr(at + 4, 4);
    if (first && type != "IHDR") throw Error(name + ": expected a PNG that begins with its header");
    first = false;
    if (type == "IEND" || length > png.size() - at - kAroundData) break;
    if (type == "IDAT") inflated.take(png.substr(at + 8, length), most);
    if (!inflated.good()) throw Error(name + ": is damaged: its pixels cannot be decompressed");
    if (inflated.count() > most) {
      throw Error(name + ": is damaged: its pixels decompress to more than the " +
                  std::to_string(most) + " bytes that its size allows");
    }
    at += length + kAroundData;
  }
}

}  // namespace limpid
