#pragma once
#include <cstdint>

namespace limpid {

/// Limits on the sizes in a file's headers, which are checked before memory is allocated. A header
/// beyond a limit is refused with a sentence that names the limit.
struct Limits {
  std::int64_t max_pixels = std::int64_t{1} << 28;  ///< in a data or display window
  int max_side = 65536;     ///< width and height of either window, in pixels
  int max_channels = 1024;  ///< per part
  int max_parts = 256;      ///< per file
  std::int64_t max_memory = std::int64_t{8} << 30;   ///< bytes for all planes read from one file
  std::int64_t max_samples = std::int64_t{1} << 31;  ///< per deep part
};

}  // namespace limpid
