#pragma once
#include "limpid/core/number.h"

namespace limpid {

/// For any box of texels a height over the calm surface above which nothing is seen there that lies
/// under water, be it as high as `most`: blocks of texels, and a pyramid of them in which each
/// holds the greatest of four of the level before. Made once a frame (complete/heights.h); tells a
/// march which steps need no look, as Uludag 2014, "Hi-Z Screen-Space Cone-Traced Reflections",
/// does with depths. A view of somebody's memory.
struct HeightBound {
  static constexpr int kWidth = 32, kHeight = 16;  ///< texels a block
  static constexpr int kMostLevels = 32;
  struct Level {
    const float* heights;
    int across;  ///< in a row
  };

  Level levels[kMostLevels] = {};
  int x0 = 0, y0 = 0;  ///< the first texel of the first block
  float most = 0;      ///< of all water; what surely stands higher is nearer and does not count
  bool known = false;  ///< false: there is nothing to ask

  /// Of the texels x_low ... x_high, y_low ... y_high, all of which lie in blocks; -inf where
  /// nothing is seen, +inf where all may be.
  LIMPID_INLINE float highest(int x_low, int y_low, int x_high, int y_high) const {
    int left = (x_low - x0) / kWidth, right = (x_high - x0) / kWidth;
    int top = (y_low - y0) / kHeight, bottom = (y_high - y0) / kHeight;
    const Level* level = levels;
    for (; right - left > 1 || bottom - top > 1; ++level) {
      left >>= 1, right >>= 1, top >>= 1, bottom >>= 1;
    }
    const float* upper = level->heights + top * level->across;
    const float* lower = level->heights + bottom * level->across;
    const float above = upper[left] < upper[right] ? upper[right] : upper[left];
    const float below = lower[left] < lower[right] ? lower[right] : lower[left];
    return above < below ? below : above;
  }
};

}  // namespace limpid
