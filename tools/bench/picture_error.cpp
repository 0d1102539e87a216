#include "picture_error.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace limpid::bench {

PictureError error_of(const Target& judge, const Target& got) {
  const Rect& w = judge.color[0].window;
  std::vector<double> errors;
  errors.reserve(3 * static_cast<std::size_t>(w.area()));
  double sum = 0;
  for (int c = 0; c < 3; ++c) {
    for (int y = w.y0; y < w.y1; ++y) {
      for (int x = w.x0; x < w.x1; ++x) {
        const double error = std::abs(double(judge.color[c].at(x, y)) - got.color[c].at(x, y));
        errors.push_back(std::isnan(error) ? HUGE_VAL : error);
        sum += errors.back();
      }
    }
  }
  const double count = static_cast<double>(errors.size());
  const auto at = errors.begin() + static_cast<std::ptrdiff_t>(0.9999 * (count - 1));
  std::nth_element(errors.begin(), at, errors.end());
  return {sum / count, *at, *std::max_element(at, errors.end())};
}

}  // namespace limpid::bench
