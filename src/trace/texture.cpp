#include "trace/texture.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace limpid::trace {
namespace {

/// log2 of the longer side in texels, rounded.
int level_of(const raster::PyramidView& texture, const glm::dvec2& uv_dx, const glm::dvec2& uv_dy) {
  const glm::dvec2 size(texture.width, texture.height);
  const glm::dvec2 a = uv_dx * size, b = uv_dy * size;
  const double square = std::max(glm::dot(a, a), glm::dot(b, b));
  if (!(square < 1e30)) return texture.levels - 1;
  const int level = std::ilogb(std::max(2 * square, 1.0)) >> 1;
  return std::min(level, texture.levels - 1);
}

/// Two neighbouring texels along one axis, and the share of the second.
struct Taps {
  int at[2];
  double second;
};

Taps taps_of(double position, int size) {
  const double within = position - std::floor(position);
  const double texel = (within > 0 ? std::min(within, 1.0) : 0.0) * size - 0.5;
  const int low = static_cast<int>(std::floor(texel));
  return {{(low + size) % size, (low + 1) % size}, texel - std::floor(texel)};
}

}  // namespace

Rgb<double> sample(const raster::PyramidView& texture, const glm::dvec2& uv,
                   const glm::dvec2& uv_dx, const glm::dvec2& uv_dy) {
  const int level = level_of(texture, uv_dx, uv_dy);
  const int width = std::max(1, texture.width >> level),
            height = std::max(1, texture.height >> level);
  const float* texels = texture.texels + 4 * std::ptrdiff_t{texture.level_start[level]};
  const Taps x = taps_of(uv.x, width), y = taps_of(uv.y, height);
  Rgb<double> sum{0, 0, 0};
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const double share = (i ? x.second : 1 - x.second) * (j ? y.second : 1 - y.second);
      const float* t = texels + 4 * (std::ptrdiff_t{y.at[j]} * width + x.at[i]);
      sum = sum + share * Rgb<double>{t[0], t[1], t[2]};
    }
  }
  return sum;
}

}  // namespace limpid::trace
