#pragma once
#include "limpid/core/vec.h"

#include "optics/highlight.h"

/// @file
/// Shading of dry surfaces by the sun: the materials of the raster pass (Shading in
/// raster/model.h). `base` is the surface's color, `cosine` n.L, `shadow` the sun's visibility 0
/// ... 1, `sun` its color. Unlit materials are `base` itself.

namespace limpid {

/// base (ambient + sat(n.L) shadow sun). Lambert 1760, "Photometria".
template <class F>
LIMPID_INLINE Rgb<F> lambert_shading(Rgb<F> base, Rgb<F> ambient, F cosine, F shadow, Rgb<F> sun) {
  return base * (ambient + saturate(cosine) * shadow * sun);
}

/// Light of the Phong lobe: specular sat(R.V)^power shadow sun, only where n.L > 0, so that the
/// side that faces away has no highlight. n, v, l unit; `specular` may be a map's color.
template <class F>
LIMPID_INLINE Rgb<F> phong_glint(Rgb<F> specular, F power, Vec3<F> n, Vec3<F> v, Vec3<F> l,
                                 F shadow, Rgb<F> sun) {
  const F lobe = select(dot(n, l) > F(0), shadow * phong_lobe(n, v, l, power), F(0));
  return lobe * (specular * sun);
}

/// Diffuse light in steps of a fifth: ceil(5 d) / 5 for d in 0 ... 1; 0 stays 0.
template <class F>
LIMPID_INLINE F toon_steps(F d) {
  return F(0.2) * (F(0) - floor(F(0) - F(5) * d));
}

/// base (ambient + toon_steps(sat(n.L) shadow) sun).
template <class F>
LIMPID_INLINE Rgb<F> toon_shading(Rgb<F> base, Rgb<F> ambient, F cosine, F shadow, Rgb<F> sun) {
  return base * (ambient + toon_steps(saturate(cosine) * shadow) * sun);
}

}  // namespace limpid
