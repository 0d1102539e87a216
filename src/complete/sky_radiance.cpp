#include "complete/sky_radiance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace limpid {

Rgb<double> sky_radiance(const Texture& environment) {
  constexpr int kMost = 256;
  const Rect window = environment.channels[0].window;
  const int rows = window.height(), columns = window.width();
  const int step_y = std::max(1, rows / kMost), step_x = std::max(1, columns / kMost);
  std::array<double, 3> sums{};
  double weights = 0;
  for (int y = 0; y < rows; y += step_y) {
    const double polar = std::numbers::pi * (y + 0.5) / rows;
    if (polar >= std::numbers::pi / 2) break;
    const double weight = std::cos(polar) * std::sin(polar);
    for (int x = 0; x < columns; x += step_x) {
      for (std::size_t c = 0; c < 3; ++c) {
        sums[c] += weight * environment.channels[c].at(window.x0 + x, window.y0 + y);
      }
      weights += weight;
    }
  }
  if (!(weights > 0)) return {0, 0, 0};
  return {sums[0] / weights, sums[1] / weights, sums[2] / weights};
}

}  // namespace limpid
