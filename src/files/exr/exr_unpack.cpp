#include "files/exr/exr_unpack.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <new>
#include <span>
#include <utility>

#include <OpenEXR/ImfHuf.h>
#include <OpenEXR/ImfWav.h>
#include <zlib.h>

namespace limpid {
namespace {

enum Compression { kNone = 0, kZips = 2, kZip = 3, kPiz = 4 };  // index in kCompressions

[[noreturn]] void refuse(const std::string& cause) {
  throw Error("truncated or damaged (" + cause + ")");
}

/// Takes little-endian numbers and bytes from the beginning of a chunk.
class Taker {
 public:
  explicit Taker(std::span<const char> bytes) : rest_(bytes) {}
  std::span<const char> take(std::size_t count) {
    if (count > rest_.size()) refuse("a chunk is too short");
    return std::exchange(rest_, rest_.subspan(count)).first(count);
  }
  std::size_t number(std::size_t bytes) {
    std::size_t value = 0, shift = 0;
    for (const char c : take(bytes)) {
      value |= std::size_t{static_cast<unsigned char>(c)} << shift;
      shift += 8;
    }
    return value;
  }

 private:
  std::span<const char> rest_;
};

/// The values that occur in a PIZ chunk, as a table by their rank. 0 always occurs.
std::size_t read_values(Taker& taker, std::vector<std::uint16_t>& values) {
  constexpr std::size_t kBitmapBytes = 8192;
  const std::size_t first = taker.number(2), last = taker.number(2);
  if (first >= kBitmapBytes || last >= kBitmapBytes) refuse("a chunk's table of values");
  values.assign(8 * kBitmapBytes, 0);
  std::size_t count = 1;
  if (first > last) return count;
  const std::span<const char> bitmap = taker.take(last - first + 1);
  for (std::size_t i = 0; i < bitmap.size(); ++i) {
    for (std::size_t bit = 0; bit < 8; ++bit) {
      const std::size_t value = 8 * (first + i) + bit;
      if (value > 0 && (static_cast<unsigned char>(bitmap[i]) >> bit & 1) != 0) {
        values[count++] = static_cast<std::uint16_t>(value);
      }
    }
  }
  return count;
}

}  // namespace

bool ExrUnpacker::knows(const ExrHeader& header) {
  const ExrPart& part = header.part;
  const bool plain = std::all_of(part.channels.begin(), part.channels.end(), [](const auto& c) {
    return c.x_sampling == 1 && c.y_sampling == 1;
  });
  const int how = header.compression;
  return std::endian::native == std::endian::little && plain && !part.tiled && !part.deep &&
         (how == kNone || how == kZips || how == kZip || how == kPiz);
}

ExrUnpacker::ExrUnpacker(const ExrHeader& header, std::vector<std::size_t> wanted)
    : header_(header),
      wanted_(std::move(wanted)),
      chunk_lines_(header.compression == kPiz   ? 32
                   : header.compression == kZip ? 16
                                                : 1),
      first_(header.part.channels.size()),
      row_stride_(header.part.channels.size()) {
  for (const ExrChannel& channel : header.part.channels) {
    line_bytes_ += static_cast<std::size_t>(bytes_of(channel.type) * header.part.data.width());
  }
  packed_.resize(line_bytes_ * static_cast<std::size_t>(chunk_lines_));
}

void ExrUnpacker::unpack(int packed_bytes, int lines) {
  const std::size_t bytes = line_bytes_ * static_cast<std::size_t>(lines);
  const auto packed = static_cast<std::size_t>(packed_bytes);
  if (packed_bytes < 0 || packed > bytes) refuse("a chunk is too long");
  if (packed == bytes) {  // incompressible data is stored unchanged
    pixels_ = packed_.data();
    place_line_by_line();
  } else if (header_.compression == kPiz) {
    unpiz(packed, bytes, lines);
  } else if (header_.compression != kNone) {
    unzip(packed, bytes);
  } else {
    refuse("a chunk is too short");
  }
}

/// DEFLATE over differences of neighbouring bytes, all even bytes before all odd bytes.
void ExrUnpacker::unzip(std::size_t packed_bytes, std::size_t bytes) {
  halves_.resize(packed_.size());
  unzipped_.resize(packed_.size());
  uLongf length = static_cast<uLongf>(bytes);
  const int result = ::uncompress(reinterpret_cast<Bytef*>(halves_.data()), &length,
                                  reinterpret_cast<const Bytef*>(packed_.data()),
                                  static_cast<uLong>(packed_bytes));
  if (result == Z_MEM_ERROR) throw std::bad_alloc();
  if (result != Z_OK || length != bytes) refuse("a chunk cannot be decompressed");
  auto* const from = reinterpret_cast<unsigned char*>(halves_.data());
  unsigned sum = from[0];
  for (std::size_t i = 1; i < bytes; ++i) {
    sum += from[i] - 128u;
    from[i] = static_cast<unsigned char>(sum);
  }
  const char* const even = halves_.data();
  const char* const odd = even + (bytes + 1) / 2;
  char* const into = unzipped_.data();
  for (std::size_t i = 0; i < bytes / 2; ++i) {
    into[2 * i] = even[i];
    into[2 * i + 1] = odd[i];
  }
  if (bytes % 2 != 0) into[bytes - 1] = even[bytes / 2];
  pixels_ = into;
  place_line_by_line();
}

/// Huffman codes of wavelets of ranks: channel by channel, in 16-bit words.
void ExrUnpacker::unpiz(std::size_t packed_bytes, std::size_t bytes, int lines) {
  Taker taker({packed_.data(), packed_bytes});
  const std::size_t count = read_values(taker, values_);
  const std::span<const char> codes = taker.take(taker.number(4));
  words_.resize(packed_.size() / 2);
  Imf::hufUncompress(codes.data(), static_cast<int>(codes.size()), words_.data(),
                     static_cast<int>(bytes / 2));
  pixels_ = reinterpret_cast<const char*>(words_.data());
  place_channel_by_channel(lines);
  const int width = header_.part.data.width();
  for (const std::size_t channel : wanted_) {
    std::uint16_t* const words = words_.data() + first_[channel] / 2;
    const int size = bytes_of(header_.part.channels[channel].type) / 2;  // words per sample
    for (int j = 0; j < size; ++j) {
      Imf::wav2Decode(words + j, width, size, lines, width * size,
                      static_cast<std::uint16_t>(count - 1));
    }
    const std::uint16_t* const values = values_.data();
    std::for_each(words, words + std::ptrdiff_t{width} * size * lines,
                  [=](std::uint16_t& word) { word = values[word]; });
  }
}

void ExrUnpacker::place_line_by_line() {
  std::ptrdiff_t first = 0;
  for (std::size_t i = 0; i < first_.size(); ++i) {
    first_[i] = first;
    row_stride_[i] = static_cast<std::ptrdiff_t>(line_bytes_);
    first += bytes_of(header_.part.channels[i].type) * header_.part.data.width();
  }
}

void ExrUnpacker::place_channel_by_channel(int lines) {
  std::ptrdiff_t first = 0;
  for (std::size_t i = 0; i < first_.size(); ++i) {
    first_[i] = first;
    row_stride_[i] = bytes_of(header_.part.channels[i].type) * header_.part.data.width();
    first += row_stride_[i] * lines;
  }
}

}  // namespace limpid
