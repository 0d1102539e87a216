#pragma once
#include <algorithm>
#include <cmath>

#include "limpid/core/frame.h"
#include "limpid/core/vec.h"

/// Bilinear lookups in textures, in double and as plain as can be: what the fast ones are judged
/// by.

namespace limpid {

/// Positions in periods; 0 for an infinite one, so that every tap lies in the texture.
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

/// Goes round in x and ends at the poles in y (optics/surroundings.h).
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

inline Rgb<double> lat_long_rgb_at(const Texture& texture, Vec2<double> place) {
  return {lat_long_at(texture.channels[0], place), lat_long_at(texture.channels[1], place),
          lat_long_at(texture.channels[2], place)};
}

}  // namespace limpid
