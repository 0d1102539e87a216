#pragma once
#include <array>

#include "limpid/core/plane.h"

namespace limpid {

/// Red, green and blue of one picture, scene-linear, of the primaries of sRGB (ITU-R BT.709).
using ColorViews = std::array<View<const float>, 3>;

/// Two pictures for the metrics of color; `b` is the one to be trusted. All windows must be equal.
///
/// What the metrics do where a number is none: a pixel with NaN or inf in either picture counts as
/// black in both. Where the two differ there as difference() has it (a *mismatch*: NaN or inf in
/// one only), the metric says the worst there is, an infinite error, so that no mean and no maximum
/// can look good.
struct ColorPair {
  ColorViews a, b;
};

}  // namespace limpid
