#pragma once
#include "limpid/core/number.h"

namespace limpid {

/// What a Cell tells of any box of texels of a plane: blocks of texels, and a pyramid of them in
/// which each cell is the join() of four of the level before. Made once a frame
/// (complete/heights.h); tells a march which steps need no look, as Uludag 2014, "Hi-Z Screen-Space
/// Cone-Traced Reflections", does with depths. A view of somebody's memory.
template <class Cell>
struct BlockPyramid {
  static constexpr int kWidth = 16, kHeight = 8;  ///< texels a block
  static constexpr int kMaxLevels = 32;
  static constexpr int kMaxCells = 16;  ///< that are looked at for a box
  struct Level {
    const Cell* cells;
    int across;  ///< in a row
  };

  Level levels[kMaxLevels] = {};
  int x0 = 0, y0 = 0;  ///< the first texel of the first block
  bool known = false;  ///< false: there is nothing to ask

  /// Of the texels x_low ... x_high, y_low ... y_high, all of which lie in blocks, and of some
  /// around them.
  LIMPID_INLINE Cell of(int x_low, int y_low, int x_high, int y_high) const {
    int left = (x_low - x0) / kWidth, right = (x_high - x0) / kWidth;
    int top = (y_low - y0) / kHeight, bottom = (y_high - y0) / kHeight;
    const Level* level = levels;
    // Long and narrow boxes are not to be answered by wide ones.
    for (; (right - left + 1) * (bottom - top + 1) > kMaxCells; ++level) {
      left >>= 1, right >>= 1, top >>= 1, bottom >>= 1;
    }
    const Cell* row = level->cells + top * level->across;
    Cell all = row[left];
    for (int y = top; y <= bottom; ++y, row += level->across) {
      for (int x = left; x <= right; ++x) all = Cell::join(all, row[x]);
    }
    return all;
  }
};

}  // namespace limpid
