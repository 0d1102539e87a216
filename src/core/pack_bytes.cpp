#include <cmath>

#include "limpid/core/frame.h"

namespace limpid {
namespace {

/// 0 ... 255, or -1.
int byte_of(float value) {
  const float scaled = 255 * value;
  if (!(scaled > -0.5f && scaled < 255.5f)) return -1;
  const float whole = std::round(scaled);
  return std::abs(scaled - whole) <= 255 * 1e-6f ? static_cast<int>(whole) : -1;
}

}  // namespace

std::vector<std::uint32_t> pack_bytes(const Texture& texture) {
  const Rect& w = texture.channels[0].window;
  std::vector<std::uint32_t> texels;
  texels.reserve(static_cast<std::size_t>(rect_of({w.width() + 1, w.height() + 1}).area()));
  for (int y = 0; y <= w.height(); ++y) {
    for (int x = 0; x <= w.width(); ++x) {
      std::uint32_t texel = 0;
      for (int c = 0; c < 3; ++c) {
        const int byte =
            byte_of(texture.channels[c].at(w.x0 + x % w.width(), w.y0 + y % w.height()));
        if (byte < 0) return {};
        texel |= static_cast<std::uint32_t>(byte) << (8 * c);
      }
      texels.push_back(texel);
    }
  }
  return texels;
}

}  // namespace limpid
