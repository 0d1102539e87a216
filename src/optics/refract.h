#pragma once
#include "limpid/core/vec.h"

/// @file
/// The ray at a smooth surface. Vectors are unit: `to_viewer` points against the ray, `normal` to
/// the viewer's side. `eta` is the index on the viewer's side over the index on the far side (1 /
/// 1.333 from air into water, 1.333 from below), the inverse of fresnel_exact's `ior`.

namespace limpid {

template <class F>
struct Refracted {
  Vec3<F> direction;  ///< unit, away from the viewer
  F total;            ///< 1 where all light is reflected, else 0
};

/// cos of the angle of refraction for that of incidence: sqrt(1 - eta^2 (1 - V.n^2)); 0 beyond the
/// critical angle. The sign of V.n does not matter.
template <class F>
LIMPID_INLINE F refracted_cosine(F cosine, F eta) {
  const F sine_square = max(F(1) - cosine * cosine, F(0));
  return sqrt(max(F(1) - eta * eta * sine_square, F(0)));
}

/// Snell's law as in Heckbert 1989, "Writing a Ray Tracer": eta (V.n n - V) - cos_t n. Never NaN:
/// beyond the critical angle the direction is the one along the surface and `total` is 1. A facet
/// seen from behind (V.n < 0) bends V mirrored in the facet, so that the ray always goes to the far
/// side.
template <class F>
LIMPID_INLINE Refracted<F> refract(Vec3<F> to_viewer, Vec3<F> normal, F eta) {
  const F cosine = dot(to_viewer, normal);
  const F sine_square = max(F(1) - cosine * cosine, F(0));
  const auto total = eta * eta * sine_square > F(1);
  // At total reflection the sine is above 1 / eta, so the root is never of 0.
  const F along = select(total, F(1) / sqrt(select(total, sine_square, F(1))), eta);
  return {along * (cosine * normal - to_viewer) - refracted_cosine(cosine, eta) * normal,
          select(total, F(1), F(0))};
}

/// The mirrored ray, away from the surface: 2 V.n n - V. Below the surface where V.n < 0.
template <class F>
LIMPID_INLINE Vec3<F> mirror(Vec3<F> to_viewer, Vec3<F> normal) {
  return (F(2) * dot(to_viewer, normal)) * normal - to_viewer;
}

}  // namespace limpid
