#pragma once
#include <algorithm>
#include <array>

#include "limpid/core/rect.h"

namespace limpid {

/// Mean of at(x, y), N floats per texel, over the area in a picture of size `from` that corresponds
/// to the texel (x, y) of a picture of size `to`.
template <int N, class At>
std::array<float, N> box_mean(Size from, Size to, int x, int y, const At& at) {
  struct Span {
    double low, high;
    int first, last;
    Span(int i, int of, int texels)
        : low(double(i) * texels / of),
          high(double(i + 1) * texels / of),
          first(static_cast<int>(low)),
          last(std::min(static_cast<int>(high), texels - 1)) {}
    double share(int k) const {
      return std::max(std::min(high, k + 1.0) - std::max(low, double(k)), 0.0) / (high - low);
    }
  };
  const Span across(x, to.width, from.width), down(y, to.height, from.height);
  std::array<float, N> mean{};
  for (int j = down.first; j <= down.last; ++j) {
    for (int i = across.first; i <= across.last; ++i) {
      const float share = static_cast<float>(across.share(i) * down.share(j));
      if (share == 0) continue;
      const std::array<float, N> texel = at(i, j);
      for (std::size_t c = 0; c < N; ++c) mean[c] += share * texel[c];
    }
  }
  return mean;
}

}  // namespace limpid
