#include "judge/compare/color_grids.h"

#include <cmath>

#include "judge/compare/compare.h"
#include "judge/compare/compared_channels.h"

namespace limpid {

CleanPair clean(const ColorPair& pictures) {
  const ComparedChannel channels[] = {{"R", pictures.a[0], pictures.b[0]},
                                      {"G", pictures.a[1], pictures.b[1]},
                                      {"B", pictures.a[2], pictures.b[2]}};
  check_compared(channels);
  const Rect window = pictures.a[0].window;
  const Grid<float> empty(window.size());
  CleanPair result{
      window, {empty, empty, empty}, {empty, empty, empty}, Grid<std::uint8_t>(window.size())};
  std::size_t i = 0;
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x, ++i) {
      bool finite = true;
      for (std::size_t c = 0; c < 3; ++c) {
        const float a = pictures.a[c].at(x, y), b = pictures.b[c].at(x, y);
        finite &= std::isfinite(a) && std::isfinite(b);
        result.mismatched[i] |= std::isinf(difference(a, b));
        result.a[c][i] = a;
        result.b[c][i] = b;
      }
      for (std::size_t c = 0; c < 3 && !finite; ++c) result.a[c][i] = result.b[c][i] = 0;
    }
  }
  return result;
}

}  // namespace limpid
