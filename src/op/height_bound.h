#pragma once
#include <cmath>

#include "limpid/core/frame.h"

#include "op/block_pyramid.h"

namespace limpid {

/// Bounds on what refraction may see in some texels, as heights over the calm surface, from above.
struct SeenHeights {
  /// No surface under water is seen above this height, even if the water is as high as
  /// HeightBound::most; -inf where there is none, +inf where it is not known.
  float highest = HUGE_VALF;
  /// No surface is seen farther below the calm surface; +inf where one is infinitely far.
  float deepest = HUGE_VALF;
  /// All texels lie under the surface in front of them, deep enough to count for any lookup whose
  /// ray ends above this height; +inf where that is not known.
  float covers = HUGE_VALF;

  static LIMPID_INLINE float greater(float a, float b) { return a < b ? b : a; }
  static LIMPID_INLINE SeenHeights join(const SeenHeights& a, const SeenHeights& b) {
    return {greater(a.highest, b.highest), greater(a.deepest, b.deepest),
            greater(a.covers, b.covers)};
  }
};

/// Bounds on the depth plane that refraction looks up.
struct HeightBound : BlockPyramid<SeenHeights> {
  float most = 0;  ///< height of the highest wave; surfaces above it stand in front of the water
                   ///< and do not count
};

/// Least and greatest value of the texels that count; +inf and -inf if none does.
struct SeenRange {
  float low = -HUGE_VALF, high = HUGE_VALF;

  static LIMPID_INLINE SeenRange join(const SeenRange& a, const SeenRange& b) {
    return {a.low < b.low ? a.low : b.low, a.high < b.high ? b.high : a.high};
  }
};

/// Bounds on the values of a plane.
struct RangeBound : BlockPyramid<SeenRange> {
  PlaneId plane = PlaneId::kDepth;
};

}  // namespace limpid
