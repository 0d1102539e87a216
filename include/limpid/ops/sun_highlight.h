#pragma once
#include <span>
#include <string_view>

#include "limpid/core/field.h"

namespace limpid {

/// The glint of the sun on the surface, times strength and the sun's visibility, added to the
/// picture and not bounded by 1; none where the view does not come from the air. The visibility is
/// that of the surface point: its own shadow plane, or else the shadow at this pixel; lit where the
/// frame has neither. Facets that face away from the sun do not glint.
///
/// lobe^power * sun color: `phong` measures the lobe from the mirrored light, `blinn_phong`
/// ("Realistic Water", power 200) from the half vector. Not physical: wide lobes shine as bright as
/// narrow ones, and water mirrors a few percent.
///
/// `ggx` (Walter et al. 2007): what water of that roughness mirrors of the sun's irradiance, which
/// is pi times its color: a white wall that faces the sun shows that color, as the raster pass has
/// it. Never brighter than the Fresnel reflectance of the sun's disc, that is the irradiance over
/// its solid angle. `roughness` is alpha; alpha^2, the mean square slope of the waves too small to
/// see, is 0.003 + 0.00512 wind / (m/s) for all waves of an open sea (Cox & Munk 1954). 0 is a
/// mirror: the sun's disc itself, of 0.2665 degrees of radius.
///
/// `slopes` (Ross et al. 2005; optics/highlight.h): the density of the slopes that mirror the sun's
/// disc, of those that the pixel cannot resolve (slope_variance), of `roughness`, as for ggx, and
/// of the disc, Sun::diameter. The only model whose energy is that of the disc mirrored, whatever
/// the pixel's size. Without a plane of the surface's shadow it looks for what stands before the
/// sun in the depth of the dry scene, never for the shadow of the bottom.
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
