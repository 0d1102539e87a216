#include "limpid/core/texture_levels.h"

#include <algorithm>
#include <cmath>

#include "core/box_mean.h"
#include "core/mean_of_four.h"

namespace limpid {
namespace {

using Color = std::array<float, 3>;
using Moments = std::array<float, TextureLevels::kMoments>;

Color color_at(const Texture& map, int x, int y) {
  const Rect& window = map.channels[0].window;
  Color color;
  if (map.bytes) {  // exactly k / 255, independent of the reader's floats
    const std::uint32_t texel = map.bytes[std::ptrdiff_t{y} * (window.width() + 1) + x];
    for (int c = 0; c < 3; ++c) {
      color[static_cast<std::size_t>(c)] = static_cast<float>(texel >> (8 * c) & 255) / 255.0f;
    }
    return color;
  }
  for (std::size_t c = 0; c < 3; ++c) {
    const float value = map.channels[c].at(window.x0 + x, window.y0 + y);
    color[c] = value >= 0 ? std::min(value, 1.0f) : 0.0f;
  }
  return color;
}

std::uint32_t packed(const Color& color) {
  const auto part = [](float value, float most) {
    return static_cast<std::uint32_t>(value * most + 0.5f);
  };
  return part(color[0], 2047) | part(color[1], 2047) << 11 | part(color[2], 511) << 22;
}

Color unpacked(std::uint32_t texel) {
  const auto part = [](std::uint32_t value, float most) {
    return static_cast<float>(value) / most;
  };
  return {part(texel & 2047, 2047), part(texel >> 11 & 2047, 2047), part(texel >> 22, 511)};
}

/// As in WaveNormals::slopes().
Moments moments_of(const Color& color) {
  const float per_z = 1 / std::max(2 * color[2] - 1, 0.05f);
  const float x = (2 * color[0] - 1) * per_z, y = (2 * color[1] - 1) * per_z;
  return {x, y, x * x, x * y, y * y};
}

}  // namespace

Size halved(Size size) { return {std::max(size.width / 2, 1), std::max(size.height / 2, 1)}; }

LevelSizes levels_from(Size size) {
  LevelSizes sizes;
  for (;; size = halved(size)) {
    const int level = sizes.count++;
    sizes.width[level] = size.width;
    sizes.height[level] = size.height;
    sizes.first[level] = static_cast<std::int32_t>(sizes.texels);
    sizes.texels += rect_of({size.width + 1, size.height + 1}).area();
    if (size.width == 1 && size.height == 1) return sizes;
  }
}

void LevelMaker::make(const Texture& map) {
  const Size whole = map.channels[0].window.size();
  const LevelSizes sizes = levels_from(halved(whole));
  texels_.resize(static_cast<std::size_t>(sizes.texels));
  const auto texel = [&](int level, int x, int y) -> std::uint32_t& {
    return texels_[static_cast<std::size_t>(sizes.place(level, x, y))];
  };
  for (int level = 0; level < sizes.count; ++level) {
    const Size to = sizes.size(level), from = level == 0 ? whole : sizes.size(level - 1);
    for (int y = 0; y <= to.height; ++y) {
      for (int x = 0; x <= to.width; ++x) {
        texel(level, x, y) =
            y == to.height || x == to.width
                ? texel(level, x % to.width, y % to.height)
                : packed(box_mean<3>(from, to, x, y, [&](int i, int j) {
                    return level == 0 ? color_at(map, i, j) : unpacked(texel(level - 1, i, j));
                  }));
      }
    }
  }
  Size base = whole;
  int halvings = 0;
  for (; std::max(base.width, base.height) > TextureLevels::kMaxBase; ++halvings) {
    base = halved(base);
  }
  const std::size_t plane = static_cast<std::size_t>(rect_of(base).area());
  moments_.resize(plane * TextureLevels::kMoments);
  for (int y = 0; y < base.height; ++y) {
    for (int x = 0; x < base.width; ++x) {
      const Moments mean = box_mean<TextureLevels::kMoments>(
          whole, base, x, y, [&](int i, int j) { return moments_of(color_at(map, i, j)); });
      const std::size_t at = static_cast<std::size_t>(y) * base.width + x;
      for (std::size_t c = 0; c < mean.size(); ++c) moments_[c * plane + at] = mean[c];
    }
  }
  levels_ = {sizes, texels_.data(), base, halvings, moments_.data()};
}

Sym2<double> slope_variance(const TextureLevels& map, const FourShifts& shifts) {
  const Size base = map.base;
  const std::int64_t area = rect_of(base).area();
  const double within = map.halvings > 0 ? kept_within(shifts, base) : 0;
  float h_x[TextureLevels::kMaxBase], h_y[TextureLevels::kMaxBase];
  const auto moment = [&](int c, std::ptrdiff_t at) -> double {
    return map.moments[c * area + at];
  };
  Vec2<double> mean{0, 0};
  Sym2<double> square{0, 0, 0};
  for (int y = 0; y < base.height; ++y) {
    mean_of_four(map.moments, base, shifts, y, h_x);
    mean_of_four(map.moments + area, base, shifts, y, h_y);
    for (int x = 0; x < base.width; ++x) {
      const double u = h_x[x], v = h_y[x];
      mean = mean + Vec2<double>{u, v};
      square = square + Sym2<double>{u * u, u * v, v * v};
    }
    for (int x = 0; x < base.width && within > 0; ++x) {
      const std::ptrdiff_t at = std::ptrdiff_t{y} * base.width + x;
      const double u = moment(0, at), v = moment(1, at);
      square = square + within * Sym2<double>{moment(2, at) - u * u, moment(3, at) - u * v,
                                              moment(4, at) - v * v};
    }
  }
  const double share = 1.0 / static_cast<double>(area);
  mean = share * mean;
  return share * square + -1.0 * Sym2<double>{mean.x * mean.x, mean.x * mean.y, mean.y * mean.y};
}

}  // namespace limpid
