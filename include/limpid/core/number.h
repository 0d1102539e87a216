#pragma once
#include <algorithm>
#include <cmath>

/// @file
/// The functions that formulas may call on a number. Formulas are templates over the number type:
/// the reference runs them on `double` (this header), the fused pass on SIMD lanes, which bring
/// functions of the same names in their own namespace. A comparison gives `bool` for `double` and a
/// lane mask for lanes, so formulas choose with select() and branch on numbers only by if_any(),
/// repeat() and steps(). Masks stay masks: a `bool` made of one would be that of all lanes. A third
/// kind of number computes nothing and writes down what formulas do (src/shade/recorder.h).
///
/// F(0.5) is a constant of the formula. What scene, look, frame or time say enters by given(),
/// which a recording keeps as a number with a name.

#define LIMPID_INLINE inline __attribute__((always_inline))

namespace limpid {

LIMPID_INLINE double select(bool condition, double yes, double no) { return condition ? yes : no; }
LIMPID_INLINE double min(double a, double b) { return a < b ? a : b; }
LIMPID_INLINE double max(double a, double b) { return a > b ? a : b; }
LIMPID_INLINE double abs(double x) { return std::fabs(x); }
LIMPID_INLINE double sqrt(double x) { return std::sqrt(x); }
LIMPID_INLINE double floor(double x) { return std::floor(x); }
LIMPID_INLINE double exp(double x) { return std::exp(x); }
/// Of finite numbers, -pi ... pi; atan2(0, 0) = 0.
LIMPID_INLINE double atan2(double y, double x) { return std::atan2(y, x); }
/// x^p for x >= 0; pow(0, 0) = 1. The exponent is a double for lanes, too.
LIMPID_INLINE double pow(double x, double p) { return std::pow(x, p); }
/// Of an angle in radians; lanes keep their accuracy for -1000 ... 1000.
LIMPID_INLINE double sin(double x) { return std::sin(x); }
LIMPID_INLINE double cos(double x) { return std::cos(x); }
LIMPID_INLINE bool any(bool condition) { return condition; }
/// Of all lanes.
LIMPID_INLINE double least(double x) { return x; }
LIMPID_INLINE double greatest(double x) { return x; }

/// body() where the condition holds for any of the lanes. A body changes numbers that live outside
/// of it and nothing else; lanes for which the condition does not hold keep theirs by select().
template <class M, class Body>
LIMPID_INLINE void if_any(M lanes, Body&& body) {
  if (any(lanes)) body();
}

/// A loop over whole numbers as a number type has it. A type that records formulas brings its own.
template <class F>
struct Loop {
  /// body() `count` times.
  template <class Body>
  static LIMPID_INLINE void repeat(int count, Body&& body) {
    for (int i = 0; i < count; ++i) body();
  }
  /// body(i) for i = begin ... end - 1, as long as any lane of the mask that it returns goes on.
  /// Before it, leap(i) is the i to go on with, or one of `end` or more to be done: a later one
  /// where the bodies between would change nothing.
  template <class Leap, class Body>
  static LIMPID_INLINE void steps(int begin, int end, Leap&& leap, Body&& body) {
    for (int i = leap(begin); i < end; i = leap(i + 1)) {
      if (!any(body(i))) break;
    }
  }
  /// body(i) for i = 0 ... count - 1: the same for each, as for red, green and blue. What is
  /// written down then is a loop, and no longer for being run three times.
  template <class Body>
  static LIMPID_INLINE void each(int count, Body&& body) {
    for (int i = 0; i < count; ++i) body(i);
  }
  /// body() where i, which a body was given, is k.
  template <class Body>
  static LIMPID_INLINE void only(int i, int k, Body&& body) {
    if (i == k) body();
  }
  /// That of the numbers which is the i-th.
  static LIMPID_INLINE F pick(int i, F first, F second, F third) {
    return i == 0 ? first : i == 1 ? second : third;
  }
  /// i / n, of an i that a body was given.
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

/// What a number type makes of a number of the frame. One that records formulas brings its own.
template <class F>
struct Given {
  static LIMPID_INLINE F known(double x, const void*) { return F(x); }
  static LIMPID_INLINE F named(double x, const char*, int) { return F(x); }
};

/// A number that belongs to scene, look, frame or time, as it lies in the object that has it: a
/// recording finds its name by its address.
template <class F, class T>
LIMPID_INLINE F given(const T& x) {
  return Given<F>::known(static_cast<double>(x), &x);
}
/// One that was made from such numbers lies nowhere: it needs a name, "water.per_ior", or one and a
/// place in a list. What has the same name is the same number.
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
