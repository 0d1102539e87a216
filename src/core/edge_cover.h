#pragma once
#include <vector>

#include "limpid/core/vec.h"

namespace limpid {

/// Pixels of wet water of which something before it covers a part, as at blurred edges: what is
/// seen there is color + (1 - cover) times the water's light.
struct EdgeCover {
  struct Pixel {
    int x = 0;
    float cover = 0;   ///< share of the pixel, 0 ... 1
    Rgb<float> color;  ///< of what covers it, times its share
  };
  int first_row = 0;
  std::vector<std::vector<Pixel>> rows;  ///< of the picture, from first_row on; x rises in each
};

}  // namespace limpid
