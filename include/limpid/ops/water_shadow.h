#pragma once
#include <span>
#include <string_view>

#include "limpid/core/field.h"

namespace limpid {

/// The sun's shadow in murky water.
///
/// `darken` ("Realistic Water"): multiplies all light from below by 1 - strength (1 - shadow(uv')),
/// bilinear. Not physical: independent of murkiness and depth, and down to black as if there were
/// no sky light.
///
/// `scatter`: removes the sun's part of the scattered light where the sun does not reach the water:
/// in_scatter -= strength ((1 - v_near) sun_near + (1 - v_far) sun_far + (1 - v_multiple)
/// sun_multiple), never below 0. sun_multiple has no light that the surface reflects back to the
/// bottom, for that fell on the bottom around, and the bottom's albedo has its shade. Clear water
/// shows no shadow of its own; the shadow of the bottom is already in the dry picture.
///
/// If the frame has a shadow on the surface, it is looked up at the entry points of the sunlight
/// that is scattered along the path to the viewer: at four points, each for an equal part of the
/// light, on the line in the calm surface from the pixel to the entry point for the path's end.
/// v_near and v_far are means of these, weighted by their distances from the line's two ends;
/// v_multiple is the mean of four points, one mean free path around the middle one. Else v_near is
/// the shadow at the pixel itself, and v_far and v_multiple that at uv'.
///
/// `shafts`, of `scatter`: focused sunlight is as uneven in the water as on the bottom, and so is
/// its single-scattered light: in_scatter += shafts (e_near sun_near + e_far sun_far), seen from
/// the air. e is the mean of v (E - 1) at four points of the path: E the sunlight over that under
/// calm water, at the mean depth of the scattered light or at the bottom, as in caustics.h, at the
/// entry point of each, with the width by which the path moves sideways in its part; v as above,
/// with `strength`. Above that depth E - 1 grows with the depth, and light scattered on its path
/// down is even. 0 none, 1 physical.
struct WaterShadow {
  enum class Model { kDarken, kScatter };
  struct Params {
    Model model = Model::kScatter;
    double strength = 1;
    double shafts = 0;
  };

  static constexpr std::string_view kName = "water_shadow";
  static constexpr std::string_view kAbout = "Shadow of the sun on murky water.";
  static std::span<const Field<Params>> fields();
};

}  // namespace limpid
