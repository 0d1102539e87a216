#pragma once
#include <functional>

#include "limpid/core/plane.h"

namespace limpid {

/// At the pixel (x, y).
using PixelValue = std::function<double(int x, int y)>;

/// A plane of the values at its pixels.
inline Plane plane_of(const Rect& window, const PixelValue& value) {
  Plane plane(window);
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) {
      plane.view().at(x, y) = static_cast<float>(value(x, y));
    }
  }
  return plane;
}

}  // namespace limpid
