#pragma once
#include "core/lanes.h"

/// Lanes of doubles, with vectors of as many floats and ints. For inclusion by raster_target.cpp
/// alone.

namespace limpid::HWY_NAMESPACE {

using WD = hn::ScalableTag<double>;
using WF = hn::Rebind<float, WD>;
using WI = hn::Rebind<std::int32_t, WD>;
using VWD = hn::Vec<WD>;
using VWF = hn::Vec<WF>;
using VWI = hn::Vec<WI>;
using MWD = hn::Mask<WD>;

constexpr WD kWD;
constexpr WF kWF;
constexpr WI kWI;
constexpr int kWide = static_cast<int>(hn::MaxLanes(WD()));

LIMPID_LANES_INLINE VWD wide(double x) { return hn::Set(kWD, x); }
LIMPID_LANES_INLINE VWD wide(VWI x) { return hn::PromoteTo(kWD, x); }
LIMPID_LANES_INLINE VWD wide(VWF x) { return hn::PromoteTo(kWD, x); }

/// An affine function of x and y, or of a point, at the lanes' values.
LIMPID_LANES_INLINE VWD affine(double a, VWD x, double b, VWD y, VWD c) {
  return hn::MulAdd(wide(a), x, hn::MulAdd(wide(b), y, c));
}
LIMPID_LANES_INLINE VWD dot_wide(const double* row, VWD x, VWD y, VWD z) {
  return hn::MulAdd(wide(row[0]), x, hn::MulAdd(wide(row[1]), y, hn::Mul(wide(row[2]), z)));
}

}  // namespace limpid::HWY_NAMESPACE
