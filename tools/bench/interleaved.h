#pragma once
#include <span>
#include <vector>

#include "limpid/core/plane.h"

namespace limpid::bench {

/// Planes of one window, interleaved: a0 b0 c0 a1 b1 c1 ...
inline std::vector<float> interleaved(std::span<const View<const float>> planes) {
  const Rect& w = planes[0].window;
  std::vector<float> pixels;
  pixels.reserve(planes.size() * static_cast<std::size_t>(w.area()));
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) {
      for (const View<const float>& plane : planes) pixels.push_back(plane.at(x, y));
    }
  }
  return pixels;
}

}  // namespace limpid::bench
