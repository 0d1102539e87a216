#pragma once
#include <cmath>

#include "limpid/core/frame.h"

#include "op/block_pyramid.h"

namespace limpid {

/// What refraction may see in some texels, as heights over the calm surface, seen from above.
struct SeenHeights {
  /// Nothing that lies under water, be it as high as HeightBound::most, is seen above it: -inf
  /// where there is nothing, +inf where all may be.
  float highest = HUGE_VALF;
  /// Nothing is seen farther below the calm surface; +inf where something is infinitely far.
  float deepest = HUGE_VALF;
  /// All texels lie under the surface in front of them, and so far that they count for any lookup
  /// whose ray ends above this; +inf where that is not known.
  float covers = HUGE_VALF;

  static LIMPID_INLINE float greater(float a, float b) { return a < b ? b : a; }
  static LIMPID_INLINE SeenHeights join(const SeenHeights& a, const SeenHeights& b) {
    return {greater(a.highest, b.highest), greater(a.deepest, b.deepest),
            greater(a.covers, b.covers)};
  }
};

/// Of the depth plane that refraction looks up.
struct HeightBound : BlockPyramid<SeenHeights> {
  float most = 0;  ///< of all water; what surely stands higher is nearer and does not count
};

/// Least and greatest value in some texels; of those that count, be there none, +inf and -inf.
struct SeenRange {
  float low = -HUGE_VALF, high = HUGE_VALF;

  static LIMPID_INLINE SeenRange join(const SeenRange& a, const SeenRange& b) {
    return {a.low < b.low ? a.low : b.low, a.high < b.high ? b.high : a.high};
  }
};

/// Of a plane.
struct RangeBound : BlockPyramid<SeenRange> {
  PlaneId plane = PlaneId::kDepth;
};

}  // namespace limpid
