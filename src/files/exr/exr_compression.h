#pragma once
#include <optional>
#include <string>

#include <OpenEXR/ImfCompression.h>

namespace limpid {

struct Compression {
  Imf::Compression method;
  std::optional<double> level;
};

/// Of "zip", "dwaa:45" and so on. Throws Error of Fault::kUsage, with the nearest name.
Compression compression_named(const std::string& text);

}  // namespace limpid
