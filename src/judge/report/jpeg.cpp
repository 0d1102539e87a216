#include "judge/report/jpeg.h"

#include <cstdint>
#include <vector>

#include "files/picture/jpeg.h"

namespace limpid {
namespace {

std::uint8_t byte_of(float value) {
  // NaN, which is not above 0, becomes 0.
  return value > 0 ? static_cast<std::uint8_t>(value < 1 ? 255 * value + 0.5f : 255) : 0;
}

}  // namespace

std::string jpeg_of(const std::array<View<const float>, 3>& rgb, int quality) {
  const Rect w = rgb[0].window;
  std::vector<std::uint8_t> pixels;
  pixels.reserve(3 * static_cast<std::size_t>(w.area()));
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) {
      for (const View<const float>& channel : rgb) pixels.push_back(byte_of(channel.at(x, y)));
    }
  }
  return encode_jpeg(w.width(), w.height(), pixels.data(), quality, "a picture of the report");
}

}  // namespace limpid
