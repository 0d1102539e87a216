#pragma once
#include "limpid/core/number.h"

/// @file
/// Share of light that the surface reflects. `cosine` is V.n, the cosine between the unit direction
/// to the viewer and the unit normal.

namespace limpid {

/// (1 - |V.n|)^power. Rim lighting as used by "Realistic Water" (power 3). Not physical: 0 at
/// normal incidence, where water reflects 0.02; up to 0.216 too much at 80 deg; the |.| hides
/// normals that face away.
template <class F>
LIMPID_INLINE F fresnel_rim(F cosine, double power) {
  return pow(max(F(1) - abs(cosine), F(0)), power);
}

/// 1 - sat(V.n), with the calm normal: "How to create Water shader in Monogame XNA". Not physical:
/// 0 at normal incidence, where water reflects 0.02; up to 0.53 too much at 73 deg.
template <class F>
LIMPID_INLINE F fresnel_linear(F cosine) {
  return F(1) - saturate(cosine);
}

/// sat(1 - intensity sat(V.n)^power), for both >= 0: Rito15 2021, "Making a Water Shader", whose
/// formula goes negative for an intensity above 1; here that is 0. Not physical: at normal
/// incidence 1 - intensity, so a smaller intensity reflects more; correct (1) at grazing angles.
template <class F>
LIMPID_INLINE F fresnel_inverse_power(F cosine, F intensity, double power) {
  return saturate(F(1) - intensity * pow(saturate(cosine), power));
}

/// Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering": f0 + (1 - f0)(1 -
/// V.n)^5, with V.n clamped to 0 ... 1. For water within 0.06 of the exact reflectance (worst at 84
/// deg).
template <class F>
LIMPID_INLINE F fresnel_schlick(F cosine, F f0) {
  const F m = F(1) - saturate(cosine);
  const F m2 = m * m;
  return f0 + (F(1) - f0) * (m2 * m2 * m);
}

/// Unpolarised reflectance of a smooth dielectric, exactly. `ior` is the index on the far side of
/// the surface over the index on the viewer's side: 1.333 from air into water, 1/1.333 from below;
/// beyond the critical angle the result is 1 (total internal reflection). V.n is clamped to 0
/// ... 1. Cook & Torrance 1982, "A Reflectance Model for Computer Graphics". The denominator
/// c (g - c) + 1 is at least min(1, ior^2); g + c is 0 only at ior 1 and V.n 0, which the guard
/// keeps from 0 / 0.
template <class F>
LIMPID_INLINE F fresnel_exact(F cosine, F ior) {
  const F c = saturate(cosine);
  const F g_square = ior * ior - F(1) + c * c;
  const auto total = g_square < F(0);
  const F g = sqrt(max(g_square, F(0)));
  const F s = (g - c) / max(g + c, F(1e-20));
  const F p = (c * (g + c) - F(1)) / (c * (g - c) + F(1));
  return select(total, F(1), F(0.5) * s * s * (F(1) + p * p));
}

}  // namespace limpid
