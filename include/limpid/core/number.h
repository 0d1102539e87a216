#pragma once
#include <algorithm>
#include <cmath>

/// @file
/// The functions that formulas may call on numbers. Formulas are templates over the number type:
/// the reference runner uses `double` (this header), the fused runner SIMD lanes, which have
/// functions of the same names in their own namespace. A comparison gives a `bool` for `double` and
/// a lane mask for lanes, so formulas choose values by select(), and branch on numbers only by
/// if_any(), repeat() and steps(). A mask must not become a `bool`, which could not differ between
/// lanes. A third number type computes nothing and records the operations of the formulas
/// (src/shade/recorder.h).
///
/// F(0.5) is a constant of the formula. Numbers of scene, look, frame and time enter a formula by
/// given(); a recording makes each of them a named uniform.

#define LIMPID_INLINE inline __attribute__((always_inline))

namespace limpid {

LIMPID_INLINE double select(bool condition, double yes, double no) { return condition ? yes : no; }
LIMPID_INLINE double min(double a, double b) { return a < b ? a : b; }
LIMPID_INLINE double max(double a, double b) { return a > b ? a : b; }
LIMPID_INLINE double abs(double x) { return std::fabs(x); }
LIMPID_INLINE double sqrt(double x) { return std::sqrt(x); }
LIMPID_INLINE double floor(double x) { return std::floor(x); }
LIMPID_INLINE double exp(double x) { return std::exp(x); }
/// For finite numbers, -pi ... pi; atan2(0, 0) = 0.
LIMPID_INLINE double atan2(double y, double x) { return std::atan2(y, x); }
/// x^p for x >= 0; pow(0, 0) = 1. The exponent is a double for lanes, too.
LIMPID_INLINE double pow(double x, double p) { return std::pow(x, p); }
/// For an angle in radians; lanes are accurate for -1000 ... 1000.
LIMPID_INLINE double sin(double x) { return std::sin(x); }
LIMPID_INLINE double cos(double x) { return std::cos(x); }
LIMPID_INLINE bool any(bool condition) { return condition; }
/// The least and the greatest number of all lanes.
LIMPID_INLINE double least(double x) { return x; }
LIMPID_INLINE double greatest(double x) { return x; }

/// Calls body() if the condition holds for any lane. A body may only change numbers outside of it,
/// and uses select() to keep them in lanes for which the condition does not hold.
template <class M, class Body>
LIMPID_INLINE void if_any(M lanes, Body&& body) {
  if (any(lanes)) body();
}

/// Loops for a number type. A type that records formulas specialises this struct.
template <class F>
struct Loop {
  /// Calls body() `count` times.
  template <class Body>
  static LIMPID_INLINE void repeat(int count, Body&& body) {
    for (int i = 0; i < count; ++i) body();
  }
  /// Calls body(i) for i = begin ... end - 1, as long as any lane of the mask that it returns is
  /// set. leap(i), called before each body, returns the next i whose body can change a number, or
  /// `end` or more to stop.
  template <class Leap, class Body>
  static LIMPID_INLINE void steps(int begin, int end, Leap&& leap, Body&& body) {
    for (int i = leap(begin); i < end; i = leap(i + 1)) {
      if (!any(body(i))) break;
    }
  }
  /// Calls body(i) for i = 0 ... count - 1, for bodies that are the same for each i, as for red,
  /// green and blue. A recording makes it a loop instead of `count` copies.
  template <class Body>
  static LIMPID_INLINE void each(int count, Body&& body) {
    for (int i = 0; i < count; ++i) body(i);
  }
  /// Calls body() if i, the argument of a body of each(), is k.
  template <class Body>
  static LIMPID_INLINE void only(int i, int k, Body&& body) {
    if (i == k) body();
  }
  /// The i-th of the numbers.
  static LIMPID_INLINE F pick(int i, F first, F second, F third) {
    return i == 0 ? first : i == 1 ? second : third;
  }
  /// i / n, for the argument i of a body.
  static LIMPID_INLINE F ratio(int i, int n) { return F(double(i) / n); }
};

template <class F, class Body>
LIMPID_INLINE void repeat(int count, Body&& body) {
  Loop<F>::repeat(count, body);
}
template <class F, class Body>
LIMPID_INLINE void steps(int begin, int end, Body&& body) {
  Loop<F>::steps(
      begin, end, [](int i) { return i; }, body);
}
template <class F, class Leap, class Body>
LIMPID_INLINE void steps(int begin, int end, Leap&& leap, Body&& body) {
  Loop<F>::steps(begin, end, leap, body);
}

template <class F, class Body>
LIMPID_INLINE void each(int count, Body&& body) {
  Loop<F>::each(count, body);
}
template <class F, class I, class Body>
LIMPID_INLINE void only(I i, int k, Body&& body) {
  Loop<F>::only(i, k, body);
}
template <class F, class I>
LIMPID_INLINE F pick(I i, F first, F second, F third) {
  return Loop<F>::pick(i, first, second, third);
}

/// Converts numbers of a frame to the number type. A type that records formulas specialises this
/// struct.
template <class F>
struct Given {
  static LIMPID_INLINE F known(double x, const void*) { return F(x); }
  static LIMPID_INLINE F named(double x, const char*, int) { return F(x); }
};

/// A number of scene, look, frame or time, by reference to its member: a recording finds the
/// number's name by the address.
template <class F, class T>
LIMPID_INLINE F given(const T& x) {
  return Given<F>::known(static_cast<double>(x), &x);
}
/// A number computed from such numbers is a temporary without a name: give it one, as in
/// "water.per_ior", or a name and an index. Equal names must have equal numbers.
template <class F, class T>
F given(const T&& x) = delete;
template <class F>
LIMPID_INLINE F given(double x, const char* name, int place = -1) {
  return Given<F>::named(x, name, place);
}

/// Clamped to 0 ... 1.
template <class F>
LIMPID_INLINE F saturate(F x) {
  return min(max(x, F(0)), F(1));
}

/// a + t (b - a).
template <class F>
LIMPID_INLINE F lerp(F a, F b, F t) {
  return a + t * (b - a);
}

}  // namespace limpid
