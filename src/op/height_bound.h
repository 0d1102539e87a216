#pragma once
#include <cmath>

#include "limpid/core/frame.h"

#include "op/block_pyramid.h"

namespace limpid {

/// Upper bounds on the surfaces that refraction may see in some texels, as heights over the calm
/// surface.
struct SeenHeights {
  /// No surface under water is above this height, even if the water is as high as
  /// HeightBound::most; -inf without such surfaces, +inf if unknown.
  float highest = HUGE_VALF;
  /// No surface is deeper than this below the calm surface; +inf if one is infinitely far.
  float deepest = HUGE_VALF;
  /// All texels lie under the surface in front of them, deep enough to be accepted by any lookup
  /// whose ray ends above this height; +inf if unknown.
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
