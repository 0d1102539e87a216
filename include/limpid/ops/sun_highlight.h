#pragma once
#include <span>
#include <string_view>

#include "limpid/core/field.h"

namespace limpid {

/// Adds the glint of the sun on the surface, times strength and the sun's visibility. It may exceed
/// 1, and is 0 for views from under water. The visibility is the plane surface_shadow, of
/// the plate or completed for caustics or water_shadow, else the plane shadow at this pixel;
/// without both the surface counts as lit. Facets that face away from the sun do not glint.
///
/// lobe^power * sun color: `phong` measures the lobe from the mirrored light, `blinn_phong`
/// ("Realistic Water", power 200) from the half vector. Not physical: wide lobes are as bright as
/// narrow ones, but water mirrors a few percent.
///
/// `ggx` (Walter et al. 2007): reflection of the sun's irradiance by water of that roughness; the
/// irradiance is pi times its color: a white wall that faces the sun shows that color, as in the
/// raster pass. Never brighter than the Fresnel reflectance of the sun's disc, whose radiance is
/// the irradiance over its solid angle. `roughness` is alpha; alpha^2, the mean square slope of the
/// waves below pixel size, is 0.003 + 0.00512 wind / (m/s) for all waves of an open sea (Cox & Munk
/// 1954). 0 is a mirror: the sun's disc itself, with a radius of 0.2665 degrees.
///
/// `slopes` (Ross et al. 2005; optics/highlight.h): the density of the slopes that mirror the sun's
/// disc, from slopes that the pixel does not resolve (slope_variance), from `roughness`, as for
/// ggx, and from the disc, Sun::diameter. The only model whose energy is that of the mirrored disc
/// for any pixel size. Without a shadow plane of the surface it searches for occluders of the sun
/// in the dry depth, and never takes the shadow of the bottom.
struct SunHighlight {
  enum class Model { kPhong, kBlinnPhong, kGgx, kSlopes };
  struct Params {
    Model model = Model::kGgx;
    double power = 200;
    double strength = 1;
    double roughness = 0.01;
  };

  static constexpr std::string_view kName = "sun_highlight";
  static constexpr std::string_view kAbout = "Glint of the sun, masked by its shadow.";
  static std::span<const Field<Params>> fields();
};

}  // namespace limpid
