#include "files/exr/part_files.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineOutputPart.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTiledOutputPart.h>

namespace limpid::exr_test {
namespace {

Imath::Box2i box_of(const Rect& r) { return {{r.x0, r.y0}, {r.x1 - 1, r.y1 - 1}}; }

Imf::Header header_of(const WrittenPart& part, const Rect& display) {
  Imf::Header header(box_of(display), box_of(part.data));
  header.compression() = part.deep ? Imf::ZIPS_COMPRESSION : part.compression;
  for (const auto& [name, values] : part.channels) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
  }
  for (const auto& [name, bits] : part.halves) {
    header.channels().insert(name, Imf::Channel(Imf::HALF));
  }
  for (const auto& [name, values] : part.uints) {
    header.channels().insert(name, Imf::Channel(Imf::UINT));
  }
  header.setType(part.deep       ? Imf::DEEPSCANLINE
                 : part.tile > 0 ? Imf::TILEDIMAGE
                                 : Imf::SCANLINEIMAGE);
  if (part.tile > 0) {
    const auto side = static_cast<unsigned>(part.tile);
    header.setTileDescription(Imf::TileDescription(side, side, Imf::ONE_LEVEL));
  }
  if (!part.name.empty()) header.setName(part.name);
  if (!part.view.empty()) header.setView(part.view);
  if (!part.multi_view.empty()) Imf::addMultiView(header, part.multi_view);
  for (const auto& [name, text] : part.texts) header.insert(name, Imf::StringAttribute(text));
  return header;
}

void write_flat(Imf::MultiPartOutputFile& file, int index, const WrittenPart& part) {
  Imf::FrameBuffer frame;
  for (const auto& [name, values] : part.channels) {
    frame.insert(name, Imf::Slice::Make(Imf::FLOAT, values.data(), box_of(part.data)));
  }
  for (const auto& [name, bits] : part.halves) {
    frame.insert(name, Imf::Slice::Make(Imf::HALF, bits.data(), box_of(part.data)));
  }
  for (const auto& [name, values] : part.uints) {
    frame.insert(name, Imf::Slice::Make(Imf::UINT, values.data(), box_of(part.data)));
  }
  if (part.tile > 0) {
    Imf::TiledOutputPart tiled(file, index);
    tiled.setFrameBuffer(frame);
    tiled.writeTiles(0, tiled.numXTiles() - 1, 0, tiled.numYTiles() - 1);
  } else {
    Imf::OutputPart lines(file, index);
    lines.setFrameBuffer(frame);
    lines.writePixels(part.data.height());
  }
}

void write_deep(Imf::MultiPartOutputFile& file, int index, const WrittenPart& part) {
  const auto pixels = static_cast<std::size_t>(part.data.area());
  const auto width = static_cast<std::size_t>(part.data.width());
  std::vector<unsigned> counts(pixels, 1);
  std::map<std::string, std::vector<const float*>> samples;
  const auto origin = [&](auto* first) {
    const std::ptrdiff_t to_origin =
        part.data.x0 + std::ptrdiff_t{part.data.y0} * part.data.width();
    return reinterpret_cast<char*>(reinterpret_cast<std::uintptr_t>(first) -
                                   static_cast<std::uintptr_t>(to_origin) * sizeof *first);
  };
  Imf::DeepFrameBuffer frame;
  frame.insertSampleCountSlice(Imf::Slice(Imf::UINT, origin(counts.data()), 4, 4 * width));
  for (const auto& [name, values] : part.channels) {
    std::vector<const float*>& pointers = samples[name];
    for (const float& value : values) pointers.push_back(&value);
    frame.insert(name, Imf::DeepSlice(Imf::FLOAT, origin(pointers.data()), sizeof(float*),
                                      sizeof(float*) * width, sizeof(float)));
  }
  Imf::DeepScanLineOutputPart lines(file, index);
  lines.setFrameBuffer(frame);
  lines.writePixels(part.data.height());
}

}  // namespace

std::vector<float> level(float level, const Rect& data) {
  std::vector<float> values;
  for (int y = data.y0; y < data.y1; ++y) {
    for (int x = data.x0; x < data.x1; ++x) values.push_back(level_at(level, x, y));
  }
  return values;
}

WrittenPart part_of(const std::string& name, const Rect& data,
                    const std::vector<std::string>& channels, float first_level) {
  WrittenPart part{name, "", data, {}};
  float next = first_level;
  for (const std::string& channel : channels) part.channels[channel] = level(next++, data);
  return part;
}

void write_parts(const std::filesystem::path& path, const Rect& display,
                 const std::vector<WrittenPart>& parts) {
  std::vector<Imf::Header> headers;
  for (const WrittenPart& part : parts) headers.push_back(header_of(part, display));
  Imf::MultiPartOutputFile file(path.c_str(), headers.data(), static_cast<int>(headers.size()));
  for (std::size_t i = 0; i < parts.size(); ++i) {
    (parts[i].deep ? write_deep : write_flat)(file, static_cast<int>(i), parts[i]);
  }
}

}  // namespace limpid::exr_test
