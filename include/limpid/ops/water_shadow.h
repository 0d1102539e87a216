#pragma once
#include <span>
#include <string_view>

#include "limpid/core/field.h"

namespace limpid {

/// The sun's shadow on murky water.
///
/// `darken` ("Realistic Water"): all that comes from below is multiplied by 1 - strength (1 -
/// shadow(uv')), bilinear. Not physical: independent of how murky the water is and how deep, and
/// down to black as if the sky gave no light.
///
/// `scatter`: takes the sun's share of what the water sends where the sun does not reach the water:
/// in_scatter -= strength ((1 - v_near) sun_near + (1 - v_far) sun_far + (1 - v_often) sun_often),
/// never below 0. Clear water shows no shadow of its own, the bottom's is in the dry picture
/// already.
///
/// Where the frame has a shadow on the surface, it is looked up where the sunlight entered that is
/// scattered on the way to the viewer: at four places of the way that send as much each, on the
/// line in the calm surface from the pixel to where the sunlight of the way's end comes in. v_near
/// and v_far are means of these, by how far they lie from its two ends; v_often is the mean of
/// four places, one free path around the middle one. Else v_near is the shadow at the pixel
/// itself, and v_far, as v_often, that at uv'.
///
/// `shafts`, of `scatter`: sunlight that the waves focus is as uneven in the water as on the
/// bottom, and so is what it sends once scattered: in_scatter += shafts (e_near sun_near + e_far
/// sun_far), seen from the air. e is v (E - 1) in the mean of four places of the way: E the sun's
/// light over that under calm water, at the mean depth that the glow comes from or at the bottom,
/// as caustics.h has it, where the light of the place entered, as wide as the way goes aside in
/// that part of it; v as above, with `strength`. Above that depth E - 1 grows with the depth, and
/// the share that the water scatters on the way down is even. 0 none, 1 as the waves focus.
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
