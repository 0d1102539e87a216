#pragma once
#include <map>
#include <string>
#include <vector>

#include "files/exr/exr_files.h"

namespace limpid::exr_test {

/// One deep sample: channel name -> value.
using DeepValues = std::map<std::string, float>;

/// One of color (red, 2 red, 3 red).
inline DeepValues point(float z, float red, float alpha) {
  return {{"Z", z}, {"ZBack", z}, {"R", red}, {"G", 2 * red}, {"B", 3 * red}, {"A", alpha}};
}

inline DeepValues volume(float front, float back, float red, float alpha) {
  DeepValues sample = point(front, red, alpha);
  sample["ZBack"] = back;
  return sample;
}

/// A deep picture to be written by OpenEXR: the channels with their types, and the samples of the
/// pixels that have any.
struct DeepPicture {
  Rect data{0, 0, 4, 3};
  std::map<std::string, Imf::PixelType> channels;
  std::map<std::pair<int, int>, std::vector<DeepValues>> samples;  ///< by (x, y)
  Imf::Compression compression = Imf::ZIPS_COMPRESSION;
  int tile_width = 0, tile_height = 0;  ///< 0: scan lines
  bool mip = false;
  bool second_part = false;  ///< behind a flat one
};

/// A picture with R G B A Z, all float, and no samples yet.
inline DeepPicture rgbaz() {
  DeepPicture picture;
  for (const char* name : {"R", "G", "B", "A", "Z"}) picture.channels[name] = Imf::FLOAT;
  return picture;
}

void write_deep_picture(const std::string& path, const DeepPicture& picture);

}  // namespace limpid::exr_test
