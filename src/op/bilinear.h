#pragma once
#include "limpid/core/frame.h"
#include "limpid/core/number.h"
#include "limpid/core/vec.h"

/// @file
/// Means of the four texels around a place that a probe has found.

namespace limpid {

/// The mean of four numbers by the weights of their texels.
template <class F, class Quad>
LIMPID_INLINE F mean_of(const Quad& quad, const Four<F>& values) {
  F sum(0);
  for (int k = 0; k < 4; ++k) sum = sum + quad.weight(k) * values[k];
  return sum;
}

template <class F, class Tap>
LIMPID_INLINE F bilinear(const Tap& tap, PlaneId plane, Vec2<F> shift) {
  const auto quad = tap.quad(shift);
  return mean_of<F>(quad, tap.read(plane, quad));
}

template <class F, class Tap>
LIMPID_INLINE Rgb<F> bilinear_rgb(const Tap& tap, PlaneId first, Vec2<F> shift) {
  const auto quad = tap.quad(shift);
  const auto channel = [&](int c) {
    return mean_of<F>(quad, tap.read(plane_after(first, c), quad));
  };
  return {channel(0), channel(1), channel(2)};
}

/// Of a depth plane; +inf counts as 1e30, for 0 times inf would be NaN.
template <class F, class Tap, class Quad>
LIMPID_INLINE F bilinear_depth(const Tap& tap, PlaneId plane, const Quad& quad) {
  const Four<F> depths = tap.read(plane, quad);
  const auto bounded = [&](int k) { return min(depths[k], F(1e30)); };
  return mean_of<F>(quad, {{bounded(0), bounded(1), bounded(2), bounded(3)}});
}

}  // namespace limpid
