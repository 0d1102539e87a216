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
/// bottom, for that fell on the bottom around, whose shade is in the plane `basin`. Clear water
/// shows no shadow of its own; the shadow of the bottom is already in the dry picture.
///
/// If the frame has a shadow on the surface, its own or one that a completer makes of shadow and
/// depth, it is looked up at the entry points of the sunlight
/// that is scattered along the path to the viewer: at four points, each for an equal part of the
/// light, on the line in the calm surface from the pixel to the entry point for the path's end.
/// v_near and v_far are means of these, weighted by their distances from the line's two ends;
/// v_multiple is the mean of four points, one mean free path around the middle one. Else v_near is
/// the shadow at the pixel itself, and v_far and v_multiple that at uv'. Without either plane a
/// search in the depth plane, from the pixel towards the sun, tells whether an object in the
/// picture hides the sun, for views from the air: v is 0 or 1, and in between where an object that
/// the picture's edge cuts may hide it.
///
/// `shafts`, for `scatter` and views from the air: waves focus sunlight within the water, too,
/// which makes its single-scattered light uneven: in_scatter += shafts (e_near sun_near + e_far
/// sun_far). e is the mean of v (E - 1) at four points of the path; v as above, with `strength`. E
/// is the irradiance by the sun, divided by that under calm water, as in caustics.h. It is looked
/// up at the entry point of each of the four points, in a table for the mean depth of the scattered
/// light, or for the bottom if that is higher, and filtered over the distance across the sunlight
/// that the point's part of the path covers. Above the table's depth E - 1 grows in proportion to
/// the depth; light scattered on its path down counts as even. 0 is no shafts, 1 physical.
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
