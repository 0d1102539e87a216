#include "limpid/files/exr/exr_writer.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <new>
#include <set>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>

#include "limpid/core/error.h"

#include "files/exr/exr_copy.h"
#include "files/exr/exr_heading.h"
#include "files/exr/exr_whole.h"
#include "files/exr/half_bits.h"

namespace limpid {
namespace {

constexpr std::int64_t kBlockBytes = std::int64_t{8} << 20;
constexpr int kLeastLines = 32;
constexpr std::size_t kMaxName = 255;

void check_name(const std::string& name, std::set<std::string>& names) {
  if (name.empty() || name.size() > kMaxName) {
    throw Error("channel name '" + name + "': expected 1 ... 255 letters");
  }
  if (!names.insert(name).second) throw Error("channel '" + name + "' is given twice");
}

void check(const ExrOutput& output) {
  check_heading(output);
  if (output.channels.empty() && output.copies.empty()) {
    throw Error("no channels to write: expected at least one");
  }
  std::set<std::string> names;
  for (const ExrOutputChannel& channel : output.channels) {
    check_name(channel.name, names);
    if (!channel.from || !channel.from.window.contains(output.data)) {
      throw Error("channel '" + channel.name + "' does not cover the data window");
    }
  }
  for (const ExrCopy& copy : output.copies) {
    for (const std::string& name : copy.channels) check_name(name, names);
  }
  compression_named(output.compression);
}

void check(std::span<const ExrOutput> parts) {
  if (parts.empty()) throw Error("no part to write: expected at least one");
  std::set<std::string> names;
  for (const ExrOutput& part : parts) {
    check(part);
    if (parts.size() > 1 && (part.name.empty() || !names.insert(part.name).second)) {
      throw Error("part name '" + part.name + "': expected a different name for each part");
    }
  }
}

/// A row of a channel in its stored form; returns its end.
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

/// Rows of one channel in their stored form.
void convert(const ExrOutputChannel& channel, const Rect& block, char* into) {
  for (int y = block.y0; y < block.y1; ++y) {
    into = convert_row(&channel.from.at(block.x0, y), channel.from.x_stride, block.width(),
                       channel.half, into);
  }
}

/// A slice over `memory`, which holds the rows of `block` without gaps. OpenEXR needs the address
/// of (0, 0), which may lie outside the memory, so it is computed in integers.
Imf::Slice slice_of(char* memory, const Rect& block, Imf::PixelType type) {
  const std::ptrdiff_t bytes = type == Imf::HALF ? 2 : 4, row = bytes * block.width();
  const std::uintptr_t origin = reinterpret_cast<std::uintptr_t>(memory) -
                                static_cast<std::uintptr_t>(block.x0 * bytes + block.y0 * row);
  return {type, reinterpret_cast<char*>(origin), static_cast<std::size_t>(bytes),
          static_cast<std::size_t>(row)};
}

/// All channels of one part, some lines at a time.
class PartRows {
 public:
  explicit PartRows(const ExrOutput& output) : output_(output) {
    for (const ExrCopy& copy : output.copies) copies_.emplace_back(copy);
  }

  /// Few enough lines that no second picture is held in memory. Throws Error if the copied channels
  /// have no memory for them.
  int lines() {
    const Rect& data = output_.data;
    std::int64_t line_bytes = 0, besides = 0, most = std::numeric_limits<std::int64_t>::max();
    for (const ExrOutputChannel& channel : output_.channels) {
      line_bytes += std::int64_t{data.width()} * (channel.half ? 2 : 4);
    }
    for (const CopiedRows& copy : copies_) {
      line_bytes += data.width() * copy.pixel_bytes();
      besides += copy.line_bytes();
      most = std::min(most, copy.max_memory());
    }
    const std::int64_t lines = std::min<std::int64_t>(
        data.height(),
        std::max<std::int64_t>(kBlockBytes / (line_bytes + besides) / kLeastLines, 1) *
            kLeastLines);
    if ((line_bytes + besides) * lines > most) {
      throw Error(std::to_string(lines) +
                  " lines of the passed-through layers need more memory than the limit of " +
                  std::to_string(most) + " bytes");
    }
    memory_.resize(static_cast<std::size_t>(line_bytes * lines));
    return static_cast<int>(lines);
  }

