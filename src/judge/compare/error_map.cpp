#include <algorithm>
#include <limits>

#include "judge/compare/error_map_of.h"
#include "judge/compare/number_text.h"

namespace limpid {

ErrorMap error_map_of(const Grid<float>& error, const CleanPair& pictures) {
  ErrorMap result;
  result.map = Plane(pictures.window);
  std::vector<float> values(error.count());
  const Rect window = pictures.window;
  double sum = 0;
  std::size_t i = 0;
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x, ++i) {
      const bool mismatched = pictures.mismatched[i] != 0;
      values[i] = mismatched ? std::numeric_limits<float>::infinity() : error[i];
      result.mismatches += mismatched;
      result.map.view().at(x, y) = values[i];
      sum += values[i];
    }
  }
  std::sort(values.begin(), values.end());
  result.mean = sum / static_cast<double>(values.size());
  result.max = values.back();
  result.p99 = values[(values.size() * 99 + 99) / 100 - 1];
  double below = 0;
  for (const float value : values) {
    below += value;
    result.weighted_median = value;
    if (below >= 0.5 * sum) break;
  }
  return result;
}

std::string to_text(const ErrorMap& error) {
  return number_text(error.mean) + ", weighted median " + number_text(error.weighted_median) +
         ", 99% " + number_text(error.p99) + ", max " + number_text(error.max);
}

}  // namespace limpid
