#pragma once
#include "limpid/core/number.h"

namespace limpid {

/// Bounds on the texels of any box of a plane: blocks of texels, each with a Cell, and a pyramid in
/// which each cell is the join() of four cells of the level below. Made once per frame
/// (complete/heights.h). Ray marches skip steps by it, as Uludag 2014, "Hi-Z Screen-Space
/// Cone-Traced Reflections", skips them by depths. A view: the memory belongs to the caller.
template <class Cell>
struct BlockPyramid {
  static constexpr int kWidth = 16, kHeight = 8;  ///< texels of a block
  static constexpr int kMaxLevels = 32;
  static constexpr int kMaxCells = 16;  ///< the most cells read for a box
  struct Level {
    const Cell* cells;
    int across;  ///< blocks in a row
  };

  Level levels[kMaxLevels] = {};
  int x0 = 0, y0 = 0;  ///< the first texel of the first block
  bool known = false;  ///< false: nothing is known, of() must not be called

  /// The bounds of the texels x_low ... x_high, y_low ... y_high, all of which lie in blocks. They
  /// may include some texels around the box.
  LIMPID_INLINE Cell of(int x_low, int y_low, int x_high, int y_high) const {
    int left = (x_low - x0) / kWidth, right = (x_high - x0) / kWidth;
    int top = (y_low - y0) / kHeight, bottom = (y_high - y0) / kHeight;
    const Level* level = levels;
    // A long, narrow box must not be bounded by wide cells.
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
