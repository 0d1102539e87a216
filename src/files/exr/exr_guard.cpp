#include <algorithm>
#include <limits>

#include <OpenEXR/ImfThreading.h>

#include "files/exr/exr_header.h"
#include "files/exr/exr_unpack.h"

namespace limpid {
namespace {

/// Lines per chunk, and the strongest compression of a chunk, for each compression. DEFLATE shrinks
/// to 1/1032 at best, PXR24 to 3/4 of that; DWA may do so with 1/64 of the values.
constexpr std::int64_t kChunkLines[] = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
constexpr std::int64_t kMaxShrink[] = {1, 64, 1040, 1040, 1040, 1400, 3, 11, 70000, 70000};
/// Keeps the products below within 64 bits, for any limits.
constexpr std::int64_t kMaxTileSide = 1 << 18;
/// Entry in the table of chunks plus the shortest chunk.
constexpr std::int64_t kLeastChunkBytes = 8 + 8;

std::string size_text(std::int64_t width, std::int64_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

void check_window(const char* name, const Rect& window, const Limits& limits) {
  const std::int64_t width = window.width(), height = window.height();
  if (width > limits.max_side || height > limits.max_side) {
    throw Error(std::string(name) + " of " + size_text(width, height) +
                " pixels: expected sides of at most " + std::to_string(limits.max_side));
  }
  if (window.area() > limits.max_pixels) {
    throw Error(std::string(name) + " of " + size_text(width, height) +
                " pixels: expected at most " + std::to_string(limits.max_pixels));
  }
}

/// Bytes of the channels' samples in a window of this size.
std::int64_t sample_bytes(const ExrPart& part, std::int64_t width, std::int64_t height) {
  std::int64_t bytes = 0;
  for (const ExrChannel& channel : part.channels) {
    bytes += (width / channel.x_sampling) * (height / channel.y_sampling) *
             (channel.type == SampleType::kHalf ? 2 : 4);
  }
  return bytes;
}

/// Memory for decoding a part, besides the planes.
struct DecodeBytes {
  std::int64_t chunk, a_thread, besides;

  std::int64_t of_one_thread() const { return a_thread + besides; }
};

/// OpenEXR holds two stored chunks per thread and, for tiles, a row of them as floats. ExrUnpacker
/// holds three more, always whole ones.
DecodeBytes decode_bytes(const ExrHeader& header) {
  const ExrPart& part = header.part;
  const std::int64_t width = part.data.width();
  const bool ours = ExrUnpacker::knows(header);
  const std::int64_t all = kChunkLines[header.compression];
  const std::int64_t lines = ours ? all : std::min<std::int64_t>(all, part.data.height());
  const std::int64_t chunk = part.tiled ? sample_bytes(part, header.tile_width, header.tile_height)
                                        : sample_bytes(part, width, lines);
  const std::int64_t tile_row =
      part.tiled ? width * header.tile_height * 4 * static_cast<std::int64_t>(part.channels.size())
                 : 0;
  return {chunk, (ours ? 5 : 2) * std::max<std::int64_t>(chunk, 1), tile_row};
}

/// Throws Error if the limit is too small even for one thread.
void check_chunk(const ExrHeader& header, const Limits& limits) {
  const DecodeBytes bytes = decode_bytes(header);
  if (bytes.chunk > std::numeric_limits<std::int32_t>::max() ||
      bytes.a_thread > limits.max_memory - bytes.besides) {
    throw Error("chunks of " + std::to_string(bytes.chunk) +
                " bytes need more memory than the limit of " + std::to_string(limits.max_memory) +
                " bytes");
  }
}

}  // namespace

std::int64_t chunks_of(const ExrHeader& header) {
  const std::int64_t width = header.part.data.width(), height = header.part.data.height();
  if (header.part.tiled) {
    const std::int64_t columns = (width + header.tile_width - 1) / header.tile_width;
    return columns * ((height + header.tile_height - 1) / header.tile_height);
  }
  const std::int64_t lines = kChunkLines[header.compression];
  return (height + lines - 1) / lines;
}

std::int64_t most_unpacked(const ExrHeader& header, std::int64_t packed) {
  return packed * kMaxShrink[header.compression];
}

int threads_for(const std::vector<ExrHeader>& headers, const Limits& limits) {
  std::int64_t a_thread = 0, rest = limits.max_memory;
  for (const ExrHeader& header : headers) {
    const DecodeBytes bytes = decode_bytes(header);
    if (bytes.a_thread > limits.max_memory - a_thread || bytes.besides > rest) return 0;
    a_thread += bytes.a_thread;
    rest -= bytes.besides;
  }
  return static_cast<int>(std::min<std::int64_t>(Imf::globalThreadCount(), rest / a_thread));
}

void check_decoded_parts(const std::vector<ExrHeader>& headers, const std::set<int>& parts,
                         const Limits& limits) {
  std::int64_t rest = limits.max_memory;
  for (const int part : parts) {
    rest -= decode_bytes(headers[static_cast<std::size_t>(part)]).of_one_thread();
    if (rest < 0) {
      throw Error("the chunks of " + std::to_string(parts.size()) +
                  " parts need more memory than the limit of " + std::to_string(limits.max_memory) +
                  " bytes");
    }
  }
}

void check_exr_headers(const std::vector<ExrHeader>& headers, const Limits& limits,
                       std::uint64_t header_end, std::uint64_t file_size) {
  const std::int64_t room = static_cast<std::int64_t>(file_size - header_end);
  std::int64_t needed = 0;
  for (const ExrHeader& header : headers) {
    const ExrPart& part = header.part;
    check_window("data window", part.data, limits);
    check_window("display window", part.display, limits);
    if (part.tiled) {
      const std::int64_t longest = std::max(header.tile_width, header.tile_height);
      const std::int64_t most = std::min<std::int64_t>(limits.max_side, kMaxTileSide);
      if (std::min(header.tile_width, header.tile_height) < 1 || longest > most) {
        throw Error("tiles of " + size_text(header.tile_width, header.tile_height) +
                    " pixels: expected sides of 1 ... " + std::to_string(most));
      }
    }
    check_chunk(header, limits);

    const std::int64_t chunks = std::max(chunks_of(header), header.chunk_count);
    const std::int64_t pixels = sample_bytes(part, part.data.width(), part.data.height());
    const std::int64_t least = part.deep ? 0 : pixels / kMaxShrink[header.compression];
    needed += std::max(chunks * kLeastChunkBytes, chunks * 8 + least);
    if (needed > room) {
      throw Error("truncated or damaged (" + size_text(part.data.width(), part.data.height()) +
                  " pixels of " + std::to_string(part.channels.size()) + " channels cannot be in " +
                  std::to_string(room) + " bytes)");
    }
  }
}

bool has_all_chunks(FileStream& stream, const std::vector<ExrHeader>& headers) {
  std::vector<std::vector<std::uint64_t>> places(headers.size());
  for (std::size_t part = 0; part < headers.size(); ++part) {
    const std::int64_t chunks = chunks_of(headers[part]);
    for (std::int64_t i = 0; i < chunks; ++i) places[part].push_back(read_number(stream, 8));
  }
  for (std::size_t part = 0; part < headers.size(); ++part) {
    const ExrHeader& header = headers[part];
    std::int64_t line = header.part.data.y0;
    for (const std::uint64_t place : places[part]) {
      stream.seekg(place);
      if (headers.size() > 1 && read_number(stream, 4) != part) return false;
      const auto y = static_cast<std::int32_t>(read_number(stream, 4));
      std::uint64_t bytes = 0;
      if (header.part.deep) {
        const std::uint64_t counts = read_number(stream, 8), samples = read_number(stream, 8);
        read_number(stream, 8);  // their unpacked size
        bytes =
            std::min(counts, stream.remaining() + 1) + std::min(samples, stream.remaining() + 1);
      } else {
        bytes = read_number(stream, 4);
      }
      if (y != line || bytes > stream.remaining()) return false;
      line += kChunkLines[header.compression];
    }
  }
  return true;
}

}  // namespace limpid
