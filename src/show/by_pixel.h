#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "files/picture/byte_of.h"
#include "show/shown.h"

/// Loops over the pixels of a window, on all threads, that fill a picture.

namespace limpid {

using ShownColor = std::array<float, 3>;  ///< encoded for display, 0 ... 1

inline constexpr int kRowsAtOnce = 16;

/// Calls show(y0, y1, to) for bands of rows; `to` is the address of row y0.
template <class Show>
Shown in_bands(const Rect& window, Executor& executor, const Show& show) {
  Shown shown{window.size(), std::vector<std::uint8_t>(4 * window.area()), {}};
  const int bands = (window.height() + kRowsAtOnce - 1) / kRowsAtOnce;
  run_each(executor, bands, [&](int band) {
    const int y0 = window.y0 + band * kRowsAtOnce, y1 = std::min(y0 + kRowsAtOnce, window.y1);
    const auto first = std::size_t{4} * band * kRowsAtOnce * window.width();
    show(y0, y1, shown.rgba.data() + first);
  });
  return shown;
}

/// Calls color_at(x, y) for each pixel.
template <class ColorAt>
Shown by_pixel(const Rect& window, Executor& executor, const ColorAt& color_at) {
  return in_bands(window, executor, [&](int y0, int y1, std::uint8_t* to) {
    for (int y = y0; y < y1; ++y) {
      for (int x = window.x0; x < window.x1; ++x, to += 4) {
        const ShownColor color = color_at(x, y);
        for (int c = 0; c < 3; ++c) to[c] = byte_of(color[c]);
        to[3] = 255;
      }
    }
  });
}

}  // namespace limpid
