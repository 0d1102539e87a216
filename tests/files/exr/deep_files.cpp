#include "files/exr/deep_files.h"

#include <memory>

#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineOutputPart.h>
#include <OpenEXR/ImfDeepTiledOutputPart.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>

namespace limpid::exr_test {
namespace {

Imath::Box2i box_of(const Rect& r) { return {{r.x0, r.y0}, {r.x1 - 1, r.y1 - 1}}; }

Imf::Header header_of(const DeepPicture& picture) {
  Imf::Header header(box_of(picture.data), box_of(picture.data));
  header.compression() = picture.compression;
  for (const auto& [name, type] : picture.channels) {
    header.channels().insert(name, Imf::Channel(type));
  }
  header.setType(Imf::DEEPSCANLINE);
  if (picture.tile_width > 0) {
    header.setType(Imf::DEEPTILE);
    header.setTileDescription(Imf::TileDescription(
        static_cast<unsigned>(picture.tile_width), static_cast<unsigned>(picture.tile_height),
        picture.mip ? Imf::MIPMAP_LEVELS : Imf::ONE_LEVEL));
  }
  header.setName("deep");
  return header;
}

/// All samples in memory, float or half as the channels are.
struct Samples {
  explicit Samples(const DeepPicture& picture) {
    const std::size_t width = static_cast<std::size_t>(picture.data.width());
    const std::size_t pixels = static_cast<std::size_t>(picture.data.area());
    counts.resize(pixels);
    const std::ptrdiff_t first =
        picture.data.x0 + std::ptrdiff_t{picture.data.y0} * picture.data.width();
    frame.insertSampleCountSlice(
        {Imf::UINT, reinterpret_cast<char*>(counts.data() - first), 4, 4 * width});
    for (const auto& [name, type] : picture.channels) {
      auto& pointers = all_pointers.emplace_back(pixels);
      for (std::size_t i = 0; i < pixels; ++i) {
        const auto found = picture.samples.find({picture.data.x0 + static_cast<int>(i % width),
                                                 picture.data.y0 + static_cast<int>(i / width)});
        if (found == picture.samples.end()) continue;
        counts[i] = static_cast<unsigned>(found->second.size());
        auto& values = memory.emplace_back(new float[found->second.size()]);
        for (std::size_t s = 0; s < found->second.size(); ++s) {
          values[s] = found->second[s].at(name);
          if (type == Imf::HALF) reinterpret_cast<half*>(&values[s])[0] = half(values[s]);
        }
        pointers[i] = values.get();
      }
      frame.insert(name, {type, reinterpret_cast<char*>(pointers.data() - first), sizeof(float*),
                          sizeof(float*) * width, sizeof(float)});
    }
  }
  std::vector<unsigned> counts;
  std::vector<std::vector<float*>> all_pointers;
  std::vector<std::unique_ptr<float[]>> memory;
  Imf::DeepFrameBuffer frame;
};

void write_flat_part(Imf::MultiPartOutputFile& file) {
  const std::vector<float> z(16, 2.5f);
  Imf::FrameBuffer frame;
  frame.insert(
      "Z", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(const_cast<float*>(z.data())), 4, 16));
  Imf::OutputPart part(file, 0);
  part.setFrameBuffer(frame);
  part.writePixels(4);
}

}  // namespace

void write_deep_picture(const std::string& path, const DeepPicture& picture) {
  Samples samples(picture);
  Imf::Header flat(box_of(picture.data), box_of({0, 0, 4, 4}));
  flat.channels().insert("Z", Imf::Channel(Imf::FLOAT));
  flat.setType(Imf::SCANLINEIMAGE);
  flat.setName("flat");
  flat.compression() = Imf::ZIP_COMPRESSION;
  const Imf::Header headers[] = {flat, header_of(picture)};
  const int index = picture.second_part ? 1 : 0;
  Imf::MultiPartOutputFile file(path.c_str(), picture.second_part ? headers : headers + 1,
                                1 + index);
  if (picture.second_part) write_flat_part(file);
  if (picture.tile_width > 0) {
    Imf::DeepTiledOutputPart part(file, index);
    part.setFrameBuffer(samples.frame);
    for (int level = 0; level < part.numXLevels(); ++level) {
      part.writeTiles(0, part.numXTiles(level) - 1, 0, part.numYTiles(level) - 1, level);
    }
  } else {
    Imf::DeepScanLineOutputPart part(file, index);
    part.setFrameBuffer(samples.frame);
    part.writePixels(picture.data.height());
  }
}

}  // namespace limpid::exr_test
