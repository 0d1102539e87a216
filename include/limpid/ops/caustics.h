#pragma once
#include <span>
#include <string_view>

#include "limpid/core/field.h"

namespace limpid {

/// Sunlight on the bottom: refracted by the water, and focused by the waves to a net of light.
///
/// The sun's part of the bottom's light is multiplied by 1 + strength (E - 1), per channel. E is
/// the irradiance of the bottom by the sun, divided by that under calm water. It comes from a table
/// of light that is traced from the waves down (complete/caustics.h), looked up for the end of the
/// refracted view ray, per channel with its own index of refraction. The sun's part is the plane
/// sun_color if the frame has it; else that of a level bottom under the shadow. How much stronger
/// the sun's light is than all other light, the frame tells at the edges of shadows on its bottom
/// (complete/sun_share.h) if its light is refracted, or else the sun and the sky's radiance as for
/// depth_fog; without a sky `sun_share` of the light is the sun's, where the sun is visible.
///
/// The sun lights the dry picture straight. `sunlight` = `refracted` refracts its light, in frames
/// with sun_color or shadow, also if strength is 0. Slopes and walls then reflect the sun at the
/// angle at which light meets them under calm water: a wall that faces the sun becomes darker. The
/// slope comes from the depth, unless all eye depths have half precision, which is too coarse.
/// Shadows move to their refracted positions, in frames with shadow: the unrefracted shadow is
/// removed, by an estimate of the sun's light from the bottom's other light and from sunlit bottom
/// nearby, and the shadow on the surface at the entry point of calm water is applied: the plate's
/// surface_shadow, or one that a completer makes of shadow and depth. On a host's device, which has
/// neither, and where the picture does not show that entry point (beyond its edge, or behind
/// a wave, an object or the rim of a basin), the shadow is that on the bottom where unrefracted
/// light through the entry point falls, if the picture shows the bottom there at the same depth; no
/// bottom hidden by objects has shadows then. Where the surface tells, shadows of objects below it
/// stay: they are the shadow on the bottom divided by the shadow on the surface along the
/// unrefracted ray. Where neither tells, and towards the picture's edge, the moved shadows
/// fade into the unrefracted ones. On land, where surface_depth shows no water, and under land,
/// where a calm or a completed surface goes on, no light enters. Of bottom that only the layer
/// below shows, the shadow removed is the one on the surface at the entry point of the unrefracted
/// ray. Bottom that refraction filled in behind an object is all in the sun before.
///
/// Acts on bottom that is seen from the air, from within the water, and from there as the mirror
/// image in the surface if the frame has a reflection with a depth; light on the mirror image is
/// focused only, its slopes and shadows stay straight. Outside of the table, and in
/// pixels that are wider than the waves are long, the light is that of calm water.
struct Caustics {
  enum class Sunlight { kStraight, kRefracted };
  struct Params {
    double strength = 1;
    double sun_share = 0.8;
    Sunlight sunlight = Sunlight::kRefracted;
  };

  static constexpr std::string_view kName = "caustics";
  static constexpr std::string_view kAbout =
      "Sunlight on the bottom, refracted by water and focused by waves.";
  static std::span<const Field<Params>> fields();
};

}  // namespace limpid
