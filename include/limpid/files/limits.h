#pragma once
#include <cstdint>

namespace limpid {

/// What a file may ask for before anything is allocated for it. A header that asks for more is
/// refused with a sentence that names the limit.
struct Limits {
  std::int64_t max_pixels = std::int64_t{1} << 28;   ///< of a data or display window
  int max_side = 65536;                              ///< pixels, of either window
  int max_channels = 1024;                           ///< of one part
  int max_parts = 256;                               ///< of one file
  std::int64_t max_memory = std::int64_t{8} << 30;   ///< bytes, of all planes read from one file
  std::int64_t max_samples = std::int64_t{1} << 31;  ///< of one deep part
};

}  // namespace limpid
