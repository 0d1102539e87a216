#include "judge/report/jpeg.h"

#include <cstdint>
#include <vector>

#include "files/picture/jpeg.h"

namespace limpid {
namespace {

std::uint8_t byte_of(float value) {
  // Written so that NaN, which is not above 0, becomes 0.
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

std::string base64(const std::string& bytes) {
  constexpr char kLetters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      three = three << 8 | (i + j < bytes.size() ? static_cast<std::uint8_t>(bytes[i + j]) : 0u);
    }
    for (std::size_t j = 0; j < 4; ++j) {
      text += i + j > bytes.size() ? '=' : kLetters[three >> (18 - 6 * j) & 63];
    }
  }
  return text;
}

}  // namespace limpid
