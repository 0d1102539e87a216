#pragma once
#include "limpid/core/number.h"

/// @file
/// Small vectors over any number type. GLM has the matrices and the geometry in `double`; its
/// vectors are unions, which cannot have SIMD lanes as members.

namespace limpid {

template <class F>
struct Vec2 {
  F x, y;
  friend LIMPID_INLINE Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend LIMPID_INLINE Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend LIMPID_INLINE Vec2 operator*(F s, Vec2 a) { return {s * a.x, s * a.y}; }
};

template <class F>
struct Vec3 {
  F x, y, z;
  friend LIMPID_INLINE Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend LIMPID_INLINE Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend LIMPID_INLINE Vec3 operator*(F s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
};

template <class F>
struct Rgb {
  F r, g, b;
  friend LIMPID_INLINE Rgb operator+(Rgb a, Rgb c) { return {a.r + c.r, a.g + c.g, a.b + c.b}; }
  friend LIMPID_INLINE Rgb operator-(Rgb a, Rgb c) { return {a.r - c.r, a.g - c.g, a.b - c.b}; }
  friend LIMPID_INLINE Rgb operator*(Rgb a, Rgb c) { return {a.r * c.r, a.g * c.g, a.b * c.b}; }
  friend LIMPID_INLINE Rgb operator*(F s, Rgb a) { return {s * a.r, s * a.g, s * a.b}; }
  friend bool operator==(const Rgb&, const Rgb&) = default;
};

/// A symmetric 2x2 matrix, such as a covariance.
template <class F>
struct Sym2 {
  F xx, xy, yy;
  friend LIMPID_INLINE Sym2 operator+(Sym2 a, Sym2 b) {
    return {a.xx + b.xx, a.xy + b.xy, a.yy + b.yy};
  }
  friend LIMPID_INLINE Sym2 operator*(F s, Sym2 a) { return {s * a.xx, s * a.xy, s * a.yy}; }
};

/// a' C a: the variance along a unit vector a.
template <class F>
LIMPID_INLINE F along(Sym2<F> c, Vec2<F> a) {
  return a.x * a.x * c.xx + F(2) * a.x * a.y * c.xy + a.y * a.y * c.yy;
}

/// First and second moments of wave slopes: the mean slope, and the mean of its products with
/// itself.
template <class F>
struct SlopeMoments {
  Vec2<F> mean;
  Sym2<F> square;
  friend LIMPID_INLINE SlopeMoments operator+(SlopeMoments a, SlopeMoments b) {
    return {a.mean + b.mean, a.square + b.square};
  }
  friend LIMPID_INLINE SlopeMoments operator*(F s, SlopeMoments a) {
    return {s * a.mean, s * a.square};
  }
};

/// One number for each of the four texels of a bilinear lookup: upper left, upper right, lower
/// left, lower right.
template <class F>
struct Four {
  F at[4];
  LIMPID_INLINE F operator[](int k) const { return at[k]; }
};

/// Three numbers for each pixel of a 3x3 neighbourhood, row after row: [4] is the centre.
template <class F>
struct Around {
  Vec3<F> at[9];
  LIMPID_INLINE Vec3<F> operator[](int k) const { return at[k]; }
};

template <class F>
LIMPID_INLINE Vec3<F> cross(Vec3<F> a, Vec3<F> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class F>
LIMPID_INLINE F dot(Vec3<F> a, Vec3<F> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class F>
LIMPID_INLINE F length(Vec3<F> a) {
  return sqrt(dot(a, a));
}

/// a / |a|, or `otherwise` where |a|^2 is below 1e-30 (a zero vector has no direction).
template <class F>
LIMPID_INLINE Vec3<F> normalize_or(Vec3<F> a, Vec3<F> otherwise) {
  const F square = dot(a, a);
  const auto good = square > F(1e-30);
  const F scale = F(1) / sqrt(select(good, square, F(1)));
  return {select(good, scale * a.x, otherwise.x), select(good, scale * a.y, otherwise.y),
          select(good, scale * a.z, otherwise.z)};
}

template <class F, class M>
LIMPID_INLINE Vec2<F> select(M condition, Vec2<F> yes, Vec2<F> no) {
  return {select(condition, yes.x, no.x), select(condition, yes.y, no.y)};
}
template <class F, class M>
LIMPID_INLINE Vec3<F> select(M condition, Vec3<F> yes, Vec3<F> no) {
  return {select(condition, yes.x, no.x), select(condition, yes.y, no.y),
          select(condition, yes.z, no.z)};
}
template <class F, class M>
LIMPID_INLINE Rgb<F> select(M condition, Rgb<F> yes, Rgb<F> no) {
  return {select(condition, yes.r, no.r), select(condition, yes.g, no.g),
          select(condition, yes.b, no.b)};
}

}  // namespace limpid
