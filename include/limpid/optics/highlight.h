#pragma once
#include "limpid/core/vec.h"

/// Lobes of a sun highlight, 0 ... 1. All vectors unit: n the normal, v to the viewer, l to the
/// light.

namespace limpid {

/// sat(R.V)^power with R the mirrored light direction. Phong 1975, "Illumination for Computer
/// Generated Pictures".
template <class F>
LIMPID_INLINE F phong_lobe(Vec3<F> n, Vec3<F> v, Vec3<F> l, F power) {
  const Vec3<F> r = (F(2) * dot(n, l)) * n - l;
  return pow(saturate(dot(r, v)), power);
}

/// sat(N.H)^power with H half way between light and viewer; 0 where the two are opposite. Blinn
/// 1977, "Models of Light Reflection for Computer Synthesized Pictures".
template <class F>
LIMPID_INLINE F blinn_phong_lobe(Vec3<F> n, Vec3<F> v, Vec3<F> l, F power) {
  const Vec3<F> zero{F(0), F(0), F(0)};
  const Vec3<F> h = normalize_or(l + v, zero);
  return pow(saturate(dot(n, h)), power);
}

}  // namespace limpid
