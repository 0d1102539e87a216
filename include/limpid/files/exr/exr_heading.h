#pragma once
#include <array>
#include <map>
#include <string>

#include "limpid/core/rect.h"
#include "limpid/files/exr/exr_file.h"

namespace limpid {

/// What the header of a file to be written says besides its channels and their compression.
struct ExrHeading {
  Rect data, display;
  double pixel_aspect = 1;
  /// Attributes of the input, passed on byte for byte; those that describe the storage of pixels,
  /// and those that `text` or `matrices` name too, are left out.
  std::map<std::string, ExrFile::Attribute> inherited;
  std::map<std::string, std::string> text;  ///< our own, as string attributes
  std::map<std::string, std::array<float, 16>> matrices;
};

}  // namespace limpid