  /// The rows of the block in their stored form.
  Imf::FrameBuffer rows(const Rect& block) {
    Imf::FrameBuffer frame;
    char* into = memory_.data();
    for (const ExrOutputChannel& channel : output_.channels) {
      convert(channel, block, into);
      frame.insert(channel.name, slice_of(into, block, channel.half ? Imf::HALF : Imf::FLOAT));
      into += block.area() * (channel.half ? 2 : 4);
    }
    for (CopiedRows& copy : copies_) {
      std::vector<char*> places;
      for (std::size_t i = 0; i < copy.names().size(); ++i) {
        frame.insert(copy.names()[i], slice_of(into, block, pixel_type_of(copy.type(i))));
        places.push_back(into);
        into += block.area() * (copy.type(i) == SampleType::kHalf ? 2 : 4);
      }
      copy.read(block, places);
    }
    return frame;
  }

  void add_channels(Imf::ChannelList& list) const {
    for (const ExrOutputChannel& channel : output_.channels) {
      list.insert(channel.name, Imf::Channel(channel.half ? Imf::HALF : Imf::FLOAT));
    }
    for (const CopiedRows& copy : copies_) {
      for (std::size_t i = 0; i < copy.names().size(); ++i) {
        list.insert(copy.names()[i], Imf::Channel(pixel_type_of(copy.type(i))));
      }
    }
  }

  const ExrOutput& output() const { return output_; }

 private:
  const ExrOutput& output_;
  std::vector<CopiedRows> copies_;
  std::vector<char> memory_;
};

/// `File` is a file of one part, or a part of several.
template <class File>
void write_pixels(File& file, PartRows& part) {
  const Rect& data = part.output().data;
  const int lines = part.lines();
  for (Rect block = data; block.y0 < data.y1; block.y0 = block.y1) {
    block.y1 = std::min(block.y0 + lines, data.y1);
    file.setFrameBuffer(part.rows(block));
    file.writePixels(block.height());
    // It returns early, without an error, if one of its threads had no memory; the next lines would
    // then be read from the place of these.
    if (file.currentScanLine() != block.y1) throw std::bad_alloc();
  }
}

void write_stream(OutputStream& stream, std::span<const ExrOutput> parts) {
  std::vector<PartRows> rows(parts.begin(), parts.end());
  std::vector<Imf::Header> headers;
  for (const PartRows& part : rows) {
    const ExrOutput& output = part.output();
    Imf::Header& header =
        headers.emplace_back(header_of(output, compression_named(output.compression)));
    part.add_channels(header.channels());
    if (headers.size() == 1) add_file_hash(header);  // the only hash covers the whole file
    if (!output.view.empty()) header.setView(output.view);
    if (parts.size() == 1) continue;
    header.setName(output.name);
    header.setType(Imf::SCANLINEIMAGE);
  }
  if (parts.size() == 1) {
    Imf::OutputFile file(stream, headers[0]);
    write_pixels(file, rows[0]);
    return;
  }
  Imf::MultiPartOutputFile file(stream, headers.data(), static_cast<int>(headers.size()),
                                /*overrideSharedAttributes=*/true);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Imf::OutputPart part(file, static_cast<int>(i));
    write_pixels(part, rows[i]);
  }
}

}  // namespace

void validate_compression(const std::string& compression) { compression_named(compression); }

void write_exr(const std::filesystem::path& path, const ExrOutput& output) {
  write_exr(path, {&output, 1});
}

void write_exr(const std::filesystem::path& path, std::span<const ExrOutput> parts) {
  AtomicFiles files;
  write_exr(files, path, parts);
  files.commit();
}

void write_exr(AtomicFiles& files, const std::filesystem::path& path,
               std::span<const ExrOutput> parts) {
  write_whole_exr(
      files, path, [&] { check(parts); },
      [&](OutputStream& stream) { write_stream(stream, parts); });
}

}  // namespace limpid
