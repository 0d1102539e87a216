#include "show/heat_color.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace limpid {
namespace {

// sRGB, 8 bits, at 0, 1/8 ... 1.
constexpr std::array<std::array<float, 3>, 9> kViridis = {{{68, 1, 84},
                                                           {71, 45, 123},
                                                           {59, 82, 139},
                                                           {44, 114, 142},
                                                           {33, 145, 140},
                                                           {40, 174, 128},
                                                           {94, 201, 98},
                                                           {173, 220, 48},
                                                           {253, 231, 37}}};

}  // namespace

std::array<float, 3> heat_color(double place) {
  // NaN counts as 0.
  const double at = (place > 0 ? std::min(place, 1.0) : 0.0) * (kViridis.size() - 1);
  const auto lower = std::min(static_cast<std::size_t>(at), kViridis.size() - 2);
  const auto t = static_cast<float>(at - static_cast<double>(lower));
  std::array<float, 3> color;
  for (std::size_t c = 0; c < 3; ++c) {
    color[c] = std::lerp(kViridis[lower][c], kViridis[lower + 1][c], t) / 255;
  }
  return color;
}

}  // namespace limpid
