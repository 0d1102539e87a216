#include "judge/compare/shown_difference.h"

#include <algorithm>
#include <cmath>

#include "judge/compare/compare.h"
#include "show/by_pixel.h"
#include "show/heat_color.h"

namespace limpid {
namespace {

constexpr double kShownDifference = 0.25;

}  // namespace

Shown shown_difference(const ShownViews& a, const ShownViews& b, double exposure,
                       Executor& executor) {
  const double most = kShownDifference * std::exp2(-exposure);
  Shown shown = by_pixel(a[0].window, executor, [&](int x, int y) {
    double largest = 0;
    for (int c = 0; c < 3; ++c) {
      largest = std::max(largest, difference(a[c].at(x, y), b[c].at(x, y)));
    }
    return heat_color(largest / most);
  });
  shown.scale = {0, most};
  return shown;
}

}  // namespace limpid
