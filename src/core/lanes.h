#pragma once
#include <numbers>

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

/// The number type of the fused pass: a SIMD vector of float lanes, with the functions that
/// formulas call (see core/number.h). For inclusion by the *_target.cpp files alone, which are
/// compiled once for each instruction set: all names here live in Highway's namespace for that set,
/// so that no two copies share a symbol.

namespace limpid::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<float>;
using DI = hn::ScalableTag<std::int32_t>;
using V = hn::Vec<D>;
using VI = hn::Vec<DI>;
using M = hn::Mask<D>;

constexpr D kD;
constexpr DI kDI;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(D()));

#define LIMPID_LANES_INLINE inline __attribute__((always_inline))
#define LIMPID_LANES_LAMBDA __attribute__((always_inline))

struct Mask {
  M m;
  friend LIMPID_LANES_INLINE Mask operator&&(Mask a, Mask b) { return {hn::And(a.m, b.m)}; }
  friend LIMPID_LANES_INLINE Mask operator||(Mask a, Mask b) { return {hn::Or(a.m, b.m)}; }
  friend LIMPID_LANES_INLINE Mask operator!(Mask a) { return {hn::Not(a.m)}; }
};

struct Lane {
  V v;
  Lane() = default;
  LIMPID_LANES_INLINE explicit Lane(double x) : v(hn::Set(kD, static_cast<float>(x))) {}
  LIMPID_LANES_INLINE explicit Lane(V x) : v(x) {}

  friend LIMPID_LANES_INLINE Lane operator+(Lane a, Lane b) { return Lane(hn::Add(a.v, b.v)); }
  friend LIMPID_LANES_INLINE Lane operator-(Lane a, Lane b) { return Lane(hn::Sub(a.v, b.v)); }
  friend LIMPID_LANES_INLINE Lane operator*(Lane a, Lane b) { return Lane(hn::Mul(a.v, b.v)); }
  friend LIMPID_LANES_INLINE Lane operator/(Lane a, Lane b) { return Lane(hn::Div(a.v, b.v)); }
  friend LIMPID_LANES_INLINE Mask operator<(Lane a, Lane b) { return {hn::Lt(a.v, b.v)}; }
  friend LIMPID_LANES_INLINE Mask operator>(Lane a, Lane b) { return {hn::Gt(a.v, b.v)}; }
  friend LIMPID_LANES_INLINE Mask operator<=(Lane a, Lane b) { return {hn::Le(a.v, b.v)}; }
  friend LIMPID_LANES_INLINE Mask operator>=(Lane a, Lane b) { return {hn::Ge(a.v, b.v)}; }
};

LIMPID_LANES_INLINE Lane select(Mask m, Lane yes, Lane no) {
  return Lane(hn::IfThenElse(m.m, yes.v, no.v));
}
LIMPID_LANES_INLINE bool any(Mask m) { return !hn::AllFalse(kD, m.m); }
LIMPID_LANES_INLINE float least(Lane a) { return hn::GetLane(hn::MinOfLanes(kD, a.v)); }
LIMPID_LANES_INLINE float greatest(Lane a) { return hn::GetLane(hn::MaxOfLanes(kD, a.v)); }
LIMPID_LANES_INLINE Lane min(Lane a, Lane b) { return Lane(hn::Min(a.v, b.v)); }
LIMPID_LANES_INLINE Lane max(Lane a, Lane b) { return Lane(hn::Max(a.v, b.v)); }
LIMPID_LANES_INLINE Lane abs(Lane a) { return Lane(hn::Abs(a.v)); }
LIMPID_LANES_INLINE Lane sqrt(Lane a) { return Lane(hn::Sqrt(a.v)); }
LIMPID_LANES_INLINE Lane floor(Lane a) { return Lane(hn::Floor(a.v)); }

/// first, first + 1, ... (Highway's Iota for a number known only at run time goes through memory.)
LIMPID_LANES_INLINE VI count_from(int first) {
  return hn::Add(hn::Iota(kDI, 0), hn::Set(kDI, first));
}

/// The integer towards zero, for numbers in the range of int. (Highway's own conversion spends time
/// on others.)
LIMPID_LANES_INLINE VI whole_of(Lane a) {
#if HWY_TARGET == HWY_AVX3
  return VI{_mm512_cvttps_epi32(a.v.raw)};
#elif HWY_TARGET == HWY_AVX2
  return VI{_mm256_cvttps_epi32(a.v.raw)};
#elif HWY_TARGET == HWY_SSE4
  return VI{_mm_cvttps_epi32(a.v.raw)};
#else
  return hn::ConvertTo(kDI, a.v);
#endif
}

/// e^x by Highway's polynomial. Relative error below 3e-7 for x in -87 ... 88; 0 below -104.
LIMPID_LANES_INLINE Lane exp(Lane x) { return Lane(hn::Exp(kD, x.v)); }

/// Highway's polynomial for the arctangent of 0 ... 1, extended to the circle. Absolute error below
/// 5e-7 for |x| and |y| in 1e-36 ... 1e36, or 0.
LIMPID_LANES_INLINE Lane atan2(Lane y, Lane x) {
  const Lane across = abs(x), up = abs(y);
  const Lane slope = min(across, up) / max(max(across, up), Lane(1e-37));
  const Lane octant(hn::Atan(kD, slope.v));
  const Lane quarter = select(up > across, Lane(std::numbers::pi / 2) - octant, octant);
  const Lane half = select(x < Lane(0), Lane(std::numbers::pi) - quarter, quarter);
  return select(y < Lane(0), Lane(0) - half, half);
}

/// x^p for x in 0 ... 1e30, p in 0 ... 1e5, as exp(p log x). Relative error below 3e-7 (2 + |p log
/// x|); pow(0, p) = 0, pow(x, 0) = 1; x below 1e-37 counts as 0.
LIMPID_LANES_INLINE Lane pow(Lane x, Lane p) {
  const Mask positive = x > Lane(1e-37);
  const Lane exponent = p * Lane(hn::Log(kD, select(positive, x, Lane(1)).v));
  const Lane power = exp(max(min(exponent, Lane(88)), Lane(-103)));
  return select(p <= Lane(0), Lane(1), select(positive, power, Lane(0)));
}

/// The same with one exponent for all lanes. An integer up to 256 is a chain of products, with a
/// relative error below p / 2^24.
LIMPID_LANES_INLINE Lane pow(Lane x, double p) {
  const int whole = p <= 256 ? static_cast<int>(p) : 0;
  if (whole > 0 && whole == p) {
    Lane power = x, result(1);
    for (int left = whole;; power = power * power) {
      if (left & 1) result = result * power;
      left >>= 1;
      if (left == 0) return result;
    }
  }
  return pow(x, Lane(p));
}

/// By Highway's polynomials. Absolute error below 1.5e-7 for x in -1000 ... 1000, for any
/// instruction set.
LIMPID_LANES_INLINE Lane sin(Lane x) { return Lane(hn::Sin(kD, x.v)); }
LIMPID_LANES_INLINE Lane cos(Lane x) { return Lane(hn::Cos(kD, x.v)); }

}  // namespace limpid::HWY_NAMESPACE
