#include "files/exr/exr_pixels.h"

#include <algorithm>
#include <map>

#include <OpenEXR/ImfArray.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfRgbaFile.h>

#include "files/exr/exr_copy.h"

namespace limpid {
namespace {

constexpr std::int64_t kBlockLines = 64;
constexpr std::int64_t kBlockBytes = std::int64_t{4} << 20;

/// The lines of the data window that the requests need.
Rect wanted_lines(const Rect& data, std::span<const ExrRequest> requests) {
  Rect lines{data.x0, data.y1, data.x1, data.y0};
  for (const ExrRequest& request : requests) {
    const Rect part = intersection(data, request.into.window);
    if (part.empty()) continue;
    lines.y0 = std::min(lines.y0, part.y0);
    lines.y1 = std::max(lines.y1, part.y1);
  }
  return lines;
}

/// A slice of floats whose texel (x, y) lies at `texel`. OpenEXR needs the address of (0, 0), which
/// may lie outside the memory, so it is computed in integers.
Imf::Slice slice_at(float* texel, int x, int y, std::ptrdiff_t x_stride, std::ptrdiff_t y_stride) {
  const std::ptrdiff_t dx = x_stride * std::ptrdiff_t{sizeof(float)};
  const std::ptrdiff_t dy = y_stride * std::ptrdiff_t{sizeof(float)};
  const std::uintptr_t origin =
      reinterpret_cast<std::uintptr_t>(texel) - static_cast<std::uintptr_t>(x * dx + y * dy);
  return {Imf::FLOAT, reinterpret_cast<char*>(origin), static_cast<std::size_t>(dx),
          static_cast<std::size_t>(dy)};
}

/// One stored channel and all its requests.
struct Source {
  std::vector<const ExrRequest*> targets;
  std::vector<float> block;  ///< empty if decoded directly into the only target
};

/// Copies the rows `block` of one channel, whose texel (block.x0, block.y0) is `*from`.
template <class T>
void copy_block(const T* from, std::ptrdiff_t x_stride, const Rect& block,
                const View<float>& into) {
  const Rect part = intersection(block, into.window);
  for (int y = part.y0; y < part.y1; ++y) {
    const T* row = from + std::ptrdiff_t{y - block.y0} * block.width() * x_stride;
    for (int x = part.x0; x < part.x1; ++x) {
      into.at(x, y) = static_cast<float>(row[std::ptrdiff_t{x - block.x0} * x_stride]);
    }
  }
}

/// The block of lines that begins at `y`; its end is aligned, so that no chunk is decoded twice.
Rect block_at(const Rect& data, const Rect& lines, int y, std::int64_t block_lines) {
  const std::int64_t past = (y - data.y0) / block_lines * block_lines + block_lines;
  return {lines.x0, y, lines.x1,
          static_cast<int>(std::min<std::int64_t>(data.y0 + past, lines.y1))};
}

bool ends_in(const std::string& channel, const std::string& layer, std::string_view name) {
  return channel.size() == layer.size() + name.size() && channel.starts_with(layer) &&
         channel.ends_with(name);
}

}  // namespace

std::string layer_of(const std::string& channel) {
  return channel.substr(0, channel.rfind('.') + 1);
}

bool is_luminance_chroma(const ExrPart& stored, const std::string& layer) {
  int found = 0;
  for (const ExrChannel& channel : stored.channels) {
    const auto is = [&](std::string_view name) { return ends_in(channel.name, layer, name); };
    const auto sampled = [&](int n) { return channel.x_sampling == n && channel.y_sampling == n; };
    if (is("R") || is("G") || is("B")) return false;
    if ((is("Y") && sampled(1)) || ((is("RY") || is("BY")) && sampled(2))) ++found;
  }
  return found == 3;
}

ExrPart shown_part(const ExrPart& stored) {
  ExrPart shown = stored;
  shown.channels.clear();
  for (const ExrChannel& channel : stored.channels) {
    const std::string layer = layer_of(channel.name);
    const std::string name = channel.name.substr(layer.size());
    const bool luma =
        (name == "Y" || name == "RY" || name == "BY") && is_luminance_chroma(stored, layer);
    if (!luma) {
      shown.channels.push_back(channel);
    } else if (name == "Y") {
      for (const char* color : {"B", "G", "R"}) {
        shown.channels.push_back({layer + color, SampleType::kHalf, 1, 1});
      }
    }
  }
  std::sort(shown.channels.begin(), shown.channels.end(),
            [](const ExrChannel& a, const ExrChannel& b) { return a.name < b.name; });
  return shown;
}

void fill_outside(const Rect& data, std::span<const ExrRequest> requests) {
  for (const ExrRequest& request : requests) {
    const Rect& window = request.into.window;
    const Rect inside = intersection(window, data);
    const auto fill = [&](int y, int x0, int x1) {
      for (int x = x0; x < x1; ++x) request.into.at(x, y) = request.missing;
    };
    for (int y = window.y0; y < window.y1; ++y) {
      if (inside.empty() || y < inside.y0 || y >= inside.y1) {
        fill(y, window.x0, window.x1);
      } else {
        fill(y, window.x0, inside.x0);
        fill(y, inside.x1, window.x1);
      }
    }
  }
}

void read_stored(Imf::MultiPartInputFile& file, const ExrHeader& header,
                 std::span<const ExrRequest> requests) {
  const Rect& data = header.part.data;
  const Rect lines = wanted_lines(data, requests);
  if (lines.empty()) return;

  std::map<std::string, Source> sources;
  for (const ExrRequest& request : requests) {
    sources[request.channel].targets.push_back(&request);
  }
  Imf::FrameBuffer direct;
  std::int64_t buffered = 0;
  for (const auto& [name, source] : sources) {
    const View<float>& into = source.targets[0]->into;
    if (source.targets.size() == 1 && into.x_stride > 0 && into.window.contains(lines)) {
      direct.insert(name, slice_at(&into.at(data.x0, lines.y0), data.x0, lines.y0, into.x_stride,
                                   into.y_stride));
    } else {
      ++buffered;
    }
  }

  Imf::InputPart part(file, requests[0].part);
  if (buffered == 0) {
    part.setFrameBuffer(direct);
    part.readPixels(lines.y0, lines.y1 - 1);
    return;
  }
  const std::int64_t line_bytes = buffered * data.width() * std::int64_t{sizeof(float)};
  const std::int64_t block_lines =
      header.part.tiled
          ? header.tile_height
          : std::max<std::int64_t>(1, kBlockBytes / line_bytes / kBlockLines) * kBlockLines;
  const std::size_t block_size =
      static_cast<std::size_t>(std::min<std::int64_t>(block_lines, lines.height()) * data.width());
  for (auto& [name, source] : sources) {
    if (direct.findSlice(name) == nullptr) source.block.resize(block_size);
  }
  for (int y = lines.y0; y < lines.y1;) {
    const Rect block = block_at(data, lines, y, block_lines);
    Imf::FrameBuffer frame = direct;
    for (auto& [name, source] : sources) {
      if (!source.block.empty()) {
        frame.insert(name, slice_at(source.block.data(), block.x0, block.y0, 1, block.width()));
      }
    }
    part.setFrameBuffer(frame);
    part.readPixels(block.y0, block.y1 - 1);
    for (const auto& [name, source] : sources) {
      if (source.block.empty()) continue;
      for (const ExrRequest* target : source.targets) {
        copy_block(source.block.data(), 1, block, target->into);
      }
    }
    y = block.y1;
  }
}

const ExrChannel* find_channel(const ExrPart& part, const std::string& name) {
  const auto found = std::find_if(part.channels.begin(), part.channels.end(),
                                  [&](const ExrChannel& c) { return c.name == name; });
  return found == part.channels.end() ? nullptr : &*found;
}

void read_lines(Imf::MultiPartInputFile& file, const ExrHeader& header, int part,
                std::span<const std::string> channels, LineRange lines,
                std::span<char* const> into) {
  const Rect& data = header.part.data;
  Imf::FrameBuffer frame;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const SampleType type = find_channel(header.part, channels[i])->type;
    const std::ptrdiff_t bytes = type == SampleType::kHalf ? 2 : 4, row = bytes * data.width();
    const std::uintptr_t origin =
        reinterpret_cast<std::uintptr_t>(into[i]) -
        static_cast<std::uintptr_t>(data.x0 * bytes + std::ptrdiff_t{lines.y0} * row);
    frame.insert(channels[i], {pixel_type_of(type), reinterpret_cast<char*>(origin),
                               static_cast<std::size_t>(bytes), static_cast<std::size_t>(row)});
  }
  Imf::InputPart stored(file, part);
  stored.setFrameBuffer(frame);
  stored.readPixels(lines.y0, lines.y1 - 1);
}

