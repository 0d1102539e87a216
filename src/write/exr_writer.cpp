#include "limpid/write/exr_writer.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <set>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfOpaqueAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfVersion.h>

#include "load/exr_header.h"
#include "write/atomic_file.h"
#include "write/exr_streams.h"

namespace limpid {
namespace {

constexpr std::int64_t kBlockBytes = std::int64_t{8} << 20;
constexpr int kLeastLines = 32;
constexpr float kHalfMax = 65504;
constexpr std::size_t kMaxName = 255;

struct Compression {
  Imf::Compression method;
  std::optional<double> level;
};

Compression compression_named(const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::string name = text.substr(0, colon);
  const auto found = std::find(kCompressions.begin(), kCompressions.end(), name);
  if (found == kCompressions.end()) {
    const std::vector<std::string> known(kCompressions.begin(), kCompressions.end());
    throw Error(
        "compression '" + name + "': expected one of " + join(known) + did_you_mean(name, known),
        Fault::kUsage);
  }
  Compression compression{static_cast<Imf::Compression>(found - kCompressions.begin()), {}};
  if (colon == std::string::npos) return compression;

  const bool zip = name == "zip" || name == "zips", dwa = name == "dwaa" || name == "dwab";
  if (!zip && !dwa) {
    throw Error("compression '" + text + "': " + name + " has no level, only zip, zips, dwaa, dwab",
                Fault::kUsage);
  }
  double level = 0;
  const char* end = text.data() + text.size();
  const auto [stop, failure] = std::from_chars(text.data() + colon + 1, end, level);
  const bool in_range =
      zip ? level >= 1 && level <= 9 && level == std::floor(level) : level >= 0 && level <= 100000;
  if (failure != std::errc() || stop != end || !in_range) {
    throw Error("compression '" + text + "': expected a level of " +
                    (zip ? "1 ... 9, whole" : "0 ... 100000"),
                Fault::kUsage);
  }
  compression.level = level;
  return compression;
}

void check(const ExrOutput& output) {
  if (output.data.empty()) throw Error("the data window is empty: expected at least 1x1");
  if (output.display.empty()) throw Error("the display window is empty: expected at least 1x1");
  if (!(output.pixel_aspect > 0) || !std::isfinite(output.pixel_aspect)) {
    throw Error("pixel aspect ratio " + std::to_string(output.pixel_aspect) +
                ": expected a number above 0");
  }
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
  const auto check_name = [&](const std::string& name) {
    if (is_structural(name) || name.empty() || name.size() > kMaxName) {
      throw Error("attribute name '" + name +
                  "': expected a name of 1 ... 255 letters that does "
                  "not describe how pixels are stored");
    }
  };
  for (const auto& [name, value] : output.text) check_name(name);
  for (const auto& [name, value] : output.matrices) check_name(name);
}

Imath::Box2i box_of(const Rect& r) { return {{r.x0, r.y0}, {r.x1 - 1, r.y1 - 1}}; }

/// Attributes that every header has are typed; all others go through as bytes.
void inherit(Imf::Header& header, const std::string& name, const ExrFile::Attribute& attribute) {
  BytesStream bytes(attribute.bytes);
  const int size = static_cast<int>(attribute.bytes.size());
  if (const auto own = header.find(name); own != header.end()) {
    if (attribute.type != own.attribute().typeName()) {
      throw Error("attribute '" + name + "' of type '" + attribute.type + "': expected '" +
                  own.attribute().typeName() + "'");
    }
    own.attribute().readValueFrom(bytes, size, Imf::EXR_VERSION);
    return;
  }
  Imf::OpaqueAttribute opaque(attribute.type.c_str());
  opaque.readValueFrom(bytes, size, Imf::EXR_VERSION);
  header.insert(name, opaque);
}

Imf::Header header_of(const ExrOutput& output) {
  Imf::Header header(box_of(output.display), box_of(output.data),
                     static_cast<float>(output.pixel_aspect));
  for (const auto& [name, attribute] : output.inherited) {
    const bool ours = output.text.contains(name) || output.matrices.contains(name);
    if (!ours && !is_structural(name)) inherit(header, name, attribute);
  }
  const Compression compression = compression_named(output.compression);
  header.compression() = compression.method;
  if (compression.level) {
    const auto level = *compression.level;
    const bool zip =
        compression.method == Imf::ZIP_COMPRESSION || compression.method == Imf::ZIPS_COMPRESSION;
    if (zip) {
      header.zipCompressionLevel() = static_cast<int>(level);
    } else {
      header.dwaCompressionLevel() = static_cast<float>(level);
    }
  }
  for (const ExrOutputChannel& channel : output.channels) {
    header.channels().insert(channel.name, Imf::Channel(channel.half ? Imf::HALF : Imf::FLOAT));
  }
  for (const auto& [name, value] : output.text) header.insert(name, Imf::StringAttribute(value));
  for (const auto& [name, value] : output.matrices) {
    Imath::M44f matrix;
    std::copy(value.begin(), value.end(), matrix.getValue());
    header.insert(name, Imf::M44fAttribute(matrix));
  }
  return header;
}

half half_of(float value) {
  return half(std::isfinite(value) ? std::clamp(value, -kHalfMax, kHalfMax) : value);
}

/// Rows of one channel as they are to be stored.
void convert(const ExrOutputChannel& channel, const Rect& block, char* into) {
  for (int y = block.y0; y < block.y1; ++y) {
    const float* from = &channel.from.at(block.x0, y);
    const std::ptrdiff_t stride = channel.from.x_stride;
    for (int i = 0; i < block.width(); ++i, from += stride) {
      if (channel.half) {
        const half value = half_of(*from);
        std::memcpy(into, &value, sizeof value);
        into += sizeof value;
      } else {
        std::memcpy(into, from, sizeof *from);
        into += sizeof *from;
      }
    }
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
  }
}

void write_stream(OutputStream& stream, const ExrOutput& output) {
  Imf::OutputFile file(stream, header_of(output));
  write_pixels(file, output);
}

/// OpenEXR 3.1 leaves a chunk out without a word when its compressor fails.
void check_complete(const std::filesystem::path& path) {
  FileStream stream(std::make_shared<FileHandle>(path));
  const Limits unlimited{std::numeric_limits<std::int64_t>::max(), std::numeric_limits<int>::max(),
                         std::numeric_limits<int>::max(), 1,
                         std::numeric_limits<std::int64_t>::max()};
  const ExrHeader header = read_exr_headers(stream, unlimited)[0];
  if (!has_all_chunks(stream, header)) throw Error("some lines could not be compressed");
}

}  // namespace

void validate_compression(const std::string& compression) { compression_named(compression); }

void write_exr(const std::filesystem::path& path, const ExrOutput& output) {
  const std::string name = path.string();
  try {
    check(output);
    compression_named(output.compression);
  } catch (const Error& error) {
    throw Error(name + ": " + error.what(), error.fault());
  }
  AtomicFile file(path);
  OutputStream stream(file.temporary());
  std::optional<Error> failure;
  try {
    write_stream(stream, output);
    stream.close();
    if (stream.error() == 0) check_complete(file.temporary());
  } catch (const std::bad_alloc&) {
    failure.emplace(name + ": needs more memory than there is", Fault::kRetry);
  } catch (const std::exception& error) {
    failure.emplace(name + ": cannot be written (" + error.what() + ")");
  }
  if (stream.error() != 0) {
    failure.emplace(name + ": cannot be written (" + describe(stream.error()) + ")",
                    fault_of(stream.error()));
  }
  if (failure) throw *failure;
  file.commit();
}

}  // namespace limpid
