#include "judge/trace/texture.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace limpid::trace {
namespace {

/// log2 of the longer side in texels, rounded.
int level_of(const raster::PyramidView& texture, const TexturePlace& place) {
  const glm::dvec2 size(texture.width, texture.height);
  const glm::dvec2 a = place.dx * size, b = place.dy * size;
  const double square = std::max(glm::dot(a, a), glm::dot(b, b));
  if (!(square < 1e30)) return texture.levels - 1;
  const int level = std::ilogb(std::max(2 * square, 1.0)) >> 1;
  return std::min(level, texture.levels - 1);
}

/// Two neighbouring texels along one axis, and the weight of the second.
struct Taps {
  int at[2];
  double second;
};

/// Wraps into 0 ... 1.
double wrapped(double position, Wrap wrap) {
  double within = position;
  if (wrap == Wrap::kRepeat) within = position - std::floor(position);
  if (wrap == Wrap::kMirror) within = 1 - std::abs(1 - (position - 2 * std::floor(position / 2)));
  return within > 0 ? std::min(within, 1.0) : 0.0;
}

Taps taps_of(double position, Wrap wrap, int size) {
  const double texel = wrapped(position, wrap) * size - 0.5;
  const int low = static_cast<int>(std::floor(texel));
  const auto kept = [&](int at) {
    return wrap == Wrap::kRepeat ? (at + size) % size : std::clamp(at, 0, size - 1);
  };
  return {{kept(low), kept(low + 1)}, texel - std::floor(texel)};
}

}  // namespace

Texel sample(const raster::PyramidView& texture, const TextureLookup& lookup,
             const TexturePlace& place) {
  const int level = level_of(texture, place);
  const int width = std::max(1, texture.width >> level),
            height = std::max(1, texture.height >> level);
  const float* texels = texture.texels + 4 * std::ptrdiff_t{texture.level_start[level]};
  const Taps x = taps_of(place.uv.x, lookup.wrap_u, width),
             y = taps_of(place.uv.y, lookup.wrap_v, height);
  Texel sum{{0, 0, 0}, 0};
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const double share = (i ? x.second : 1 - x.second) * (j ? y.second : 1 - y.second);
      const float* t = texels + 4 * (std::ptrdiff_t{y.at[j]} * width + x.at[i]);
      sum.color = sum.color + share * Rgb<double>{t[0], t[1], t[2]};
      sum.alpha += share * t[3];
    }
  }
  return sum;
}

}  // namespace limpid::trace
