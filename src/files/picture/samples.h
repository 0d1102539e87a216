#pragma once
#include <cstdint>
#include <cstring>
#include <functional>
#include <vector>

namespace limpid {

/// A decoded picture of 8 or 16 bits: rows from the top, channels interleaved, no padding.
struct Samples {
  int width = 0, height = 0;
  int x0 = 0, y0 = 0;  ///< position of its pixels according to the file
  int channels = 0;    ///< 1 gray, 2 gray and alpha, 3 RGB, 4 RGB and alpha, which is straight
  int largest = 255;   ///< the value for 1: 255 (a byte each) or 65535 (two, in native order)
  std::vector<std::uint8_t> bytes;

  int at(std::size_t sample) const {
    if (largest == 255) return bytes[sample];
    std::uint16_t value;
    std::memcpy(&value, bytes.data() + 2 * sample, sizeof value);
    return value;
  }
};

/// Called with all members but the bytes, before their memory is allocated; its exception stops the
/// reading.
using CheckHeader = std::function<void(const Samples& header)>;

}  // namespace limpid
