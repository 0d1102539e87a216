#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <OpenEXR/ImfCompression.h>

#include "limpid/core/rect.h"

/// Files of several parts, made with OpenEXR itself.
namespace limpid::exr_test {

/// One part: float channels, row by row.
struct WrittenPart {
  std::string name, view;
  Rect data;
  std::map<std::string, std::vector<float>> channels;
  Imf::Compression compression = Imf::ZIP_COMPRESSION;
  int tile = 0;       ///< 0: scan lines
  bool deep = false;  ///< one sample a pixel
  std::vector<std::string> multi_view = {};
  std::map<std::string, std::string> texts = {};  ///< string attributes
  /// Channels of flat pixels by their bits: half and uint.
  std::map<std::string, std::vector<std::uint16_t>> halves = {};
  std::map<std::string, std::vector<std::uint32_t>> uints = {};
};

/// What level() holds: another value at each pixel.
inline float level_at(float level, int x, int y) {
  return level + static_cast<float>(x) / 64 + static_cast<float>(y) / 1024;
}
std::vector<float> level(float level, const Rect& data);

/// A part whose channels hold level 1, 2, 3 ... in the order of their names here.
WrittenPart part_of(const std::string& name, const Rect& data,
                    const std::vector<std::string>& channels, float first_level = 1);

/// One part makes a file of one part.
void write_parts(const std::filesystem::path& path, const Rect& display,
                 const std::vector<WrittenPart>& parts);

}  // namespace limpid::exr_test