void read_luminance_chroma(FileStream& stream, const ExrHeader& header, const std::string& layer,
                           std::span<const ExrRequest> requests) {
  const Rect& data = header.part.data;
  const Rect lines = wanted_lines(data, requests);
  if (lines.empty()) return;
  Imf::RgbaInputFile file(stream, layer.substr(0, layer.rfind('.')));
  std::vector<Imf::Rgba> pixels(static_cast<std::size_t>(
      std::int64_t{data.width()} * std::min<std::int64_t>(kBlockLines, lines.height())));
  for (int y = lines.y0; y < lines.y1;) {
    const Rect block = block_at(data, lines, y, kBlockLines);
    const std::ptrdiff_t to_origin = block.x0 + std::ptrdiff_t{block.y0} * block.width();
    const std::uintptr_t origin =
        reinterpret_cast<std::uintptr_t>(pixels.data()) -
        static_cast<std::uintptr_t>(to_origin * std::ptrdiff_t{sizeof(Imf::Rgba)});
    file.setFrameBuffer(reinterpret_cast<Imf::Rgba*>(origin), 1,
                        static_cast<std::size_t>(block.width()));
    file.readPixels(block.y0, block.y1 - 1);
    for (const ExrRequest& request : requests) {
      const char color = request.channel.back();
      const half* first = color == 'R' ? &pixels[0].r : color == 'G' ? &pixels[0].g : &pixels[0].b;
      copy_block(first, sizeof(Imf::Rgba) / sizeof(half), block, request.into);
    }
    y = block.y1;
  }
}

}  // namespace limpid
