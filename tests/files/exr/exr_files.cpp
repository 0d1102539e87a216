#include "files/exr/exr_files.h"

#include <cstdint>

#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineOutputFile.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <OpenEXR/ImfTiledRgbaFile.h>

namespace limpid::exr_test {
namespace {

Imath::Box2i box_of(const Rect& r) { return {{r.x0, r.y0}, {r.x1 - 1, r.y1 - 1}}; }

struct Picture {
  explicit Picture(const Rect& window) {
    for (int y = window.y0; y < window.y1; ++y) {
      for (int x = window.x0; x < window.x1; ++x) {
        h.push_back(half(expected("H", x, y)));
        f.push_back(expected("F", x, y));
        u.push_back(static_cast<std::uint32_t>(expected("U", x, y)));
      }
    }
    const auto add = [&](const char* name, Imf::PixelType type, void* pixels, std::size_t bytes) {
      frame.insert(name, Imf::Slice::Make(type, pixels, box_of(window), bytes,
                                          bytes * static_cast<std::size_t>(window.width())));
    };
    add("H", Imf::HALF, h.data(), 2);
    add("F", Imf::FLOAT, f.data(), 4);
    add("U", Imf::UINT, u.data(), 4);
  }
  std::vector<half> h;
  std::vector<float> f;
  std::vector<std::uint32_t> u;
  Imf::FrameBuffer frame;
};

Imf::Header header_of(const Storage& storage) {
  Imf::Header header(box_of(kDisplay), box_of(kData), 1.5f, {0, 0}, 1, Imf::INCREASING_Y,
                     storage.compression);
  if (storage.decreasing) header.lineOrder() = Imf::DECREASING_Y;
  header.channels().insert("H", Imf::Channel(Imf::HALF));
  header.channels().insert("F", Imf::Channel(Imf::FLOAT));
  header.channels().insert("U", Imf::Channel(Imf::UINT));
  header.setType(Imf::SCANLINEIMAGE);
  if (storage.tile_width > 0) {
    header.setType(Imf::TILEDIMAGE);
    header.setTileDescription(Imf::TileDescription(
        static_cast<unsigned>(storage.tile_width), static_cast<unsigned>(storage.tile_height),
        storage.mip ? Imf::MIPMAP_LEVELS : Imf::ONE_LEVEL));
  }
  return header;
}

void write_tiled(const std::string& path, const Imf::Header& header, Picture& picture) {
  Imf::TiledOutputFile file(path.c_str(), header);
  for (int level = 0; level < file.numXLevels(); ++level) {
    file.setFrameBuffer(picture.frame);  // lower levels repeat the upper left corner
    file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
  }
}

void write_second_part(const std::string& path, Imf::Header header, Picture& picture) {
  Imf::Header first(box_of(kDisplay), box_of({0, 0, 4, 4}), 1.5f);
  first.channels().insert("Z", Imf::Channel(Imf::FLOAT));
  first.setType(Imf::SCANLINEIMAGE);
  first.setName("depth");
  header.setName("beauty");
  header.setView("left");
  const Imf::Header headers[] = {first, header};
  Imf::MultiPartOutputFile file(path.c_str(), headers, 2);
  std::vector<float> z(16, 2.5f);
  Imf::FrameBuffer frame;
  frame.insert("Z", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(z.data()), 4, 16));
  Imf::OutputPart depth(file, 0);
  depth.setFrameBuffer(frame);
  depth.writePixels(4);
  Imf::OutputPart beauty(file, 1);
  beauty.setFrameBuffer(picture.frame);
  beauty.writePixels(kData.height());
}

}  // namespace

void write_file(const std::string& path, const Storage& storage) {
  Picture picture(kData);
  const Imf::Header header = header_of(storage);
  if (storage.part > 0) {
    write_second_part(path, header, picture);
  } else if (storage.tile_width > 0) {
    write_tiled(path, header, picture);
  } else {
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(picture.frame);
    file.writePixels(kData.height());
  }
}

void write_luminance_chroma(const std::string& path, bool tiled) {
  const Rect data{-4, 2, 96, 82};
  const Imf::Header header(box_of(kDisplay), box_of(data), 1, {0, 0}, 1, Imf::INCREASING_Y,
                           Imf::PIZ_COMPRESSION);
  const std::vector<Imf::Rgba> pixels(static_cast<std::size_t>(data.area()),
                                      Imf::Rgba(0.5f, 0.25f, 0.125f, 0.75f));
  const std::ptrdiff_t width = data.width(), origin = data.x0 + data.y0 * width;
  if (tiled) {
    Imf::TiledRgbaOutputFile file(path.c_str(), header, Imf::WRITE_YA, 32, 32, Imf::ONE_LEVEL);
    file.setFrameBuffer(pixels.data() - origin, 1, static_cast<std::size_t>(width));
    file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
  } else {
    Imf::RgbaOutputFile file(path.c_str(), header, Imf::WRITE_YCA);
    file.setFrameBuffer(pixels.data() - origin, 1, static_cast<std::size_t>(width));
    file.writePixels(data.height());
  }
}

void write_deep(const std::string& path) {
  Imf::Header header(4, 4);
  header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
  header.setType(Imf::DEEPSCANLINE);
  header.compression() = Imf::ZIPS_COMPRESSION;
  std::vector<unsigned> counts(16, 1);
  std::vector<float> z(16, 1.0f);
  std::vector<float*> samples;
  for (float& value : z) samples.push_back(&value);
  Imf::DeepFrameBuffer frame;
  frame.insertSampleCountSlice(
      Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()), 4, 16));
  frame.insert("Z", Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(samples.data()),
                                   sizeof(float*), 4 * sizeof(float*), sizeof(float)));
  Imf::DeepScanLineOutputFile file(path.c_str(), header);
  file.setFrameBuffer(frame);
  file.writePixels(4);
}

}  // namespace limpid::exr_test
