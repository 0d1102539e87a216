#include "raster/pyramid.h"

#include <algorithm>
#include <cstdint>
#include <string>

#include "limpid/core/error.h"

namespace limpid::raster {
namespace {

/// The texels that one texel of the next level covers, with their weights: two, or three if the
/// size is odd.
struct Cover {
  int first, count;
  float share[3];
};

Cover cover_of(int index, int size, int half) {
  const double step = static_cast<double>(size) / half, from = index * step, to = from + step;
  Cover cover{static_cast<int>(from), 0, {}};
  for (int i = cover.first; i < size && i < to && cover.count < 3; ++i) {
    const double share = (std::min(to, i + 1.0) - std::max<double>(from, i)) / step;
    cover.share[cover.count++] = static_cast<float>(share);
  }
  return cover;
}

void halve(const float* from, int width, int height, float* to, int half_width, int half_height) {
  for (int y = 0; y < half_height; ++y) {
    const Cover rows = cover_of(y, height, half_height);
    for (int x = 0; x < half_width; ++x) {
      const Cover columns = cover_of(x, width, half_width);
      float sum[4] = {};
      for (int j = 0; j < rows.count; ++j) {
        for (int i = 0; i < columns.count; ++i) {
          const std::ptrdiff_t at = std::ptrdiff_t{rows.first + j} * width + columns.first + i;
          const float share = rows.share[j] * columns.share[i];
          for (int c = 0; c < 4; ++c) sum[c] += share * from[4 * at + c];
        }
      }
      std::copy(sum, sum + 4, to + 4 * (std::ptrdiff_t{y} * half_width + x));
    }
  }
}

}  // namespace

Pyramid::Pyramid(const ModelTexture& texture) {
  const std::int64_t area = std::int64_t{texture.width} * texture.height;
  if (texture.width < 1 || texture.height < 1 ||
      texture.rgba.size() != 4 * static_cast<std::size_t>(area) || area > (1 << 28)) {
    throw Error("texture of " + std::to_string(texture.width) + "x" +
                std::to_string(texture.height) + " with " + std::to_string(texture.rgba.size()) +
                " floats: expected four a texel, at most 2^28 texels");
  }
  view_.width = texture.width;
  view_.height = texture.height;
  std::size_t texels = 0;
  for (int w = texture.width, h = texture.height;; w = std::max(1, w / 2), h = std::max(1, h / 2)) {
    view_.level_start[view_.levels++] = static_cast<std::int32_t>(texels);
    texels += static_cast<std::size_t>(w) * static_cast<std::size_t>(h);
    if (w == 1 && h == 1) break;
  }
  texels_.resize(4 * texels);
  std::copy(texture.rgba.begin(), texture.rgba.end(), texels_.begin());
  for (int l = 1; l < view_.levels; ++l) {
    const auto size = [&](int full, int level) { return std::max(1, full >> level); };
    halve(texels_.data() + 4 * std::ptrdiff_t{view_.level_start[l - 1]}, size(texture.width, l - 1),
          size(texture.height, l - 1), texels_.data() + 4 * std::ptrdiff_t{view_.level_start[l]},
          size(texture.width, l), size(texture.height, l));
  }
  view_.texels = texels_.data();
}

}  // namespace limpid::raster
