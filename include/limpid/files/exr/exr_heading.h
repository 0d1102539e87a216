#pragma once
#include <array>
#include <map>
#include <string>

#include "limpid/core/rect.h"
#include "limpid/files/exr/exr_file.h"

namespace limpid {

/// The header of a file to write, without its channels and their compression.
struct ExrHeading {
  Rect data, display;
  double pixel_aspect = 1;
  /// Attributes of the input, copied byte for byte, except those that describe the storage of
  /// pixels, and those that `text` or `matrices` have, too.
  std::map<std::string, ExrFile::Attribute> inherited;
  std::map<std::string, std::string> text;  ///< string attributes to add
  std::map<std::string, std::array<float, 16>> matrices;
};

}  // namespace limpid
