#pragma once
#include <array>

#include "limpid/core/plane.h"

namespace limpid {

/// Red, green and blue of one picture, scene-linear, with the primaries of sRGB (ITU-R BT.709).
using ColorViews = std::array<View<const float>, 3>;

/// Two pictures for the metrics of color; `b` is the reference. All windows must be equal.
///
/// NaN and inf: a pixel with NaN or inf in either picture counts as black in both. If the two
/// differ there in the sense of difference() (a *mismatch*: NaN or inf in only one), the metric
/// returns the worst value, an infinite error, so that no mean and no maximum can look good.
struct ColorPair {
  ColorViews a, b;
};

}  // namespace limpid
