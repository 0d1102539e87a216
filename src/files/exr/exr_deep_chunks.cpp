#include "files/exr/exr_deep_chunks.h"

#include <algorithm>
#include <limits>

namespace limpid {
namespace {

std::int32_t read_i32(FileStream& stream) {
  return static_cast<std::int32_t>(read_number(stream, 4));
}

std::string name_of(const ExrHeader& header, const Rect& window) {
  return header.part.tiled
             ? "the tile at (" + std::to_string(window.x0) + ", " + std::to_string(window.y0) + ")"
             : "line " + std::to_string(window.y0);
}

Error damaged(const std::string& cause) { return Error("truncated or damaged (" + cause + ")"); }

/// Stored bytes of one sample of all channels.
std::int64_t sample_bytes(const ExrPart& part) {
  std::int64_t bytes = 0;
  for (const ExrChannel& channel : part.channels) {
    bytes += channel.type == SampleType::kHalf ? 2 : 4;
  }
  return bytes;
}

/// Throws Error unless the numbers at the stream's position belong to this chunk.
void check_place(FileStream& stream, const ExrHeader& header, bool multi_part, int part,
                 const Rect& window) {
  const bool right_part = !multi_part || read_i32(stream) == part;
  bool right_place = true;
  if (header.part.tiled) {
    const std::int32_t column = read_i32(stream), row = read_i32(stream);
    const std::int32_t x_level = read_i32(stream), y_level = read_i32(stream);
    right_place = (window.x0 - header.part.data.x0) / header.tile_width == column &&
                  (window.y0 - header.part.data.y0) / header.tile_height == row && x_level == 0 &&
                  y_level == 0;
  } else {
    right_place = read_i32(stream) == window.y0;
  }
  if (!right_part || !right_place) {
    throw damaged(name_of(header, window) + " is stored in another chunk's place");
  }
}

/// Number of samples that the chunk at the stream's position claims.
std::int64_t samples_at(FileStream& stream, const ExrHeader& header, const Rect& window) {
  const std::uint64_t counts = read_number(stream, 8);
  const std::uint64_t packed = read_number(stream, 8);
  const std::uint64_t unpacked = read_number(stream, 8);
  const std::uint64_t room = stream.remaining();
  if (counts > room || packed > room - counts) {
    throw damaged(name_of(header, window) + " reaches beyond the end of the file");
  }
  const std::int64_t most = std::min<std::int64_t>(
      most_unpacked(header, static_cast<std::int64_t>(packed)), std::numeric_limits<int>::max());
  const auto bytes = static_cast<std::uint64_t>(sample_bytes(header.part));
  // OpenEXR stores the counts of a whole tile even where the picture ends within it.
  const std::int64_t pixels =
      header.part.tiled ? header.tile_width * header.tile_height : window.area();
  if (counts > static_cast<std::uint64_t>(pixels) * 4 ||
      unpacked > static_cast<std::uint64_t>(most) || unpacked % bytes != 0) {
    throw damaged(name_of(header, window) + " cannot hold the samples it claims");
  }
  return static_cast<std::int64_t>(unpacked / bytes);
}

}  // namespace

Rect deep_chunk_window(const ExrHeader& header, std::int64_t chunk) {
  const Rect& data = header.part.data;
  if (!header.part.tiled) {
    const int y = data.y0 + static_cast<int>(chunk);  // all compressions of deep scan lines
    return {data.x0, y, data.x1, y + 1};              // have one line per chunk
  }
  const std::int64_t columns = (data.width() + header.tile_width - 1) / header.tile_width;
  const int x0 = data.x0 + static_cast<int>(chunk % columns * header.tile_width);
  const int y0 = data.y0 + static_cast<int>(chunk / columns * header.tile_height);
  return intersection(data, {x0, y0, x0 + static_cast<int>(header.tile_width),
                             y0 + static_cast<int>(header.tile_height)});
}

std::vector<std::int64_t> deep_chunk_samples(FileStream& stream,
                                             const std::vector<ExrHeader>& headers, int part,
                                             const Limits& limits) {
  const ExrHeader& header = headers[part];
  std::uint64_t table = stream.tellg();
  stream.seekg(4);
  const bool multi_part = (read_number(stream, 4) & kMultiPartFlag) != 0;
  for (int before = 0; before < part; ++before) {
    table += 8 * static_cast<std::uint64_t>(
                     std::max(headers[before].chunk_count, chunks_of(headers[before])));
  }
  std::vector<std::int64_t> samples(static_cast<std::size_t>(chunks_of(header)));
  std::int64_t total = 0;
  for (std::size_t chunk = 0; chunk < samples.size(); ++chunk) {
    const Rect window = deep_chunk_window(header, static_cast<std::int64_t>(chunk));
    stream.seekg(table + 8 * chunk);
    const std::uint64_t place = read_number(stream, 8);
    if (place == 0) throw damaged(name_of(header, window) + " is missing");
    stream.seekg(place);
    check_place(stream, header, multi_part, part, window);
    samples[chunk] = samples_at(stream, header, window);
    total += samples[chunk];
    if (total > limits.max_samples) {
      throw Error("more than " + std::to_string(limits.max_samples) +
                  " deep samples in one part, the limit");
    }
  }
  return samples;
}

}  // namespace limpid
