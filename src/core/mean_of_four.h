#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "limpid/core/texture_levels.h"

namespace limpid {

/// A shift along an axis as texels and the weight of the next texel. NaN shifts by 0.
struct Moved {
  int texels = 0;
  float rest = 0;
  Moved(double periods, int size) {
    if (!std::isfinite(periods)) return;
    const double at = (periods - std::floor(periods)) * size, whole = std::floor(at);
    texels = static_cast<int>(whole) % size;
    rest = static_cast<float>(at - whole);
  }
};

/// to[x] += weight * from[(x + shift) % width], 0 <= shift < width.
inline void add_turned(const float* from, int width, int shift, float weight, float* to) {
  const int until = width - shift;
  for (int x = 0; x < until; ++x) to[x] += weight * from[x + shift];
  for (int x = until; x < width; ++x) to[x] += weight * from[x - until];
}

/// Means of a row of one repeating plane, over the four lookups.
inline void mean_of_four(const float* plane, Size size, const FourShifts& shifts, int y,
                         float* to) {
  std::fill_n(to, size.width, 0.0f);
  for (const Vec2<double>& shift : shifts.of) {
    const Moved x(shift.x, size.width), down(shift.y, size.height);
    for (int j = 0; j < 2; ++j) {
      const float of_row = j == 0 ? 1 - down.rest : down.rest;
      const float* row = plane + std::ptrdiff_t{(y + down.texels + j) % size.height} * size.width;
      for (int i = 0; i < 2; ++i) {
        const float weight = 0.25f * of_row * (i == 0 ? 1 - x.rest : x.rest);
        if (weight != 0) add_turned(row, size.width, (x.texels + i) % size.width, weight, to);
      }
    }
  }
}

/// Share of the variance within texels that the mean of the four keeps.
inline double kept_within(const FourShifts& shifts, Size size) {
  double sum = 0;
  for (const Vec2<double>& a : shifts.of) {
    for (const Vec2<double>& b : shifts.of) {
      const double x = std::remainder(a.x - b.x, 1.0) * size.width;
      const double y = std::remainder(a.y - b.y, 1.0) * size.height;
      sum += std::max(1 - std::hypot(x, y), 0.0) / 16;
    }
  }
  return sum;
}

}  // namespace limpid
