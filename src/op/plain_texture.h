#pragma once
#include <algorithm>
#include <cmath>

#include "limpid/core/frame.h"
#include "limpid/core/texture_levels.h"
#include "limpid/core/vec.h"

/// Bilinear lookups in textures, in double and as simple as possible: the standard for the fast
/// lookups.

namespace limpid {

/// Positions in periods; 0 for an infinite position, so that every tap lies in the texture.
inline double tiled_at(const View<const float>& view, Vec2<double> periods) {
  const int width = view.window.width(), height = view.window.height();
  const auto fraction = [](double p) { return max(p - std::floor(p), 0.0); };
  const double x = fraction(periods.x) * width - 0.5, y = fraction(periods.y) * height - 0.5;
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  const auto at = [&](int i, int j) -> double {
    return view.at(view.window.x0 + (i + width) % width, view.window.y0 + (j + height) % height);
  };
  const double u = x - x0, v = y - y0;
  return lerp(lerp(at(x0, y0), at(x0 + 1, y0), u), lerp(at(x0, y0 + 1), at(x0 + 1, y0 + 1), u), v);
}

/// Bilinear filtering of at(place) over four texels of a level.
template <class At>
LIMPID_INLINE auto mixed_level(const LevelSizes& sizes, int level, Vec2<double> periods,
                               const At& at) {
  const int width = sizes.width[level], height = sizes.height[level];
  const auto fraction = [](double p) { return max(p - std::floor(p), 0.0); };
  const double x = fraction(periods.x) * width - 0.5, y = fraction(periods.y) * height - 0.5;
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  const double u = x - x0, v = y - y0;
  const auto texel = [&](int i, int j) {
    return at(sizes.place(level, (i + width) % width, (j + height) % height));
  };
  return (1 - v) * ((1 - u) * texel(x0, y0) + u * texel(x0 + 1, y0)) +
         v * ((1 - u) * texel(x0, y0 + 1) + u * texel(x0 + 1, y0 + 1));
}

/// Blends two levels for a pixel that is `width` texels of the first level wide, at least 1: the
/// level whose texel is 2^k of them, and the next one. The transition takes a quarter of the
/// interval between two levels.
template <class At>
LIMPID_INLINE auto between_levels(const LevelSizes& sizes, double width, Vec2<double> periods,
                                  const At& at) {
  int exponent = 0;
  std::frexp(width, &exponent);
  const int last = sizes.count - 1, level = std::min(exponent - 1, last);
  const double between = std::ldexp(width, -level) - 1;
  const double rest = level == last ? 0 : saturate(4 * between - 1.5);
  return (1 - rest) * mixed_level(sizes, level, periods, at) +
         rest * mixed_level(sizes, std::min(level + 1, last), periods, at);
}

/// Wraps around in x and ends at the poles in y (optics/surroundings.h).
inline double lat_long_at(const View<const float>& view, Vec2<double> place) {
  const int width = view.window.width(), height = view.window.height();
  const double x = (place.x - std::floor(place.x)) * width - 0.5, y = place.y * height - 0.5;
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  const auto at = [&](int i, int j) -> double {
    return view.at(view.window.x0 + (i + width) % width,
                   view.window.y0 + std::clamp(j, 0, height - 1));
  };
  const double u = x - x0, v = y - y0;
  return lerp(lerp(at(x0, y0), at(x0 + 1, y0), u), lerp(at(x0, y0 + 1), at(x0 + 1, y0 + 1), u), v);
}

inline Rgb<double> tiled_rgb_at(const Texture& texture, Vec2<double> periods) {
  return {tiled_at(texture.channels[0], periods), tiled_at(texture.channels[1], periods),
          tiled_at(texture.channels[2], periods)};
}

/// The map for a pixel that is `width` texels wide. For a pixel of one texel or less, the map
/// itself.
inline Rgb<double> tiled_rgb_at(const Texture& texture, Vec2<double> periods, double width) {
  const double share = saturate(4 * width - 5.5);  // as between two levels
  if (!texture.levels || !(share > 0)) return tiled_rgb_at(texture, periods);
  const TextureLevels& levels = *texture.levels;
  const auto texel = [&](std::int32_t place) {
    const std::uint32_t rgb = levels.texels[place];
    return Rgb<double>{(rgb & 2047) / 2047.0, (rgb >> 11 & 2047) / 2047.0, (rgb >> 22) / 511.0};
  };
  const Rgb<double> far = between_levels(levels.sizes, max(width / 2, 1.0), periods, texel);
  if (share >= 1) return far;
  const Rgb<double> near = tiled_rgb_at(texture, periods);
  return near + share * (far - near);
}

/// For a pixel that is `width` texels of the first level wide.
inline SlopeMoments<double> tiled_slopes_at(const SlopeLevels& levels, Vec2<double> periods,
                                            double width) {
  const auto texel = [&](std::int32_t place) {
    const auto at = [&](int c) -> double { return levels.planes[c][place]; };
    return SlopeMoments<double>{{at(0), at(1)}, {at(2), at(3), at(4)}};
  };
  return between_levels(levels.sizes, max(width, 1.0), periods, texel);
}

inline Rgb<double> lat_long_rgb_at(const Texture& texture, Vec2<double> place) {
  return {lat_long_at(texture.channels[0], place), lat_long_at(texture.channels[1], place),
          lat_long_at(texture.channels[2], place)};
}

/// The place of a bilinear lookup in a table that ends at its edges; `at` in texels from the centre
/// of the first texel. For any table of that size.
struct GridSpot {
  int x0, y0, x1, y1;
  double u, v;

  GridSpot(const View<const float>& table, Vec2<double> at) {
    const int width = table.window.width(), height = table.window.height();
    const double x = min(max(at.x, 0.0), double(width - 1));
    const double y = min(max(at.y, 0.0), double(height - 1));
    x0 = std::min(static_cast<int>(x), std::max(width - 2, 0));
    y0 = std::min(static_cast<int>(y), std::max(height - 2, 0));
    x1 = std::min(x0 + 1, width - 1), y1 = std::min(y0 + 1, height - 1);
    u = x - x0, v = y - y0;
  }
  double read(const View<const float>& table) const {
    const auto texel = [&](int i, int j) -> double {
      return table.at(table.window.x0 + i, table.window.y0 + j);
    };
    return lerp(lerp(texel(x0, y0), texel(x1, y0), u), lerp(texel(x0, y1), texel(x1, y1), u), v);
  }
};

inline double grid_at(const View<const float>& table, Vec2<double> at) {
  return GridSpot(table, at).read(table);
}

}  // namespace limpid
