#include "limpid/files/exr/exr_writer.h"

#include <algorithm>
#include <cstring>
#include <new>
#include <set>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfOutputFile.h>

#include "limpid/core/error.h"

#include "files/exr/exr_heading.h"
#include "files/exr/exr_whole.h"
#include "files/exr/half_bits.h"

namespace limpid {
namespace {

constexpr std::int64_t kBlockBytes = std::int64_t{8} << 20;
constexpr int kLeastLines = 32;
constexpr std::size_t kMaxName = 255;

void check(const ExrOutput& output) {
  check_heading(output);
  if (output.channels.empty()) throw Error("no channels to write: expected at least one");
  std::set<std::string> names;
  for (const ExrOutputChannel& channel : output.channels) {
    if (channel.name.empty() || channel.name.size() > kMaxName) {
      throw Error("channel name '" + channel.name + "': expected 1 ... 255 letters");
    }
    if (!names.insert(channel.name).second) {
      throw Error("channel '" + channel.name + "' is given twice");
    }
    if (!channel.from || !channel.from.window.contains(output.data)) {
      throw Error("channel '" + channel.name + "' does not cover the data window");
    }
  }
  compression_named(output.compression);
}

/// A row of a channel as it is to be stored; returns the place behind it.
template <class Stored, class Convert>
char* convert(const float* from, std::ptrdiff_t stride, int count, char* into, Convert as_stored) {
  for (int i = 0; i < count; ++i) {
    const Stored value = as_stored(from[i * stride]);
    std::memcpy(into + sizeof value * static_cast<std::size_t>(i), &value, sizeof value);
  }
  return into + sizeof(Stored) * static_cast<std::size_t>(count);
}

char* convert_row(const float* from, std::ptrdiff_t stride, int count, bool to_half, char* into) {
  if (!to_half) {
    return convert<float>(from, stride, count, into, [](float value) { return value; });
  }
  if (stride != 1) return convert<std::uint16_t>(from, stride, count, into, half_bits_of);
  return convert<std::uint16_t>(from, 1, count, into, half_bits_of);  // on vectors
}

/// Rows of one channel as they are to be stored.
void convert(const ExrOutputChannel& channel, const Rect& block, char* into) {
  for (int y = block.y0; y < block.y1; ++y) {
    into = convert_row(&channel.from.at(block.x0, y), channel.from.x_stride, block.width(),
                       channel.half, into);
  }
}

/// A slice over `memory`, which holds the rows of `block` without gaps. The address of (0, 0) that
/// OpenEXR wants may lie outside the memory, so it is computed in integers.
Imf::Slice slice_of(char* memory, const Rect& block, Imf::PixelType type) {
  const std::ptrdiff_t bytes = type == Imf::HALF ? 2 : 4, row = bytes * block.width();
  const std::uintptr_t origin = reinterpret_cast<std::uintptr_t>(memory) -
                                static_cast<std::uintptr_t>(block.x0 * bytes + block.y0 * row);
  return {type, reinterpret_cast<char*>(origin), static_cast<std::size_t>(bytes),
          static_cast<std::size_t>(row)};
}

/// Converts and writes some lines at a time, so that no second picture is held in memory.
void write_pixels(Imf::OutputFile& file, const ExrOutput& output) {
  const Rect& data = output.data;
  std::int64_t line_bytes = 0;
  for (const ExrOutputChannel& channel : output.channels) {
    line_bytes += std::int64_t{data.width()} * (channel.half ? 2 : 4);
  }
  const int lines = static_cast<int>(std::min<std::int64_t>(
      data.height(),
      std::max<std::int64_t>(kBlockBytes / line_bytes / kLeastLines, 1) * kLeastLines));
  std::vector<char> memory(static_cast<std::size_t>(line_bytes * lines));
  for (Rect block = data; block.y0 < data.y1; block.y0 = block.y1) {
    block.y1 = std::min(block.y0 + lines, data.y1);
    Imf::FrameBuffer frame;
    char* into = memory.data();
    for (const ExrOutputChannel& channel : output.channels) {
      convert(channel, block, into);
      frame.insert(channel.name, slice_of(into, block, channel.half ? Imf::HALF : Imf::FLOAT));
      into += block.area() * (channel.half ? 2 : 4);
    }
    file.setFrameBuffer(frame);
    file.writePixels(block.height());
    // It comes back early, without a word, when a thread of its own had no memory; the next lines
    // would then be taken from where these were.
    if (file.currentScanLine() != block.y1) throw std::bad_alloc();
  }
}

void write_stream(OutputStream& stream, const ExrOutput& output) {
  Imf::Header header = header_of(output, compression_named(output.compression));
  for (const ExrOutputChannel& channel : output.channels) {
    header.channels().insert(channel.name, Imf::Channel(channel.half ? Imf::HALF : Imf::FLOAT));
  }
  Imf::OutputFile file(stream, header);
  write_pixels(file, output);
}

}  // namespace

void validate_compression(const std::string& compression) { compression_named(compression); }

void write_exr(const std::filesystem::path& path, const ExrOutput& output) {
  AtomicFiles files;
  write_exr(files, path, output);
  files.commit();
}

void write_exr(AtomicFiles& files, const std::filesystem::path& path, const ExrOutput& output) {
  write_whole_exr(
      files, path, [&] { check(output); },
      [&](OutputStream& stream) { write_stream(stream, output); });
}

}  // namespace limpid
