#pragma once
#include <vector>

#include "limpid/core/vec.h"

namespace limpid {

/// Wet pixels that an object in front of the water covers in part, as at blurred edges: the visible
/// light is color + (1 - cover) times the water's light.
struct EdgeCover {
  struct Pixel {
    int x = 0;
    float cover = 0;   ///< share of the pixel, 0 ... 1
    Rgb<float> color;  ///< of the covering object, times its share
  };
  int first_row = 0;
  std::vector<std::vector<Pixel>> rows;  ///< of the picture, from first_row on; x rises in each
};

}  // namespace limpid
